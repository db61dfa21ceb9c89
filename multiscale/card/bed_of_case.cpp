#include "multiscale/card/bed_of_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "closures/mixture.hpp"
#include "closures/sphere.hpp"
#include "closures/terminal_velocity.hpp"
#include "core/case/layers.hpp"
#include "measures/table.hpp"
#include "multiscale/card/discharge.hpp"
#include "multiscale/card/first_steady.hpp"
#include "multiscale/card/joined_box.hpp"
#include "multiscale/card/layer_bed.hpp"
#include "relevance/advised_drag.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

using closures::CarriedBed;

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

/// Area of a jet or discharge over the bottom's.
template <class Part>
double share_of_bottom(const core::Column& column, const Part& jet) {
  if (jet.from.empty() || jet.to.empty()) return 1;
  if (column.around_axis())
    return std::numbers::pi * (jet.to[0] * jet.to[0] - jet.from[0] * jet.from[0]) / column.cross_section();
  double area = jet.to[0] - jet.from[0];
  area *= jet.from.size() < 2 || jet.to.size() < 2 ? column.size[2] : jet.to[1] - jet.from[1];  // depth in 2-D
  return area / column.cross_section();
}

/// Total inflow over the bottom's area: jets replace the inlet's velocity on their part of it, or add from a side.
double velocity_at_end(const core::Scene& scene) {
  const double inlet = value_at(scene.inlet.superficial_velocity, scene.run.until);
  double mean = inlet;
  for (const core::Jet& jet : scene.jets)
    mean += share_of_bottom(scene.column, jet) *
            (value_at(jet.superficial_velocity, scene.run.until) - (is_side(jet.at) ? 0 : inlet));
  for (const core::Discharge& discharge : scene.discharges)
    if (!is_side(discharge.at)) mean -= share_of_bottom(scene.column, discharge) * inlet;
  return mean;
}

/// Volume shares of the species, from the numbers of particles if the case has them; empty if it has neither.
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

Balance balance_of(const core::Scene& scene) {
  Balance balance;
  const double solids = core::settled_fractions(scene).of_bed;
  if (solids > 0 && solids < 1) balance.packed = 1 - solids;
  if (!scene.drag().given) return balance;
  balance.law = relevance::drag_law_of(scene);
  if (balance.known()) balance.name = scene.drag().name;
  return balance;
}

/// Discharges in the sides that begin below a height: number and lower edge, m.
std::vector<std::pair<std::size_t, double>> discharges_below(const core::Scene& scene, double height) {
  std::vector<std::pair<std::size_t, double>> found;
  for (std::size_t n = 0; n < scene.discharges.size(); ++n) {
    const core::Discharge& discharge = scene.discharges[n];
    const double low = discharge.from.empty() ? 0 : discharge.from.back();  // the height comes last
    const auto& given = discharge.superficial_velocity;
    const bool flows =
        discharge.pressure || std::any_of(given.begin(), given.end(), [](auto& one) { return one.second > 0; });
    if (is_side(discharge.at) && flows && low < height) found.emplace_back(n + 1, low);
  }
  return found;
}

