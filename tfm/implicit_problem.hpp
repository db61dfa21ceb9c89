// The model as a differential-algebraic system: rates of all fields, and for the pressure div J = 0 (index 2) or, for a
// compressible fluid, (5) of fluid/compressible.hpp.
#pragma once

#include <cstdint>

#include "core/numerics/integrator.hpp"
#include "tfm/preconditioner.hpp"
#include "tfm/pressure_coupling.hpp"
#include "tfm/right_hand_side.hpp"

namespace polybed::tfm {

class ImplicitProblem : public core::DaeProblem {
 public:
  ImplicitProblem(RightHandSide& equations, const StateLayout& layout, core::Timers& timers);

  core::Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) override;
  core::Rate setup(double t, std::span<const double> y, std::span<const double> dydt, std::span<const double> r,
                   double cj) override;
  core::Rate precondition(double t, std::span<const double> r, std::span<double> z, double cj, double delta) override;

  [[nodiscard]] std::uint64_t residuals() const { return residuals_; }

 private:
  void pack_continuity(const StateLayout::Entry& entry, std::span<const double> dydt, std::span<double> r);

  RightHandSide& equations_;
  const StateLayout& layout_;
  core::Timers& timers_;
  Preconditioner preconditioner_;
  core::Field divergence_;
  std::uint64_t residuals_ = 0;
};

}  // namespace polybed::tfm
