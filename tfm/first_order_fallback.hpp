// Where a fraction has fallen below zero or risen above packing, the fluxes of the solids are of first order for a
// while.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tfm/effects.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

/// Faces by axis, as indices into fields on faces.
using FaceList = std::array<std::vector<core::Index>, 3>;

/// Looks at every accepted state, never inside a step: a cell with phi_j < -10 atol_phi or phi > phi_max + 1e-3 has
/// its faces flagged for the next 20 steps. What the flags do is up to continuity().
class FirstOrderFallback {
 public:
  static constexpr int steps = 20;
  static constexpr double overshoot = 1e-3;  ///< of phi above the maximum packing

  /// \param atol_fraction  absolute tolerance of the fractions in the time integration
  FirstOrderFallback(const Constants& constants, const fluid::Boundaries& boundaries, double atol_fraction)
      : constants_(constants), boundaries_(boundaries), least_(-10 * atol_fraction) {}

  /// A step has been accepted: counts the flags down and sets new ones. The stress may be null. Collective.
  void see(const StateLayout& layout, std::span<const double> y, const StressEffect* stress);

  /// The faces of flagged cells on which solids move.
  [[nodiscard]] const FaceList& faces() const { return faces_; }
  /// How often a cell of the column has been flagged that was not.
  [[nodiscard]] std::uint64_t count() const { return count_; }

  /// Steps left of every owned cell, in the order of a fraction in the state; empty if none of the column is flagged.
  [[nodiscard]] const std::vector<double>& steps_left() const { return left_; }
  /// Takes up flags and count of a checkpoint.
  void restore(const StateLayout& layout, std::vector<double> steps_left, std::uint64_t count);

 private:
  void list_faces(const StateLayout& layout);

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  double least_;
  std::uint64_t count_ = 0;
  std::vector<double> left_;
  FaceList faces_;
};

}  // namespace polybed::tfm