/// Predicts the whole bed at the velocity of its inlet. \param share  of each species
void expect(const core::Scene& scene, const Slices& slices, const Balance& balance, std::vector<double> share,
            const relevance::FluidConstants& fluid, double gravity, BedOfCase& bed) {
  using enum Fluidisation;
  const double velocity = *bed.velocity;
  for (std::size_t j = 0; j < share.size(); ++j)
    if (share[j] > 0 && least_velocity(scene.column, velocity) > bed.species[j].terminal.value_or(0)) {
      share[j] = 0;
      bed.leaving.push_back(bed.species[j].name);
    }
  const double stays = std::accumulate(share.begin(), share.end(), 0.0);
  if (!(stays > 0)) {
    bed.state = carried(scene);
    bed.leaving.clear();
    bed.steady.why = "the fluid carries all solids to the top";
    return;
  }
  const std::vector<LayerBed> layers = layers_of(scene, slices, share, fluid, gravity);
  const std::vector<double> lifting = lifting_velocities(balance, layers, *bed.own.minimum_fluidisation);
  const double first = *std::min_element(lifting.begin(), lifting.end());
  bed.state = velocity < first ? packed : bed.inlet && *bed.inlet < first ? partly_fluidised : fluidised;
  if (bed.state == fluidised)
    bed.resting =
        std::size_t(std::count_if(lifting.begin(), lifting.end(), [velocity](double one) { return one > velocity; }));
  const CarriedBed bed_of_those = mixture_of(scene, share, fluid, gravity);
  const double solids = stays * scene.column.even_height(scene.bed.static_height) * scene.bed.solids_fraction;
  const auto fill_by = [&](const Balance& one) { return one.height(slices, bed_of_those, velocity, solids); };
  const auto height_of = [](const std::optional<Filled>& filled) {
    return filled ? std::optional(filled->height) : std::nullopt;
  };
  const auto set_height = [&](const Balance& one, ByLaw& by) {
    by.height = height_of(fill_by(one));
    if (layers.empty()) return;
    by.mixed = by.height;
    by.height = sum_over(layers, [&](const LayerBed& layer) {
      return height_of(layer.of(one).height({}, layer.bed, velocity, layer.solids));
    });
  };
  set_height(balance, bed.own);
  if (bed.state == fluidised && slices.empty() && balance.known() && !scene.bed.held) {
    bed.no_balance = solids > 0 && !bed.own.height;
    const bool mixed = layers.empty() && scene.jets.empty() && fluid.density >= relevance::lightest_liquid;
    std::vector<double> of_each = share;
    for (double& one : of_each) one *= solids / stays;
    if (mixed) bed.parted = parted(scene, balance, layers_of_species(scene, of_each, fluid, gravity), velocity);
  }
  if (bed.own.height && !scene.bed.held) bed.discharges = discharges_below(scene, *bed.own.height);
  bed.turns_over = bed.state == fluidised && turns_over(balance, layers, velocity);
  if (bed.state == packed && slices.empty())
    bed.packed_drop = layers.empty() ? balance.packed_drop(bed_of_those, velocity, solids)
                                     : sum_over(layers, [&](const LayerBed& layer) {
                                         return layer.of(balance).packed_drop(layer.bed, velocity, layer.solids);
                                       });
  if (const auto filled = fill_by(balance); filled && !slices.empty() && bed.state == fluidised) {
    bed.lift = filled->solids * bed_of_those.excess * gravity;
    bed.top_heavy = scene.column.is_tapered() && slices.widens_to(filled->height);
  }
  Balance other = balance;
  for (ByLaw& one : bed.others) {
    other.law = relevance::with_shape(relevance::drag_law_named(one.law), scene);
    set_height(other, one);
  }
  const bool loose = layers.empty() && scene.bed.start_solids_fraction < scene.bed.solids_fraction;
  const double at_start = 1 - scene.bed.start_solids_fraction, all = solids / stays;
  const double start = !loose ? bed.settled
                       : slices.empty()
                           ? all / (1 - at_start)
                           : height_of(fill(slices, all, [&](std::size_t) { return 1 - at_start; })).value_or(0);
  const double carried = loose ? balance.minimum_fluidisation(bed_of_those, at_start).value_or(first) : first;
  bed.steady = first_steady(scene, slices, bed, start, carried);
}

/// From the rows in docs/record/validation.md with this kind of bed.
std::string validity_of(const core::Scene& scene, bool gas) {
  const std::string none = "no measured bed of this kind";
  if (!scene.jets.empty() || !scene.walls.empty() || scene.column.is_tapered()) return none;
  if (gas)
    return "two measured gas beds by polybed tfm: the height of one comes out 12 % low, u_mf of the other 19 % high";
  if (scene.species.size() == 1)
    return "liquid beds of one size by polybed tfm, beside Richardson and Zaki: voidage at most 0.03 too high by "
           "di_felice, 0.05 by wen_yu and cello";
  if (scene.species.size() == 2 && scene.species[0].density != scene.species[1].density)
    return "one measured liquid bed of two sizes: mixed from 28.2 to 34.3 mm/s by cello, 30 measured";
  return none;
}

/// Masses of the species at the start, kg; empty if the case does not give them.
std::vector<std::pair<std::string, double>> masses_of(const core::Scene& scene) {
  const std::vector<double> share = shares_of(scene);
  const core::Bed& start = scene.bed;
  const bool counted = start.particles.size() == scene.species.size();
  const double solids = scene.column.even_height(start.static_height) * start.solids_fraction;
  std::vector<std::pair<std::string, double>> masses;
  if (share.empty() || !(counted || solids > 0)) return masses;
  std::vector<std::string> names;
  for (const core::Species& species : scene.species) names.push_back(species.name);
  for (const measures::Kind& kind : measures::named_species(names)) {
    double mass = 0;
    for (const std::size_t j : kind.members)
      mass += scene.species[j].density *
              (counted ? double(start.particles[j]) * closures::sphere_volume(scene.species[j].diameter / 2)
                       : share[j] * solids * scene.column.cross_section());
    masses.emplace_back(kind.name, mass);
  }
  return masses;
}

