#include "multiscale/card/bed_of_case.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "closures/bed_expansion.hpp"
#include "closures/hopper_discharge.hpp"
#include "closures/minimum_fluidisation.hpp"
#include "closures/mixture.hpp"
#include "closures/sphere.hpp"
#include "closures/terminal_velocity.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

using closures::CarriedBed;

constexpr double greatest_density_of_gas = 100;  // kg/m3; liquids begin far above

/// Constant before the first point and after the last, linear between.
double value_at(const std::vector<std::pair<double, double>>& points, double time) {
  if (points.empty()) return 0;
  const auto after = std::find_if(points.begin(), points.end(), [&](const auto& point) { return point.first >= time; });
  if (after == points.begin()) return points.front().second;
  if (after == points.end()) return points.back().second;
  const auto before = after - 1;
  const double share = (time - before->first) / (after->first - before->first);
  return before->second + share * (after->second - before->second);
}

/// Share of the bottom that a jet takes.
double share_of_bottom(const core::Column& column, const core::Jet& jet) {
  if (jet.from.empty() || jet.to.empty()) return 1;
  if (column.around_axis())
    return (jet.to[0] * jet.to[0] - jet.from[0] * jet.from[0]) / (column.size[0] * column.size[0]);
  double area = jet.to[0] - jet.from[0];
  const bool wide = jet.from.size() < 2 || jet.to.size() < 2;
  area *= wide ? column.size[2] : jet.to[1] - jet.from[1];
  return area / column.cross_section();
}

/// Mean over the bottom: jets have a velocity of their own on their part of it.
double velocity_at_end(const core::Scene& scene) {
  const double inlet = value_at(scene.inlet.superficial_velocity, scene.run.until);
  double mean = inlet;
  for (const core::Jet& jet : scene.jets)
    mean += share_of_bottom(scene.column, jet) * (value_at(jet.superficial_velocity, scene.run.until) - inlet);
  return mean;
}

/// Volume shares of the species, by the numbers of particles where the case has those; empty if it has neither.
std::vector<double> shares_of(const core::Scene& scene) {
  const std::size_t species = scene.species.size();
  std::vector<double> share = scene.bed.volume_share;
  if (scene.bed.particles.size() == species) {
    share.resize(species);
    for (std::size_t j = 0; j < species; ++j)
      share[j] = double(scene.bed.particles[j]) * std::pow(scene.species[j].diameter, 3);
  }
  const double sum = std::accumulate(share.begin(), share.end(), 0.0);
  if (share.size() != species || !(sum > 0)) return {};
  for (double& x : share) x /= sum;
  return share;
}

/// The balance of drag and weight in a scene.
struct Balance {
  std::optional<closures::DragLaw> law;
  double packed = 0;  ///< voidage of the settled bed; 0: not known

  [[nodiscard]] auto drag() const {
    return [this](double eps, double re) { return closures::pure_drag_at(*law, eps, re); };
  }
  [[nodiscard]] bool known() const { return law && packed > 0; }
  [[nodiscard]] std::optional<double> minimum_fluidisation(const CarriedBed& bed) const {
    if (!(bed.excess > 0 && bed.gravity > 0)) return {};
    if (known()) return closures::carrying_velocity(drag(), bed, packed);
    return closures::minimum_fluidisation(bed.diameter, bed.excess, bed.fluid_density, bed.viscosity, bed.gravity);
  }
};

Balance balance_of(const core::Scene& scene) {
  Balance balance;
  if (scene.effects.contains("drag")) balance.law = relevance::drag_law_of(scene);
  const double solids = scene.bed.solids_fraction;
  if (solids > 0 && solids < 1) balance.packed = 1 - solids;
  return balance;
}

/// What to expect of the whole bed at the velocity of its inlet.
void expect(const core::Scene& scene, const Balance& balance, const CarriedBed& mixture, BedOfCase& bed) {
  using enum Fluidisation;
  const double velocity = *bed.velocity;
  bed.state = velocity < *bed.minimum_fluidisation ? packed : fluidised;
  double fastest = 0;
  for (const SpeciesInFluid& species : bed.species) fastest = std::max(fastest, species.terminal.value_or(0));
  const bool rises = velocity > fastest;
  if (rises) bed.state = carried(scene);
  if (rises || !balance.known() || !(scene.bed.static_height > 0)) return;
  const double voidage = closures::carried_voidage(balance.drag(), mixture, velocity, balance.packed);
  if (voidage < 1) bed.height = scene.bed.static_height * (1 - balance.packed) / (1 - voidage);
}

