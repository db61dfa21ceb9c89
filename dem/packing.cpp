#include "dem/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "closures/sphere.hpp"
#include "core/case/layers.hpp"
#include "core/case/particle_list.hpp"
#include "core/error.hpp"
#include "core/numerics/random.hpp"
#include "dem/hard_spheres.hpp"

namespace polybed::dem {

namespace {

/// Solids fraction to which random particles are pushed apart quickly; a denser bed must settle.
constexpr double loose = 0.55;

enum Sequence : std::uint64_t { speed_x = 3, speed_y, speed_z };

/// Over the least diameter: the largest initial gap of pairs. Among gaps up to 0.15, 0.2 and 0.25 this one comes
/// nearest to a fluid of hard spheres at a fraction of 0.5.
constexpr double gap = 0.2;

Particle particle(const Materials& materials, std::int32_t species, std::int64_t id) {
  const Species& s = materials.species()[std::size_t(species)];
  return {{{0, 0, 0}, s.radius}, {{0, 0, 0}, 1 / s.mass, {0, 0, 0}, 1 / s.inertia}, {}, id, species};
}

std::vector<Particle> listed(const core::Scene& scene, const Materials& materials) {
  const core::ParticleList list = core::read_particle_list(scene);
  std::vector<Particle> particles;
  particles.reserve(list.species.size());
  for (std::size_t n = 0; n < list.species.size(); ++n) {
    Particle p = particle(materials, list.species[n], std::int64_t(n));
    p.place.x = list.position[n];
    p.motion.v = list.velocity[n];
    p.motion.w = list.spin[n];
    particles.push_back(p);
  }
  return particles;
}

/// Particles mixed with each other at the start: numbers of each species, and their region.
struct Group {
  std::vector<std::int64_t> numbers;
  Region region;
};

/// Height above which the particles are placed, m: the top of the inner walls, between which they lie in a fluid.
double floor_of(const core::Scene& scene) {
  double top = 0;
  for (const core::InnerWall& wall : scene.walls)
    if (!scene.fluid.present())
      top = std::max({top, wall.from[1] + 0.5 * wall.thickness, wall.to[1] + 0.5 * wall.thickness});
  return top;
}

/// Raises a height so that the room between the walls below it is what the room of the column was. Measured on points
/// a hundredth of the column apart.
double raised_between(const core::InnerWalls& walls, const core::Column& column, double height) {
  constexpr int points = 100;
  const auto n = [&](std::size_t a) { return column.dimensions == 2 && a == 2 ? 1 : points; };
  const auto place = [&](std::size_t a, int i) { return (i + 0.5) * column.size[a] / n(a); };
  const double step = column.size[1] / n(1);
  double room = 0, top = 0;
  for (int j = 0; j < n(1) && room < height; ++j) {
    int open = 0, all = 0;
    for (int k = 0; k < n(2); ++k)
      for (int i = 0; i < n(0); ++i) {
        const double x = place(0, i) - 0.5 * column.size[0], z = place(2, k) - 0.5 * column.size[2];
        if (column.is_round() && std::hypot(x, z) > 0.5 * column.size[0]) continue;
        ++all;
        open += walls.nearest({place(0, i), place(1, j), place(2, k)}).distance > 0 ? 1 : 0;
      }
    const double here = step * open / all, share = here > 0 ? std::min(1.0, (height - room) / here) : 1;
    room += here;
    top = (j + share) * step;
  }
  return room < height ? top + height - room : top;
}

/// Numbers of each species in a part of the bed.
std::vector<std::int64_t> numbers_in(const core::BedPart& part, const Materials& materials,
                                     const core::Column& column) {
  const double area = part.area() * column.cross_section();
  std::vector<std::int64_t> numbers;
  for (std::size_t j = 0; j < part.solids.size(); ++j)
    numbers.push_back(std::llround(part.solids[j] * area / closures::sphere_volume(materials.species()[j].radius)));
  return numbers;
}

/// Initial solids fraction of a part's particles.
double start_fraction(const core::BedPart& part) {
  return part.solids_fraction > 0 ? std::min(loose, part.solids_fraction) : loose;
}

/// Height of particles over a part's area at the initial solids fraction, m; in a tapered column as if it were as wide
/// as at the bottom.
double height_of(const std::vector<std::int64_t>& numbers, const core::BedPart& part, const Materials& materials,
                 const core::Column& column) {
  const double area = part.area() * column.cross_section();
  double height = 0;
  for (std::size_t j = 0; j < numbers.size(); ++j)
    height +=
        double(numbers[j]) * closures::sphere_volume(materials.species()[j].radius) / (area * start_fraction(part));
  return height;
}

/// The groups of a bed, each as high as the volume of its particles needs; at random or from a checkpoint, one in the
/// whole box.
std::vector<Group> groups_of(const core::Scene& scene, const Materials& materials, const Box& box) {
  const std::vector<core::BedPart> parts = core::start_parts(scene);
  std::vector<Group> groups;
  std::vector<double> height;
  for (const core::BedPart& part : parts) {
    groups.push_back({numbers_in(part, materials, scene.column), {}});
    height.push_back(height_of(groups.back().numbers, part, materials, scene.column));
  }
  const core::Column& column = scene.column;
  const double floor = floor_of(scene), below = column.even_height(floor);
  std::vector<core::Extent> extents = core::stacked(parts, height);
  for (core::Extent& one : extents)
    one = {column.filled_height(below + one.low), column.filled_height(below + one.high)};
  constexpr double rounding = 1.01;  // of the numbers of particles
  if (scene.flows_around())
    for (core::Extent& one : extents)
      if (one.high < rounding * box.size[1]) one.high = std::min(one.high, box.size[1]);
  std::shared_ptr<const core::InnerWalls> walls;
  if (scene.fluid.present() && !scene.walls.empty()) {
    walls = std::make_shared<core::InnerWalls>(scene.walls, column.size, false);
    for (core::Extent& one : extents) one.high = raised_between(*walls, column, one.high);
  }
  // Particles from a checkpoint can be anywhere in the box and replace these.
  if (scene.bed.start.kind == core::StartKind::random || scene.bed.start.kind == core::StartKind::checkpoint)
    extents.assign(parts.size(), {floor, box.size[1]});
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const core::BedPart& part = parts[n];
    groups[n].region = {{part.from[0] * box.size[0], extents[n].low, part.from[1] * box.size[2]},
                        {part.to[0] * box.size[0], extents[n].high, part.to[1] * box.size[2]},
                        box.round,
                        box.side,
                        0,
                        walls};
  }
  return groups;
}

/// Top of the groups, m.
double top_of(const std::vector<Group>& groups) {
  double top = 0;
  for (const Group& group : groups) top = std::max(top, group.region.high[1]);
  return top;
}

/// Sets velocities of a granular temperature, without net momentum.
void set_in_motion(std::vector<Particle>& particles, double speed, std::uint64_t seed) {
  if (speed <= 0 || particles.empty()) return;
  Vector momentum{};
  double mass = 0;
  for (Particle& p : particles) {
    for (std::size_t k = 0; k < 3; ++k) {
      p.motion.v[k] = speed * core::normal(seed, speed_x + k, std::uint64_t(p.id));
      momentum[k] += p.motion.v[k] / p.motion.inverse_mass;
    }
    mass += 1 / p.motion.inverse_mass;
  }
  for (Particle& p : particles)
    for (std::size_t k = 0; k < 3; ++k) p.motion.v[k] -= momentum[k] / mass;
}

/// Sets the flow of a sheared box at the start, with the spin of its vorticity: friction alone would need tens of
/// strains if contacts are few, and its torque would be part of the stress until then.
void shear(std::vector<Particle>& particles, double rate) {
  for (Particle& p : particles) {
    p.motion.v[0] += rate * p.place.x[1];
    p.motion.w[2] -= 0.5 * rate;
  }
}

/// Returns the result of push_apart(). \param group  of each particle
double place_without_overlap(std::vector<Particle>& particles, const std::vector<std::int32_t>& group,
                             const std::vector<Group>& groups, const Box& box, const Materials& materials,
                             std::uint64_t seed) {
  if (particles.empty()) return 0;
  std::vector<Region> region;
  std::vector<std::vector<Particle*>> together(groups.size());
  double volume = 0, room = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto n = std::size_t(group[i]);
    region.push_back(groups[n].region);
    together[n].push_back(&particles[i]);
    volume += closures::sphere_volume(particles[i].place.radius);
  }
  for (std::size_t n = 0; n < groups.size(); ++n) {
    if (together[n].empty()) continue;
    room += groups[n].region.volume();
    spread(together[n], groups[n].region, seed);
  }
  HardSpheres spheres(particles, region, box, materials);
  if (const double overlap = push_apart(spheres, gap * materials.least_diameter()); overlap > 0) return overlap;
  equilibrate(spheres, materials.least_diameter(), volume / room, seed);
  spheres.give_back(particles);
  return 0;
}

