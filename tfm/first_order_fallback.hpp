// Fallback to first-order fluxes of the solids for a while, after a fraction falls below zero or exceeds packing.
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

/// Checks every accepted state, never inside a step: flags the faces of a cell with phi_j < -10 atol_phi or phi >
/// phi_max + 1e-3 for the next 20 steps. continuity() uses the flags.
class FirstOrderFallback {
 public:
  static constexpr int steps = 20;
  static constexpr double overshoot = 1e-3;  ///< of phi above the maximum packing

  /// \param atol_fraction  absolute tolerance of the fractions in the time integration
  FirstOrderFallback(const Constants& constants, const fluid::Boundaries& boundaries, double atol_fraction)
      : constants_(constants), boundaries_(boundaries), least_(-10 * atol_fraction) {}

  /// Called after an accepted step: counts the flags down and sets new ones. The stress can be null. Collective.
  void see(const StateLayout& layout, std::span<const double> y, const StressEffect* stress);

  /// The faces of flagged cells on which solids move.
  [[nodiscard]] const FaceList& faces() const { return faces_; }
  /// Number of times that an unflagged cell of the column was flagged.
  [[nodiscard]] std::uint64_t count() const { return count_; }

  /// Remaining steps of every owned cell, in the order of a fraction in the state; empty without flags in the column.
  [[nodiscard]] const std::vector<double>& steps_left() const { return left_; }
  /// Restores flags and count from a checkpoint.
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