/// Of the particles of a case over its opening, at their Sauter diameter and the solids fraction of the settled bed.
std::optional<ExpectedDischarge> expected_discharge(const core::Scene& scene, double gravity) {
  const std::vector<double> share = shares_of(scene);
  const bool counted = scene.bed.particles.size() == scene.species.size();
  if (!scene.dem.opening || !scene.walls.empty() || share.empty() || !counted ||
      !(scene.bed.solids_fraction > 0 && gravity > 0))
    return {};
  std::vector<double> diameter;
  double mass = 0, density = 0;
  for (std::size_t j = 0; j < share.size(); ++j) {
    const core::Species& species = scene.species[j];
    diameter.push_back(species.diameter);
    density += share[j] * species.density;
    mass += double(scene.bed.particles[j]) * species.density * closures::sphere_volume(species.diameter / 2);
  }
  const double mean = closures::sauter_diameter(share, diameter), width = *scene.dem.opening;
  const double depth = scene.column.dimensions == 2 ? scene.column.size[2] : 0;  // a slot; else a round hole
  return ExpectedDischarge{closures::hopper_discharge(width, depth, mean, scene.bed.solids_fraction * density, gravity),
                           mass, width / mean};
}

}  // namespace

Fluidisation carried(const core::Scene& scene) {
  return scene.column.outlet == core::Outlet::screen ? Fluidisation::carried_up : Fluidisation::carried_out;
}

bool is_carried(Fluidisation state) { return state == Fluidisation::carried_up || state == Fluidisation::carried_out; }

std::string name_of(Fluidisation state) {
  const char* names[] = {"", "packed", "fluidised", "carried_up", "carried_out"};
  return names[std::size_t(state)];
}

std::optional<double> BedOfCase::velocity_ratio() const {
  if (!velocity || !minimum_fluidisation || !(*minimum_fluidisation > 0)) return {};
  return *velocity / *minimum_fluidisation;
}

std::string geldart_class(double diameter, double excess) {
  const double d = 1e6 * diameter, density = 1e-3 * excess;
  if (d < 30) return "C";
  if (density * d < 225) return "A";
  return density * d * d > 1e6 ? "D" : "B";
}

BedOfCase bed_of_case(const core::Scene& scene) {
  BedOfCase bed;
  const double gravity = scene.column.gravity * std::max(0.0, -scene.column.down[1]);
  if (!scene.fluid.present()) {
    bed.discharge = expected_discharge(scene, gravity);
    return bed;
  }
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const Balance balance = balance_of(scene);
  for (const core::Species& species : scene.species) {
    const double excess = species.density - fluid.density;
    const CarriedBed alone{species.diameter, excess, fluid.density, fluid.viscosity, gravity};
    SpeciesInFluid& one = bed.species.emplace_back();
    one.name = species.name;
    one.minimum_fluidisation = balance.minimum_fluidisation(alone);
    if (excess != 0 && gravity > 0)
      (excess > 0 ? one.terminal : one.rising) =
          closures::settling_velocity(species.diameter, std::abs(excess), fluid.density, fluid.viscosity, gravity);
    if (fluid.density < greatest_density_of_gas) one.geldart = geldart_class(species.diameter, excess);
  }
  const std::vector<double> share = shares_of(scene);
  if (share.empty()) return bed;
  std::vector<double> diameter;
  double density = 0;
  for (std::size_t j = 0; j < share.size(); ++j) {
    diameter.push_back(scene.species[j].diameter);
    density += share[j] * scene.species[j].density;
  }
  const CarriedBed mixture{closures::sauter_diameter(share, diameter), density - fluid.density, fluid.density,
                           fluid.viscosity, gravity};
  bed.minimum_fluidisation = balance.minimum_fluidisation(mixture);
  const bool flows = !scene.column.closed && !(scene.inlet.superficial_velocity.empty() && scene.jets.empty());
  if (flows) bed.velocity = velocity_at_end(scene);
  if (flows && bed.minimum_fluidisation) expect(scene, balance, mixture, bed);
  return bed;
}

}  // namespace polybed::multiscale
