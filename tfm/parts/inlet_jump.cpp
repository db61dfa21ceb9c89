#include "tfm/parts/inlet_jump.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/ranks.hpp"
#include "fluid/pressure.hpp"
#include "tfm/pressure_coupling.hpp"

namespace polybed::tfm {

namespace {

/// The inlet's velocity on the bottom faces of a field that is 0 elsewhere.
core::Field inlet_velocity(const RightHandSide& equations, double t) {
  core::Field bottom = core::make_field(equations.constants().grid);
  equations.inlet().set_velocity(t, bottom);
  return bottom;
}

}  // namespace

void project_jump(RightHandSide& equations, const StateLayout& layout, double velocity_scale, double time,
                  const core::Field& before, std::span<double> y) {
  const Constants& constants = equations.constants();
  if (equations.boundaries().closed()) return;
  core::Field jump = inlet_velocity(equations, std::nextafter(time, INFINITY));
  double most = 0;
  for (std::size_t f = 0; f < jump.size(); ++f) most = std::max(most, std::abs(jump[f] -= before[f]));
  if (core::greatest_of_ranks(constants.grid, most) <= 1e-9 * velocity_scale) return;
  if (!equations.evaluate(time, layout, y)) return;
  Fields& fields = equations.fields();
  const core::Field pressure = fields.fluid.pressure;
  for (core::Field& rate : fields.flux_rate.free) std::fill(rate.begin(), rate.end(), 0.0);
  for (core::FaceField& a : fields.solids.acceleration)
    for (core::Field& rate : a) std::fill(rate.begin(), rate.end(), 0.0);
  fields.flux_rate.free[1] = jump;
  fluid::Pressure impulse(constants.grid, 1e-10);
  std::fill(fields.fluid.pressure.begin(), fields.fluid.pressure.end(), 0.0);
  impulse.solve(fields.flux_rate, fields.fluid.flux, 0.0, fields.fluid.pressure);
  subtract_pressure_gradient(constants, equations.boundaries(), fields);
  for (std::size_t j = 0; j < constants.species(); ++j)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t f = 0; f < fields.solids.velocity[j][a].size(); ++f)
        fields.solids.velocity[j][a][f] += fields.solids.acceleration[j][a][f];
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t f = 0; f < fields.fluid.flux[a].size(); ++f)
      fields.fluid.flux[a][f] += fields.flux_rate.free[a][f];
  fields.fluid.pressure = pressure;
  layout.pack(fields.solids, fields.fluid, y);
}

void InletJump::restart(double time, std::span<double> y) {
  project_jump(equations_, layout_, velocity_scale_, time, inlet_velocity(equations_, std::nextafter(time, -INFINITY)),
               y);
}

}  // namespace polybed::tfm
