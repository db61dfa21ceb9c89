#include "tfm/effects/kinetic_rows.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/fluid_state.hpp"
#include "tfm/solids.hpp"

namespace polybed::tfm {

namespace {

/// Least solids fraction at which collisions are evaluated: the mean free path is 12 diameters there, and what it makes
/// of shear and compression would grow as 1/phi^2. Below, all that collisions do fades with phi, so that a cell
/// without solids has the temperature that slip and drag give a lone grain: the stress and its work on the temperature
/// alike, or thin solids that fly apart would be driven by what they do not lose.
constexpr double collision_fraction_floor = 0.01;

}  // namespace

POLYBED_ALL_VECTOR_WIDTHS void begin_rows(KineticRows& rows, const double* solids_fraction, bool dense) {
  const std::size_t cells = rows.cells;
  for (std::size_t c = 0; c < cells; ++c) {
    rows.solids[c] = std::max(solids_fraction[c], 0.0);
    rows.phi[c] = std::max(rows.solids[c], collision_fraction_floor);
    rows.fade[c] = std::min(rows.solids[c] * (1 / collision_fraction_floor), 1.0);
    rows.surface[c] = rows.divergence[c] = rows.strain[c] = 0;
  }
  for (std::size_t c = 0; c < cells; ++c) {
    const closures::RadialValue gas = closures::radial_carnahan_starling(rows.phi[c]);
    const closures::RadialValue radial = dense ? closures::radial_distribution_dense(rows.phi[c]) : gas;
    rows.growth[c] = rows.phi[c] * radial.slope / radial.value;
    rows.dense[c] = radial.value / gas.value;
  }
  for (KineticRows::Row* one : {&rows.pressure_ratio, &rows.viscosity_ratio, &rows.loss_ratio})
    std::fill_n(one->begin(), cells, 1);
  std::fill_n(rows.pressure_ratio_slope.begin(), cells, 0);
}

POLYBED_ALL_VECTOR_WIDTHS void add_surface(KineticRows& rows, const double* share, double diameter) {
  const double per_diameter = 1 / diameter;
  for (std::size_t c = 0; c < rows.cells; ++c) rows.surface[c] += share[c] * rows.phi[c] * per_diameter;
}

POLYBED_ALL_VECTOR_WIDTHS void add_flow(const double* fraction, const double* velocity, std::ptrdiff_t stride,
                                        std::size_t faces, double* flow) {
  const double* below = fraction - stride;
  for (std::size_t f = 0; f < faces; ++f) flow[f] += 0.5 * (below[f] + fraction[f]) * velocity[f];
}

POLYBED_ALL_VECTOR_WIDTHS void end_flow(const double* solids_fraction, std::ptrdiff_t stride, std::size_t faces,
                                        double* flow) {
  const double* below = solids_fraction - stride;
  for (std::size_t f = 0; f < faces; ++f)
    flow[f] /= std::max(0.5 * (below[f] + solids_fraction[f]), stress_fraction_floor);
}

POLYBED_ALL_VECTOR_WIDTHS void add_divergence(KineticRows& rows, const double* low, const double* high,
                                              double spacing) {
  const double per_length = 1 / spacing;
  for (std::size_t c = 0; c < rows.cells; ++c) rows.divergence[c] += (high[c] - low[c]) * per_length;
}

POLYBED_ALL_VECTOR_WIDTHS void add_strain(KineticRows& rows, const double* share, const double* strain) {
  for (std::size_t c = 0; c < rows.cells; ++c) rows.strain[c] += share[c] * strain[c];
}

POLYBED_ALL_VECTOR_WIDTHS void add_neighbours(KineticRows& rows, const double* share, const Grain& grain,
                                              const Grain& neighbour) {
  const double d = grain.diameter, reach = neighbour.diameter;
  const double mass_ratio = grain.density * d * d * d / (neighbour.density * reach * reach * reach);
  const double e = 0.5 * (grain.restitution + neighbour.restitution);
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double g = rows.dense[c] * closures::radial_of_pair(1 - rows.phi[c], rows.surface[c], d, reach);
    rows.g0[c] += share[c] * g;
    rows.collisions[c] += closures::mixture_pressure_of_pair(share[c] * rows.phi[c], g, e, d, reach, mass_ratio);
  }
}

