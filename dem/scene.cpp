#include "dem/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "closures/contact_pair.hpp"
#include "closures/drag_turton_levenspiel.hpp"
#include "closures/sphere.hpp"
#include "closures/terminal_velocity.hpp"
#include "core/error.hpp"
#include "dem/holes.hpp"
#include "dem/packing.hpp"
#include "fluid/inlet.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

namespace {

/// Contacts that fit around a particle, with partners of a radius: its surface over the area per partner, and at least
/// the number in a fully packed monodisperse bed.
double most_contacts(double radius, double partner) {
  const double ratio = radius / partner;
  return std::max(16.0, 4 * (ratio + 1) * (ratio + 1));
}

/// Walls in contact with a particle at once; two adjacent ones inside.
double most_walls(const core::Scene& scene) { return scene.walls.empty() && !scene.column.is_tapered() ? 3 : 5; }

/// Half the height of a round box's side over the box's: particles fly beyond an open top.
constexpr double beyond_the_top = 100;

void add_openings(const core::Scene& scene, Box& box) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  if (scene.dem.opening) {
    const double half = 0.5 * *scene.dem.opening;
    const Vector middle{0.5 * box.size[0], 0, 0.5 * box.size[2]};
    box.openings.push_back({1, 0, 0, middle, {half, endless, endless}, scene.column.dimensions == 3});
  }
  if (is_open_at_top(scene)) box.openings.push_back({1, 1, box.size[1], {}, {endless, endless, endless}});
  if (scene.bed.held) return;
  for (const Hole& hole : holes_of(scene, box)) box.openings.push_back(hole.opening);
}

/// Adds the inner walls, those of a tapered column, and the side of a round box. Walls of one shape join: a scene has
/// either flat or round ones.
void add_plates(const core::Scene& scene, Box& box) {
  const auto end_of = [](const std::vector<double>& end) { return InPlane{0.5 * end[0], end[1]}; };
  bool round = false;
  for (const core::InnerWall& wall : scene.walls) {
    round = round || wall.is_round();
    if (wall.is_round())
      box.add_cone(end_of(wall.from), end_of(wall.to), wall.thickness);
    else
      box.add_plate({wall.from[0], wall.from[1], wall.to[0], wall.to[1]}, wall.thickness);
  }
  for (const core::InnerWall& wall : core::walls_of_taper(scene.column)) {
    round = true;
    box.add_cone(end_of(wall.from), end_of(wall.to));
    if (wall.to[1] == scene.column.profile.back().first && wall.to[0] < box.size[0])  // else they would fall past it
      box.add_cone(end_of(wall.to), {0.5 * wall.to[0], beyond_the_top * box.size[1]});
  }
  const double radius = 0.5 * box.size[0], far = beyond_the_top * box.size[1];
  if (box.round) {
    box.side_plate = int(box.plates.size());
    box.add_cone({radius, -far}, {radius, far});
  }
  if (round) box.make_bottom_a_plate();
}