/// Why the particles of a group do not fit in it; empty if they do.
std::string no_room_in(const Group& group, const Materials& materials, const Box& box) {
  const Vector &low = group.region.low, &high = group.region.high;
  for (std::size_t j = 0; j < group.numbers.size(); ++j) {
    const double diameter = 2 * materials.species()[j].radius;
    if (group.numbers[j] == 0) continue;
    if (const double room = high[1] - low[1]; room < diameter && !box.periodic[1])
      return fmt::format(
          "their bed is {:.4g} m high, less than a particle, {:.4g} m: take more of them, or a smaller "
          "bed.start_solids_fraction",
          room, diameter);
    for (const std::size_t k : {0, 2})
      if (const double room = high[k] - low[k]; room < box.size[k] && room < diameter)
        return fmt::format("a layer is {:.4g} m {}, less than a particle, {:.4g} m: move layer.from and layer.to apart",
                           room, k == 0 ? "wide" : "deep", diameter);
  }
  return "";
}

}  // namespace

std::vector<std::int64_t> particle_numbers(const core::Scene& scene, const Materials& materials) {
  std::vector<std::int64_t> numbers(materials.species().size(), 0);
  for (const core::BedPart& part : core::start_parts(scene)) {
    const std::vector<std::int64_t> here = numbers_in(part, materials, scene.column);
    for (std::size_t j = 0; j < numbers.size(); ++j) numbers[j] += here[j];
  }
  return numbers;
}

