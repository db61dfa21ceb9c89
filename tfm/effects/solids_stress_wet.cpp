#include "tfm/effects/solids_stress_wet.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/operators.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// 1/s, that rounds the shear rate off at 0.
constexpr double least_shear_rate = 0.01;
/// Solids fraction below which the viscosity over phi is that at it: V falls as phi^2, and a stress of so thin solids
/// is none.
constexpr double fraction_floor = 1e-3;

}  // namespace

WetStress::WetStress(const Constants& constants, const fluid::Boundaries& boundaries, closures::StressRatios ratios,
                     double jammed, double lambda, const std::string& name, Fields& fields)
    : constants_(constants),
      boundaries_(boundaries),
      ratios_(std::move(ratios)),
      jammed_(jammed),
      lambda_(lambda),
      use_{"solids stress " + name} {
  fields.stress.make_viscous(constants);
}

void WetStress::add(Fields& fields) {
  const double mu = constants_.fluid.viscosity;
  core::for_each_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      double square = least_shear_rate * least_shear_rate, per_diameter = 0, density = 0;
      for (std::size_t j = 0; j < constants_.species(); ++j) {
        const double share = fields.share[j][c];
        square += share * fields.stress.strain[j][c];
        per_diameter += share / constants_.diameter[j];
        density += share * constants_.density[j];
      }
      const double rate = std::sqrt(square) - least_shear_rate, phi = std::max(fields.solids_fraction[c], 0.0);
      const double stokes = closures::stokes_of_shear(density, 1 / per_diameter, rate, mu);
      const closures::WetStress stress = closures::wet_stress(ratios_, jammed_, lambda_, phi, stokes, mu, rate);
      fields.stress.pressure[c] += stress.pressure;
      fields.stress.slope[c] += stress.slope;
      fields.stress.viscosity[c] += stress.viscosity / std::max(phi, fraction_floor);
      if (phi > fraction_floor && ratios_.outside(phi, stokes)) ++use_.guarded;
    }
    use_.evaluations += std::uint64_t(end - begin);
  });
  boundaries_.fill_cells(fields.stress.pressure);
}

}  // namespace polybed::tfm