/// Speed of the mixture in discharges with a pressure, m/s: under a lid what enters leaves through one of them, and the
/// pressures outside and the weight of the starting bed above the lowest of them drive it as far as friction does not
/// hold it.
double speed_in_overflows(const core::Scene& scene, const relevance::FluidConstants& fluid) {
  const core::Column& column = scene.column;
  const bool lid = column.outlet == core::Outlet::lid;
  double entering = fluid::Ramp(scene.inlet.superficial_velocity).greatest() * column.cross_section();  // m3/s
  const auto see = [&](const auto& parts) {
    for (const auto& part : parts)
      entering += fluid::Ramp(part.superficial_velocity).greatest() * area_of(part.at, part.from, part.to, column);
  };
  see(scene.jets);
  see(scene.feeds);
  constexpr double endless = std::numeric_limits<double>::infinity();
  double least = lid ? endless : 0, most = lid ? -endless : 0, narrowest = endless, lowest = endless;
  for (const core::Discharge& d : scene.discharges) {
    if (!d.pressure) continue;
    least = std::min(least, *d.pressure);
    most = std::max(most, *d.pressure);
    narrowest = std::min(narrowest, area_of(d.at, d.from, d.to, column));
    lowest = std::min(lowest, d.from.empty() ? 0 : d.from.back());
  }
  if (narrowest == endless) return 0;
  double excess = 0;  // density of the solids over the fluid's
  for (std::size_t j = 0; j < scene.bed.volume_share.size() && j < scene.species.size(); ++j)
    excess += scene.bed.volume_share[j] * (scene.species[j].density - fluid.density);
  const double start = scene.bed.start_solids_fraction,
               high = start > 0 ? scene.bed.static_height * scene.bed.solids_fraction / start : 0,
               weight = std::abs(excess) * start * column.gravity * std::max(0.0, high - lowest);
  return (lid ? entering / narrowest : 0) + std::sqrt(2 * (most - least + weight) / fluid.density);
}

/// Speed of particles in a fluid: twice the terminal velocity of the fastest, or their initial speed, and the inflow;
/// or a channel's speed. \param first  speed at the start, m/s
double speed_in_fluid(const core::Scene& scene, double first) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  double fastest = first, inflow = 0;
  for (const core::Species& s : scene.species) {
    const auto drag = [shape = relevance::shape_of(scene, s)](double eps, double re) {
      return closures::DragTurtonLevenspiel{}(eps, re).f * shape(eps, re);
    };
    fastest = std::max(fastest, closures::terminal_velocity(drag, s.diameter, s.density - fluid.density, fluid.density,
                                                            fluid.viscosity, scene.column.gravity));
  }
  for (const auto& [t, u] : scene.inlet.superficial_velocity) inflow = std::max(inflow, u * scene.column.contraction());
  for (const core::Jet& jet : scene.jets)
    for (const auto& [t, u] : jet.superficial_velocity) inflow = std::max(inflow, u);
  for (const core::Discharge& discharge : scene.discharges)
    for (const auto& [t, u] : discharge.superficial_velocity) inflow = std::max(inflow, u);
  // Channels through a bed: particles in a settled bed reached 3 times the velocity between packed particles.
  const double channel = scene.bed.solids_fraction > 0 ? 4 * inflow / (1 - scene.bed.solids_fraction) : 0;
  return std::max({2 * (fastest + inflow), channel, 2 * (fastest + speed_in_overflows(scene, fluid))});
}

/// Greatest speed of a particle at rest after a collision, over the other's; at least 1.
double most_passed_on(const Materials& materials) {
  double most = 1;
  const auto& species = materials.species();
  for (int i = 0; i < int(species.size()); ++i)
    for (int j = 0; j < int(species.size()); ++j)
      most =
          std::max(most, closures::speed_passed_on(species[std::size_t(i)].mass, species[std::size_t(j)].mass,
                                                   materials.kinds()[std::size_t(materials.kind(i, j))].restitution));
  return most;
}

/// Greatest fall of a particle, m.
double fall_height(const core::Scene& scene, const Materials& materials, const Box& box,
                   const std::vector<Particle>& start) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (!box.periodic[k]) longest = std::max(longest, box.size[k]);
  if (box.periodic[1] || scene.column.down[1] != -1) return longest;
  double top = 0;
  if (scene.bed.start.kind == core::StartKind::list)
    for (const Particle& p : start) top = std::max(top, p.place.x[1]);
  else
    top = start_height(scene, materials, box);
  for (const core::Feed& feed : scene.feeds)
    if (feed.at != core::ColumnFace::bottom)
      top = std::max(top, is_side(feed.at) && !feed.to.empty() ? feed.to.back() : box.size[1]);
  // A leaving particle falls by another diameter before it is removed.
  const bool hole =
      std::any_of(box.openings.begin(), box.openings.end(), [](const Opening& o) { return o.is_bottom(); });
  return top + (hole ? materials.greatest_diameter() : 0);
}

}  // namespace