double start_height(const core::Scene& scene, const Materials& materials, const Box& box) {
  const core::StartKind start = scene.bed.start.kind;
  if (start != core::StartKind::mixed && start != core::StartKind::layered && start != core::StartKind::settled)
    return box.size[1];
  return std::min(box.size[1], top_of(groups_of(scene, materials, box)));
}

std::string no_room_for(const core::Scene& scene, const Materials& materials, const Box& box) {
  if (scene.bed.start.kind == core::StartKind::list) return "";
  const std::vector<Group> groups = groups_of(scene, materials, box);
  const double top = top_of(groups), floor = floor_of(scene);
  if (top > box.size[1])
    return fmt::format(
        "they fill {:.4g} m of the column's height at a solids fraction of {:.3g}, which is more than it has{}, "
        "{:.4g} m: enlarge column.size",
        top - floor, start_fraction(core::start_parts(scene).front()), floor > 0 ? " above the top of [[wall]]" : "",
        box.size[1] - floor);
  for (const Group& group : groups)
    if (std::string wrong = no_room_in(group, materials, box); !wrong.empty()) return wrong;
  return "";
}

std::vector<Particle> start_particles(const core::Scene& scene, const Materials& materials, const Box& box) {
  if (scene.bed.start.kind == core::StartKind::list) return listed(scene, materials);
  const std::vector<Group> groups = groups_of(scene, materials, box);
  const std::uint64_t seed = scene.bed.seed;
  std::vector<Particle> particles;
  std::vector<std::int32_t> group;
  std::int64_t count = 0;
  for (const Group& one : groups) count = std::accumulate(one.numbers.begin(), one.numbers.end(), count);
  particles.reserve(std::size_t(count));
  group.reserve(std::size_t(count));
  for (std::size_t j = 0; j < materials.species().size(); ++j)
    for (std::size_t n = 0; n < groups.size(); ++n)
      for (std::int64_t k = 0; k < groups[n].numbers[j]; ++k) {
        particles.push_back(particle(materials, std::int32_t(j), std::int64_t(particles.size())));
        group.push_back(std::int32_t(n));
      }
  if (const double overlap = place_without_overlap(particles, group, groups, box, materials, seed); overlap > 0)
    throw core::StartError(std::vector{scene.places.problem(
        {"bed.start_solids_fraction", "bed.solids_fraction", "column.size"},
        fmt::format("bed: the particles do not fit: some still overlap by {:.2g} of their radius; give the bed more "
                    "room (column.size, bed.start_solids_fraction)",
                    overlap))});
  set_in_motion(particles, scene.dem.start_speed, seed);
  shear(particles, scene.column.shear_rate);
  return particles;
}

}  // namespace polybed::dem
