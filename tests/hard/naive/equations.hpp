// The product's equations with textbook terms in the place of some of its own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/numerics/integrator.hpp"
#include "fluid/pressure.hpp"
#include "tfm/model.hpp"

namespace polybed::hard::naive {

/// Adds or replaces terms in the fields of a finished evaluation.
using Terms = std::function<void(const tfm::RightHandSide&, tfm::Fields&)>;

/// dy/dt with the pressure solved for, as tfm::ExplicitProblem, after `terms` have had their say.
class Equations : public core::OdeProblem {
 public:
  /// \param scene  without the effects that `terms` replaces  \param model  gives constants, boundaries and inlet
  Equations(const core::Scene& scene, const tfm::Model& model, const tfm::StateLayout& layout, Terms terms,
            core::Timers& timers);

  core::Rate rates(double t, std::span<const double> y, std::span<double> dydt) override;
  [[nodiscard]] bool evaluate(double t, std::span<const double> y);
  void begin_step(double h) { correction_rate_ = h > 0 ? 0.5 / h : 0; }
  [[nodiscard]] tfm::Fields& fields() { return equations_.fields(); }
  [[nodiscard]] tfm::RightHandSide& right_hand_side() { return equations_; }
  [[nodiscard]] std::uint64_t solves() const { return solves_; }

 private:
  const tfm::StateLayout& layout_;
  tfm::RightHandSide equations_;
  Terms terms_;
  fluid::Pressure pressure_;
  double correction_rate_ = 0;
  std::uint64_t solves_ = 0;
};

/// No solids pressure: what flows into a cell that is full is cut off.
[[nodiscard]] Terms hard_packing(const tfm::Model& model);
/// Drag by the bare law; with `plain_shares` the guarded law of shares that are 0/0 where there are no solids.
[[nodiscard]] Terms raw_drag(const core::Scene& scene, const tfm::Model& model, bool plain_shares);
/// Continuity with plain means of phi_j on faces.
[[nodiscard]] Terms central_flux(const tfm::Model& model);
/// Convection of momentum as (U.grad)U, of first order.
[[nodiscard]] Terms advective_momentum(const core::Scene& scene, const tfm::Model& model);
/// Weight of the cell above each face in place of the face's own.
[[nodiscard]] Terms unbalanced_gravity(const tfm::Model& model);

/// A number without a unit added to the exchange coefficients, so that nothing is ever divided by 0.
[[nodiscard]] Terms hidden_unit(const tfm::Model& model);

/// Added mass as a force, C_m rho_f times the accelerations of the evaluation before: equal and opposite.
[[nodiscard]] Terms added_mass_lagged(const tfm::Model& model);

}  // namespace polybed::hard::naive
