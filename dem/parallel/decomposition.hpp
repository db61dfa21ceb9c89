// Division of the box among the ranks: recursive bisection on measured work.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "dem/box.hpp"

namespace polybed::dem {

/// A part of the box: low and high corner, m.
struct Part {
  Vector low{}, high{};
};

class Decomposition {
 public:
  /// The whole box in equal parts. \param least  thickness of a part, m: thinner ones are rejected with core::CaseError
  /// here, and never created later
  Decomposition(const Box& box, std::shared_ptr<const core::Ranks> ranks, double least);

  /// Collective. Divides the box so that each rank has the same work. \param place  of this rank's particles
  /// \param work  of each, in whole units
  void balance(std::span<const Place> place, std::span<const std::int32_t> work);
  /// Collective: greatest over mean work of the ranks; 1 is balanced.
  [[nodiscard]] double imbalance(std::span<const std::int32_t> work) const;

  [[nodiscard]] int owner(const Vector& x) const;
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  [[nodiscard]] const Part& own() const { return parts_[std::size_t(rank_)]; }
  /// Directions in which this rank's part is the whole box, or so large a part that a ghost can be near both of its
  /// faces. \param reach  greatest distance of ghosts, m, between centres
  [[nodiscard]] std::array<bool, 3> whole(double reach) const;
  [[nodiscard]] Vector centre() const;

 private:
  [[nodiscard]] bool holds(const Part& part, const Vector& x) const;
  [[nodiscard]] double cut_near(double wanted, const Part& part, std::size_t axis, int below, int count) const;
  struct Cut {
    std::size_t axis;
    double at;      ///< m
    int low, high;  ///< the cuts on both sides; -1 - rank: a part
  };
  [[nodiscard]] double quantile(std::span<const Place> place, std::span<const std::int32_t> work,
                                std::span<const char> inside, const Part& part, std::size_t axis, double share) const;

  const Box& box_;
  std::shared_ptr<const core::Ranks> ranks_;
  int rank_ = 0, count_ = 1;
  double least_;
  std::vector<Cut> cuts_;
  std::vector<Part> parts_;
};

}  // namespace polybed::dem