double area_of(core::ColumnFace at, const std::vector<double>& from, const std::vector<double>& to,
               const core::Column& column) {
  if (from.empty() && !is_side(at)) return column.cross_section(at);
  Vector width = column.size;
  for (std::size_t n = 0; n < from.size(); ++n)
    width[std::size_t(axis_along(at, column.dimensions, n))] = to[n] - from[n];
  width[std::size_t(axis_of(at))] = 1;
  return width[0] * width[1] * width[2];
}

Box bare_box_of(const core::Column& column) {
  Box box;
  box.size = column.size;
  box.periodic = {column.sides == core::Boundary::periodic, column.ends == core::Boundary::periodic,
                  column.dimensions == 2 || column.sides == core::Boundary::periodic};
  return box;
}

Box box_of(const core::Scene& scene) {
  const core::Column& column = scene.column;
  Box box = bare_box_of(column);
  box.shear_rate = scene.column.shear_rate;
  box.round = column.is_round();
  if (column.is_tapered()) box.side = TaperedSide(column);
  add_openings(scene, box);
  for (int axis = 0; axis < 3; ++axis) {
    if (box.periodic[std::size_t(axis)] || (box.round && axis != 1)) continue;
    box.walls.push_back({axis, 0, 0});
    // In a column without a fluid particles fly beyond the top, and gravity returns them, unless it is closed; the
    // screen of a column with a fluid stops them.
    if (axis != 1 || column.closed || (scene.fluid.present() && !is_open_at_top(scene)))
      box.walls.push_back({axis, 1, box.size[std::size_t(axis)]});
  }
  add_plates(scene, box);
  return box;
}

Vector gravity_of(const core::Scene& scene) {
  Vector g = scene.column.down;
  for (double& component : g) component *= scene.column.gravity;
  return g;
}

double skin_of(const core::Scene& scene, const Materials& materials) {
  return scene.dem.skin.value_or(0.1 * materials.least_diameter());
}

Speeds known_speeds(const core::Scene& scene, const Materials& materials, const Box& box,
                    const std::vector<Particle>& start) {
  if (scene.dem.greatest_speed) return {*scene.dem.greatest_speed, *scene.dem.greatest_speed};
  double first = 0;
  for (const Particle& p : start) first = std::max(first, std::hypot(p.motion.v[0], p.motion.v[1], p.motion.v[2]));
  for (const core::Feed& feed : scene.feeds) first = std::max(first, feed.velocity);
  if (scene.flows_around()) {  // a dry fall would not end
    const double wet = speed_in_fluid(scene, first);
    return {wet, wet};
  }
  const double fall = std::sqrt(first * first + 2 * scene.column.gravity * fall_height(scene, materials, box, start));
  const double shear = std::abs(box.image_speed());
  const Speeds dry{std::max(fall, shear), std::max(fall * most_passed_on(materials), shear)};
  if (!scene.fluid.present() || scene.column.shear_rate != 0) return dry;
  const double wet = speed_in_fluid(scene, first);
  return {std::min(dry.impact, wet), std::min(dry.greatest, wet)};
}

Speeds expected_speeds(const core::Scene& scene, const Materials& materials, const Box& box,
                       const std::vector<Particle>& start) {
  const Speeds known = known_speeds(scene, materials, box, start);
  if (known.greatest > 0) return known;
  if (start.empty() && scene.feeds.empty() && scene.dem.start_speed > 0)  // nothing moves: any step suffices
    return {scene.dem.start_speed, scene.dem.start_speed};
  if (!scene.dem.fixed_step)
    throw core::StartError(std::vector{scene.places.problem({"dem.greatest_speed", "column.gravity"}, unknown_speed)});
  double least = std::numeric_limits<double>::infinity();
  for (const Particle& p : start) least = std::min(least, 2 * p.place.radius);
  const double speed = 0.01 * least / *scene.dem.fixed_step;
  return {speed, speed};
}

