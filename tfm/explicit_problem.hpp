// The model as ordinary differential equations: every right-hand side includes a solve for the pressure.
#pragma once

#include <cstdint>
#include <optional>

#include "core/numerics/integrator.hpp"
#include "tfm/fast_drag.hpp"
#include "tfm/pressure_coupling.hpp"
#include "tfm/right_hand_side.hpp"

namespace polybed::tfm {

class ExplicitProblem : public core::SplitProblem {
 public:
  /// \param split  the fast part of the drag can be separated
  ExplicitProblem(RightHandSide& equations, const StateLayout& layout, double pressure_tolerance, core::Timers& timers,
                  bool split = false);

  core::Rate rates(double t, std::span<const double> y, std::span<double> dydt) override;

  void hold() override;
  [[nodiscard]] double longest_step() const override { return longest_step_; }
  void add_fast(double factor, std::span<const double> y, std::span<double> rates) override {
    fast_->add(factor, y, rates);
  }
  void solve_fast(double gamma, std::span<double> x) override { fast_->solve(gamma, x); }

  /// Starts an integration: further solves depend on the state alone.
  void begin() { pressure_.forget(); }
  /// Called before a step: the remaining div J is halved within two steps of length h, s.
  void begin_step(double h) { correction_rate_ = h > 0 ? 0.5 / h : 0; }

  [[nodiscard]] std::uint64_t solves() const { return solves_; }
  [[nodiscard]] std::uint64_t iterations() const { return iterations_; }

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
  core::Timers& timers_;
  fluid::Pressure pressure_;
  std::optional<FastDrag> fast_;  ///< empty without a split
  double correction_rate_ = 0, longest_step_ = 0;
  std::uint64_t solves_ = 0, iterations_ = 0;
};

}  // namespace polybed::tfm