/// The bounds of the fluidisation of several species, and its dependence on the packing.
void add_spread(const Balance& balance, const CarriedBed& mixture, BedOfCase& bed) {
  constexpr double other = 0.025, least = 1.05;  // of the settled solids fraction; ratio of velocities
  const auto by = [](const SpeciesInFluid& one) { return one.minimum_fluidisation.value_or(0); };
  const auto [first, last] = std::minmax_element(bed.species.begin(), bed.species.end(),
                                                 [&](const auto& a, const auto& b) { return by(a) < by(b); });
  if (by(*first) > 0 && by(*last) > least * by(*first)) bed.first = *first, bed.last = *last;
  if (!balance.known()) return;
  for (const double solids : {1 - balance.packed - other, 1 - balance.packed + other})
    if (const auto velocity = balance.minimum_fluidisation(mixture, 1 - solids); velocity && solids > 0)
      bed.by_packing.emplace_back(solids, *velocity);
}

/// Height of the settled bed, m; with layers the top of the highest, each at its own solids fraction.
double settled_height(const core::Scene& scene, const Slices& slices) {
  if (slices.between_walls) {
    const auto bed = fill(slices, scene.column.even_height(scene.bed.static_height), [](std::size_t) { return 1.0; });
    return bed ? bed->height : scene.bed.static_height;
  }
  if (scene.layers.empty()) return scene.bed.static_height;
  std::vector<double> height;
  for (const core::Layer& layer : scene.layers) height.push_back(layer.height);
  return core::top_of(core::stacked(core::start_parts(scene), height));
}

/// Everything except the velocities of an expansion and the other formulas of the shape.
BedOfCase bed_without_expansion(const core::Scene& scene, const Slices& slices) {
  BedOfCase bed;
  bed.settled = settled_height(scene, slices);
  bed.masses = masses_of(scene);
  if (scene.places.has("inlet.flow_rate")) bed.area = scene.column.cross_section();
  if (scene.column.dimensions == 2 && !scene.column.depth && !scene.column.around_axis())
    bed.assumed_depth = scene.column.size[2];
  const double gravity = scene.column.gravity * std::max(0.0, -scene.column.down[1]);
  if (!scene.fluid.present()) {
    bed.discharge = expected_discharge(scene, shares_of(scene), gravity);
    return bed;
  }
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const Balance balance = balance_of(scene);
  const std::vector<double> settled = core::settled_fractions(scene).of_species;
  for (const core::Species& species : scene.species) {
    const double excess = species.density - fluid.density;
    const CarriedBed alone{species.diameter, excess, fluid.density, fluid.viscosity, gravity};
    SpeciesInFluid& one = bed.species.emplace_back();
    one.name = species.name;
    Balance of_one = balance;
    if (balance.law) of_one.law = balance.law->alone(bed.species.size() - 1);
    one.minimum_fluidisation = of_one.minimum_fluidisation(alone, 1 - settled[bed.species.size() - 1]);
    if (excess != 0 && gravity > 0)
      (excess > 0 ? one.terminal : one.rising) =
          closures::settling_velocity(species.diameter, std::abs(excess), fluid.density, fluid.viscosity, gravity,
                                      relevance::shape_of(scene, species));
    if (fluid.density < relevance::lightest_liquid) one.geldart = geldart_class(species.diameter, excess);
  }
  const std::vector<double> share = shares_of(scene);
  if (share.empty()) return bed;
  const bool gas = fluid.density < relevance::lightest_liquid;
  const CarriedBed mixture = mixture_of(scene, share, fluid, gravity);
  if (scene.flows_around()) {
    bed.joined = joined_box_of(scene, balance, share);
    bed.own.law = balance.name;
    for (SpeciesInFluid& one : bed.species) one.minimum_fluidisation.reset();
    return bed;
  }
  bed.own = {balance.name, balance.minimum_fluidisation(mixture), {}};
  add_spread(balance, mixture, bed);
  const bool flows = !scene.column.closed && !(scene.inlet.superficial_velocity.empty() && scene.jets.empty());
  if (flows) bed.velocity = velocity_at_end(scene);
  if (flows && !scene.jets.empty()) bed.inlet = value_at(scene.inlet.superficial_velocity, scene.run.until);
  const bool any = scene.bed.static_height > 0 || !scene.bed.particles.empty();
  if (!flows || !any || !bed.own.minimum_fluidisation) return bed;
  if (balance.known() && !scene.bed.held) {
    Balance other = balance;
    for (const std::string& law :
         relevance::laws_of_beds(gas ? relevance::DragScene::gas_bed : relevance::DragScene::liquid_bed)) {
      other.law = relevance::with_shape(relevance::drag_law_named(law), scene);
      bed.others.push_back({law, other.minimum_fluidisation(mixture), {}});
    }
    bed.validity = validity_of(scene, gas);
  }
  expect(scene, slices, balance, share, fluid, gravity, bed);
  return bed;
}

