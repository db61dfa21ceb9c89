// The equations in a box joined on all sides, without the model around them: what a test adds to their rates it adds
// here, between the operator and the pressure, and production code knows nothing of it.
#pragma once

#include "core/numerics/integrator.hpp"
#include "scenes/beds.hpp"
#include "tfm/explicit_problem.hpp"

namespace polybed::scenes {

/// The constants of a scene whose box is joined along every active axis.
inline tfm::Constants joined_box(const core::Scene& scene) {
  core::Timers timers;
  tfm::Constants constants = tfm::Model(scene, timers).constants();
  for (int axis = 0; axis < constants.grid.dimensions; ++axis) constants.grid.periodic[std::size_t(axis)] = true;
  return constants;
}

/// The production operator, pressure and projection of a joined box; add() may change the rates before the pressure.
class BoxEquations : public core::OdeProblem {
 public:
  BoxEquations(const core::Scene& scene, const tfm::Constants& constants, tfm::Discretisation discretisation,
               double pressure_tolerance)
      : equations_(scene, constants, fluid::Boundaries(constants.grid, fluid::Ends::walls),
                   fluid::Inlet(constants.grid, scene), discretisation, timers_),
        layout_(constants.grid, int(constants.species()), false),
        pressure_(constants.grid, pressure_tolerance) {}

  core::Rate rates(double t, std::span<const double> y, std::span<double> dydt) override {
    if (!equations_.evaluate(t, layout_, y)) return core::Rate::recoverable;
    tfm::Fields& fields = equations_.fields();
    add(fields);
    if (!project(fields)) return core::Rate::recoverable;
    tfm::pack_rates(layout_, fields, dydt);
    return core::Rate::ok;
  }

  [[nodiscard]] const tfm::StateLayout& layout() const { return layout_; }
  [[nodiscard]] const tfm::Constants& constants() const { return equations_.constants(); }
  [[nodiscard]] tfm::Fields& fields() { return equations_.fields(); }

  /// Integrates from 0; atol is rtol times 0.1 for fractions and m/s alike. A step above 0, s: all steps are of that
  /// length and no error is controlled.
  void advance(std::vector<double>& y, double until, double rtol, double fixed_step = 0) {
    core::ExplicitOptions options;
    options.rtol = rtol;
    options.atol.assign(y.size(), 0.1 * rtol);
    options.fixed_step = fixed_step;
    const auto integrator = core::make_explicit(*this, options);
    integrator->restart(0, y, {}, 0);
    for (double t = 0; t < until;) t = integrator->step(until).time;
    y.assign(integrator->state().begin(), integrator->state().end());
  }

 protected:
  virtual void add(tfm::Fields& fields) = 0;
  /// The pressure, and what it does to the rates; false if it cannot be found.
  virtual bool project(tfm::Fields& fields) {
    if (!pressure_.solve(fields.flux_rate, fields.fluid.flux, 0.0, fields.fluid.pressure).converged) return false;
    tfm::subtract_pressure_gradient(equations_.constants(), equations_.boundaries(), fields);
    return true;
  }
  [[nodiscard]] const fluid::Boundaries& boundaries() const { return equations_.boundaries(); }

 private:
  core::Timers timers_;
  tfm::RightHandSide equations_;
  tfm::StateLayout layout_;
  fluid::Pressure pressure_;
};

}  // namespace polybed::scenes
