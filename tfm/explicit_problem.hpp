// The model as ordinary differential equations: the pressure is solved for in every right-hand side.
#pragma once

#include <cstdint>

#include "core/numerics/integrator.hpp"
#include "tfm/pressure_coupling.hpp"
#include "tfm/right_hand_side.hpp"

namespace polybed::tfm {

class ExplicitProblem : public core::OdeProblem {
 public:
  ExplicitProblem(RightHandSide& equations, const StateLayout& layout, double pressure_tolerance, core::Timers& timers);

  core::Rate rates(double t, std::span<const double> y, std::span<double> dydt) override;

  /// An integration begins: what comes next depends on the state alone.
  void begin() { pressure_.forget(); }
  /// Called before a step: what is left of div J is halved within two steps of length h, s.
  void begin_step(double h) { correction_rate_ = h > 0 ? 0.5 / h : 0; }

  [[nodiscard]] std::uint64_t solves() const { return solves_; }
  [[nodiscard]] std::uint64_t iterations() const { return iterations_; }

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
  core::Timers& timers_;
  fluid::Pressure pressure_;
  double correction_rate_ = 0;
  std::uint64_t solves_ = 0, iterations_ = 0;
};

}  // namespace polybed::tfm