/// The velocity at which a law in `bed.others` predicts the height; nothing if a species leaves the column before.
std::optional<double> velocity_for(core::Scene scene, const Slices& slices, const BedOfCase& bed, std::size_t law,
                                   double height) {
  constexpr double greatest = 100, step = 1.05;  // in units of u_mf, at which no bed expands this far
  const auto reaches = [&](double velocity) -> std::optional<bool> {
    scene.inlet.superficial_velocity = {{0.0, velocity}};
    const BedOfCase moved = bed_without_expansion(scene, slices);
    const std::optional<double>& found = moved.others[law].height;
    return found && moved.leaving.empty() ? std::optional(*found >= height) : std::nullopt;
  };
  double start = *bed.others[law].minimum_fluidisation;
  for (int n = 0; n < 20 && reaches(start).value_or(false); ++n) start /= 2;  // layers can lift before a mixture
  for (double high = step * start; high < greatest * start; high *= step) {
    const std::optional<bool> reached = reaches(high);
    if (!reached) return {};
    if (!*reached) continue;
    double low = high / step;
    for (int n = 0; n < 12; ++n) {  // to 1e-5 of the velocity
      const double middle = (low + high) / 2;
      (reaches(middle).value_or(true) ? high : low) = middle;
    }
    return high;
  }
  return {};
}

void add_expansion(const core::Scene& scene, const Slices& slices, BedOfCase& bed) {
  const bool gas = !bed.species.empty() && !bed.species.front().geldart.empty();
  const bool side_by_side = std::any_of(scene.layers.begin(), scene.layers.end(),
                                        [](const core::Layer& layer) { return !layer.from.empty(); });
  if (gas || !bed.own.height || scene.column.is_tapered() || !scene.jets.empty() || side_by_side) return;
  for (const double share : {0.1, 0.3, 0.5}) {
    ExpansionAt found{share, std::numeric_limits<double>::max(), 0};
    for (std::size_t law = 0; law < bed.others.size(); ++law) {
      const double height = (1 + share) * bed.settled;
      const std::optional<double> velocity = height < scene.column.size[1] && bed.others[law].minimum_fluidisation
                                                 ? velocity_for(scene, slices, bed, law, height)
                                                 : std::nullopt;
      if (!velocity) return;
      found.least = std::min(found.least, *velocity);
      found.most = std::max(found.most, *velocity);
      if (bed.others[law].law == bed.own.law) found.own = velocity;
    }
    if (found.most > 0) bed.expansion.push_back(found);
  }
}

}  // namespace

bool overflows(const core::Scene& scene, const BedOfCase& bed) {
  return scene.column.outlet == core::Outlet::open && bed.own.height && *bed.own.height >= scene.column.size[1];
}

double least_velocity(const core::Column& column, double velocity) {
  if (!column.is_tapered()) return velocity;
  const double narrowing = column.diameter_at(core::ColumnFace::bottom) / column.widest();
  return velocity * narrowing * narrowing;
}

Fluidisation carried(const core::Scene& scene) {
  return scene.column.outlet == core::Outlet::open ? Fluidisation::carried_out : Fluidisation::carried_up;
}

bool is_carried(Fluidisation state) { return state == Fluidisation::carried_up || state == Fluidisation::carried_out; }

std::string name_of(Fluidisation state) {
  const char* names[] = {"", "packed", "fluidised", "carried_up", "carried_out", "partly_fluidised"};
  return names[std::size_t(state)];
}

std::optional<double> BedOfCase::velocity_ratio() const {
  const std::optional<double>& least = own.minimum_fluidisation;
  return velocity && *velocity >= 0 && least && *least > 0 ? std::optional(*velocity / *least) : std::nullopt;
}

std::string geldart_class(double diameter, double excess) {
  const double d = 1e6 * diameter, density = 1e-3 * excess;
  if (d < 30) return "C";
  if (density * d < 225) return "A";
  return density * d * d > 1e6 ? "D" : "B";
}

BedOfCase bed_of_case(const core::Scene& scene) {
  const Slices slices = slices_of(scene);
  BedOfCase bed = bed_without_expansion(scene, slices);
  add_expansion(scene, slices, bed);
  for (const std::string& shape : relevance::other_shapes(scene)) {
    core::Scene other = scene;
    other.effects["shape"] = shape;
    const BedOfCase found = bed_without_expansion(other, slices);
    bed.shapes.push_back({shape, found.own.minimum_fluidisation, found.own.height});
  }
  return bed;
}

}  // namespace polybed::multiscale
