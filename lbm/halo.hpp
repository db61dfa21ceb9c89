// The layer of sites round a slab: what it needs from the other side of the box, and gives back.
#pragma once

#include <memory>
#include <vector>

#include "core/numerics/messages.hpp"
#include "core/numerics/ranks.hpp"
#include "lbm/obstacles.hpp"

namespace polybed::lbm {

template <class Real>
class Halo {
 public:
  /// Collective. \param stride  between the populations of two directions
  Halo(const Sites& sites, std::size_t stride, std::shared_ptr<const core::Ranks> ranks);

  /// Between the two steps: sets the layer to the sites that it stands for, of the directions that leave the slab
  /// there. Collective.
  void fill(Real* populations);
  /// After the second: takes what has been written to the layer over to those sites. Collective.
  void fold(Real* populations);

 private:
  enum class Way { fill, fold };
  void along_x(Real* populations, Way way);
  void along_y(Real* populations, Way way) const;
  void along_z(Real* populations, Way way) const;
  /// Copies between a layer of x and a buffer.
  void pack(const Real* populations, int side, int layer, Real* buffer) const;
  void unpack(Real* populations, int side, int layer, const Real* buffer) const;

  Sites sites_;
  std::size_t stride_, plane_;
  std::shared_ptr<const core::Ranks> ranks_;
  std::unique_ptr<core::Messages> messages_;
  std::vector<Real> out_, in_;
  std::size_t to_left_ = 0, to_right_ = 0, from_left_ = 0, from_right_ = 0;  ///< places in the buffers
};

extern template class Halo<float>;
extern template class Halo<double>;

}  // namespace polybed::lbm
