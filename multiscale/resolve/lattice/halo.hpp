// The layer of sites around a box: copies from the other side, and returns to it.
#pragma once

#include <cstddef>

#include "multiscale/resolve/lattice/obstacles.hpp"

namespace polybed::multiscale::lattice {

template <class Real>
class Halo {
 public:
  /// \param stride  between the populations of two directions
  Halo(const Sites& sites, std::size_t stride) : sites_(sites), stride_(stride) {}

  /// Between the two steps: copies the represented sites into the layer, for the directions that leave the box there.
  void fill(Real* populations) const;
  /// After the second step: moves the populations written in the layer to those sites.
  void fold(Real* populations) const;

 private:
  enum class Way { fill, fold };
  void along_x(Real* populations, Way way) const;
  void along_y(Real* populations, Way way) const;
  void along_z(Real* populations, Way way) const;

  Sites sites_;
  std::size_t stride_;
};

extern template class Halo<float>;
extern template class Halo<double>;

}  // namespace polybed::multiscale::lattice