POLYBED_ALL_VECTOR_WIDTHS void set_balance(KineticRows& rows, closures::KineticModel model, const Grain& grain,
                                           const SlipRows& fluid) {
  const double rho = grain.density, d = grain.diameter, e = grain.restitution;
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double phi = rows.phi[c], g0 = rows.g0[c], per_phi = 1 / phi;
    const double slip = fluid.slip_superficial[c] / std::max(fluid.voidage[c], fluid::voidage_floor);
    rows.compression[c] = rows.fade[c] * rho * (1 + rows.collisions[c]) * rows.divergence[c] * rows.pressure_ratio[c];
    rows.viscosity[c] =
        rows.fade[c] * closures::kinetic_viscosity(model, phi, g0, e) * (rho * d) * per_phi * rows.viscosity_ratio[c];
    rows.shear[c] = rows.viscosity[c] * rows.strain[c];
    rows.loss[c] = closures::kinetic_dissipation(model, phi, g0, e) * (rho / d) * per_phi * rows.loss_ratio[c];
    rows.drag[c] = closures::fluctuation_drag_sink(fluid.exchange[c], 1);
    rows.slip[c] = closures::slip_production(phi, g0, fluid.viscosity, slip, d, rho);
  }
}

POLYBED_ALL_VECTOR_WIDTHS void balance_speed(KineticRows& rows, double* temperature) {
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double s =
        closures::balanced_speed(rows.loss[c], rows.drag[c] + rows.compression[c], rows.shear[c], rows.slip[c]);
    rows.speed[c] = s;
    temperature[c] = s * s;
  }
}

POLYBED_ALL_VECTOR_WIDTHS void take_speed(KineticRows& rows, const double* temperature) {
  for (std::size_t c = 0; c < rows.cells; ++c) rows.speed[c] = std::sqrt(std::max(temperature[c], 0.0));
}

POLYBED_ALL_VECTOR_WIDTHS void set_temperature_rate(const KineticRows& rows, const Grain& grain,
                                                    const TemperatureRows& out) {
  const double per_energy = 2 / (3 * grain.density), least2 = out.least_agitation * out.least_agitation;
  const double mass = grain.density * grain.diameter, diagonal = out.conduction_diagonal, e = grain.restitution;
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double theta = out.temperature[c], s = rows.speed[c], rounded = std::max(theta, 0.0) + least2;
    const double slip = rows.slip[c] / std::sqrt(rounded);
    const double conductivity =
        rows.fade[c] * closures::kinetic_conductivity(rows.phi[c], rows.g0[c], e) * mass * s / rows.phi[c];
    out.rate[c] =
        per_energy * (rows.shear[c] * s - (rows.compression[c] + rows.drag[c] + rows.loss[c] * s) * theta + slip);
    out.conductivity[c] = conductivity;
    out.decay[c] =
        per_energy * (rows.drag[c] + 1.5 * rows.loss[c] * s + 0.5 * slip / rounded + diagonal * conductivity);
  }
}

POLYBED_ALL_VECTOR_WIDTHS void add_stress(const KineticRows& rows, const double* share, double density,
                                          double* pressure, double* slope, double* viscosity) {
  for (std::size_t c = 0; c < rows.cells; ++c) {
    const double one = 1 + rows.collisions[c], rise = 1 + rows.collisions[c] * (2 + rows.growth[c]);
    const double energy = rows.fade[c] * share[c] * density * rows.speed[c] * rows.speed[c];
    pressure[c] += rows.solids[c] * energy * one * rows.pressure_ratio[c];
    slope[c] += energy * (rise * rows.pressure_ratio[c] + rows.phi[c] * one * rows.pressure_ratio_slope[c]);
    viscosity[c] += share[c] * rows.viscosity[c] * rows.speed[c];
  }
}

}  // namespace polybed::tfm
