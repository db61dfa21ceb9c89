#include "dem/step_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/contact_pair.hpp"
#include "closures/dem_time_step.hpp"
#include "core/case/contact_properties.hpp"
#include "core/numerics/blocks.hpp"
#include "fluid/viscous_stress.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

namespace {

/// Shares of the limits for a step. Half the Rayleigh time, as in the short paper, suits one sphere; a fifth suits
/// dense contacts, whose limits add up.
constexpr double of_rayleigh = 0.2, of_stability = 0.2, of_diameter = 0.01;

/// Share of the stability limit above which a step from the case causes a warning.
constexpr double most_of_stability = 0.5;

/// Limit of a rotational spring, N m. The inertia of two unequal bodies is underestimated.
void add_rolling(const PairMaterial& pair, double stiffness, const std::string& name, std::vector<StepLimit>& all) {
  if (!(stiffness > 0)) return;
  const double inertia = closures::moment_of_inertia(pair.mass, pair.least_radius);
  all.push_back({fmt::format("rolling of {}", name), closures::dense_spring_step(inertia, stiffness)});
}

/// Limits of one pair of materials.
void add_pair(const core::Scene& scene, const Materials& materials, const PairLaws& laws, int kind,
              const std::string& name, double speed, bool synchronised, StepLimits& limits) {
  const double least_mass = materials.kinds()[std::size_t(kind)].mass;
  const NormalLaw& law = *laws.normal;
  const double overlap = law.overlap_of_impact(kind, speed), stiffness = law.stiffness_at(kind, overlap);
  std::vector<StepLimit>& all = limits.all;
  all.push_back({fmt::format("contact time of {}", name), law.contact_time(kind, speed) / scene.dem.steps_per_contact});
  all.push_back({fmt::format("oscillation of {}", name), closures::dense_spring_step(least_mass, stiffness)});
  const double omega = std::sqrt(stiffness / least_mass), damping = law.damping_ratio(kind);
  const double stable =
      synchronised ? closures::step_limit_synchronised(omega, damping) : closures::step_limit_thesis(omega, damping);
  all.push_back({fmt::format("damping of {}", name), of_stability * stable});
  if (limits.stability.name.empty() || stable < limits.stability.dt) limits.stability = {name, stable};
  if (laws.rolling)
    add_rolling(materials.kinds()[std::size_t(kind)],
                laws.rolling->stiffness(kind, law.force_at(kind, overlap) / overlap), name, all);
}

/// The fluid's step is at least one step of the particles, and its explicit viscous stress must not carry motion over a
/// cell in it. The margin is as large as for the default of dem.fluid_every.
void add_viscosity(const core::Scene& scene, std::vector<StepLimit>& all) {
  if (!scene.fluid.present() || scene.column.shear_rate != 0 || !core::acts(scene, "fluid_stress")) return;
  constexpr double courant = 0.5;
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const double rate = 2 * fluid.viscosity / fluid.density * fluid::viscous_rate(core::grid_of(scene, nullptr));
  all.push_back({"viscosity of the fluid", courant / rate});
}

}  // namespace

StepLimits step_limits(const core::Scene& scene, const Materials& materials, const PairLaws& laws, double speed) {
  StepLimits limits;
  limits.greatest_speed = speed;
  const double ratio = materials.greatest_diameter() / materials.least_diameter();
  const core::DemIntegrator integrator = scene.dem.integrator;
  const auto& kinds = materials.kinds();
  const bool rough = std::any_of(kinds.begin(), kinds.end(), [](const PairMaterial& m) { return m.friction > 0; });
  const bool unequal = laws.tangential && rough && ratio >= 3;
  limits.synchronised =
      integrator == core::DemIntegrator::synchronised || (integrator == core::DemIntegrator::automatic && unequal);
  limits.integrator_reason = integrator != core::DemIntegrator::automatic
                                 ? "as the case says"
                                 : (unequal ? fmt::format("friction and a size ratio of {:.3g}, at least 3", ratio)
                                            : fmt::format("no friction or a size ratio of {:.3g}, below 3", ratio));
  const auto& species = materials.species();
  for (std::size_t a = 0; a < species.size(); ++a) {
    for (std::size_t b = a; b <= species.size(); ++b) {
      const bool wall = b == species.size();
      const int kind = wall ? materials.stiffest_wall_kind(int(a)) : materials.kind(int(a), int(b));
      add_pair(scene, materials, laws, kind, fmt::format("{} and {}", species[a].name, wall ? "wall" : species[b].name),
               speed, limits.synchronised, limits);
    }
    const core::ContactProperties own = core::contact_properties(scene, species[a].name, species[a].name);
    const closures::Elastic material{own.first.youngs_modulus, own.first.poisson_ratio};
    limits.all.push_back(
        {fmt::format("Rayleigh time of {}", species[a].name),
         of_rayleigh * closures::rayleigh_time(species[a].radius, species[a].density, closures::shear_modulus(material),
                                               material.poisson_ratio)});
    limits.all.push_back({fmt::format("speed of {}", species[a].name), of_diameter * 2 * species[a].radius / speed});
  }
  add_viscosity(scene, limits.all);
  std::stable_sort(limits.all.begin(), limits.all.end(),
                   [](const StepLimit& a, const StepLimit& b) { return a.dt < b.dt; });
  limits.dt = limits.all.front().dt;
  limits.limited_by = limits.all.front().name;
  if (scene.dem.fixed_step) {
    limits.dt = *scene.dem.fixed_step;
    limits.limited_by = "dem.fixed_step";
    if (limits.dt > most_of_stability * limits.stability.dt)
      limits.warning = fmt::format(
          "dem.fixed_step = {:.3g} s is {:.2g} of {:.3g} s, beyond which a contact of {} grows without bound; several "
          "contacts at once lower that limit: at most {:.2g} of it is sound",
          limits.dt, limits.dt / limits.stability.dt, limits.stability.dt, limits.stability.name, most_of_stability);
  }
  return limits;
}

}  // namespace polybed::dem