FixedPoint force_unit(const core::Scene& scene, const Materials& materials, const PairLaws& laws, double speed) {
  // The dashpot and friction add hardly more than the elastic force for particles that their contacts can stop.
  constexpr double reserve = 4;
  const auto force = [&](int kind) {
    const PairMaterial& pair = materials.kinds()[std::size_t(kind)];
    const double overlap = scene.dem.max_overlap * 2 * pair.least_radius;
    const double dashpot =
        2 * laws.normal->damping_ratio(kind) * std::sqrt(pair.mass * laws.normal->stiffness_at(kind, overlap)) * speed;
    return std::max(laws.normal->force_at(kind, overlap), dashpot / (reserve - 1));
  };
  // Many fine particles push a coarse one with small forces each, a few coarse ones with large ones: the sums are
  // similar. Use their greatest, not the largest force times the largest number; otherwise a fine particle's torque is
  // lost in the unit of a wide mixture.
  double most = 0;
  const auto& species = materials.species();
  for (int i = 0; i < int(species.size()); ++i) {
    double sum = most_walls(scene) * force(materials.stiffest_wall_kind(i));
    for (int j = 0; j < int(species.size()); ++j)
      sum +=
          most_contacts(species[std::size_t(i)].radius, species[std::size_t(j)].radius) * force(materials.kind(i, j));
    most = std::max(most, sum);
  }
  laws.each_attraction([&](const CohesionLaw& law) {
    for (int kind = 0; kind < int(materials.kinds().size()); ++kind) most = std::max(most, law.pull_off(kind));
  });
  return FixedPoint::for_sums_of(reserve * most, 1);
}

FixedPoint torque_unit(const FixedPoint& force, const Materials& materials) {
  const double arm = std::ldexp(1.0, int(std::ceil(std::log2(0.5 * materials.greatest_diameter()))));
  return {force.per_unit / arm, force.unit * arm};
}

std::string no_room_for_images(const Box& box, std::size_t k, double greatest_diameter, double reach, double skin) {
  const bool sheared = box.shear_rate != 0;
  const double least = 2 * (greatest_diameter + reach + (sheared ? skin : 0));
  constexpr std::array<const char*, 3> names = {"width", "height", "depth"};
  if (!box.periodic[k] || box.size[k] >= least * (1 - 1e-12)) return "";
  return fmt::format(
             "{:.6g} m is periodic and must be at least {:.6g} m, two of the largest particles{}{}, or a particle "
             "touches another and its image",
             box.size[k], least, reach > 0 ? " and twice what they reach beyond contact" : "",
             sheared ? " and, as the box is sheared, twice the skin (dem.skin)" : "") +
         (k == 2 ? "" : fmt::format(" ({})", names[k]));
}

Content greatest_content(const Box& box, const Materials& materials) {
  const auto& species = materials.species();
  const double volume = box.size[0] * box.size[1] * box.size[2];
  const auto heaviest = std::max_element(species.begin(), species.end(),
                                         [](const Species& a, const Species& b) { return a.density < b.density; });
  return {volume, volume * heaviest->density};
}

bool is_open_at_top(const core::Scene& scene) {
  return scene.column.outlet == core::Outlet::open && !scene.column.closed && !scene.bed.held &&
         scene.column.ends != core::Boundary::periodic;
}

bool is_fed(const core::Scene& scene) { return !scene.feeds.empty() && scene.column.ends != core::Boundary::periodic; }

SolidsVolume volume_of(const std::vector<Particle>& particles, std::size_t species) {
  SolidsVolume volume{std::vector<double>(species, 0.0), 0};
  for (const Particle& p : particles) {
    volume.all += closures::sphere_volume(p.place.radius);
    volume.of[std::size_t(p.species)] += closures::sphere_volume(p.place.radius);
  }
  return volume;
}

}  // namespace polybed::dem
