#include "dem/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "closures/sphere.hpp"
#include "core/case/particle_list.hpp"
#include "core/error.hpp"
#include "core/numerics/random.hpp"
#include "dem/hard_spheres.hpp"

namespace polybed::dem {

namespace {

/// Solids fraction that random particles are pushed apart to in short time; a denser bed has to settle.
constexpr double loose = 0.55;

enum Sequence : std::uint64_t { speed_x = 3, speed_y, speed_z };

/// Of the least diameter: the largest gap at which pairs are held at first. Of gaps up to 0.15, 0.2 and 0.25 this one
/// comes nearest to a fluid of hard spheres at a fraction of 0.5.
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

/// Heights between which species may lie, m.
struct Layer {
  double low, high;
};

/// Solids fraction that the particles are placed at.
double start_fraction(const core::Scene& scene) {
  return scene.bed.start_solids_fraction > 0 ? std::min(loose, scene.bed.start_solids_fraction) : loose;
}

/// Height above which the particles are placed, m: the top of the walls inside.
double floor_of(const core::Scene& scene) {
  double top = 0;
  for (const core::InnerWall& wall : scene.walls) top = std::max({top, wall.from[1], wall.to[1]});
  return top;
}

/// Height of each species by itself, at the solids fraction of the start, m.
std::vector<double> heights(const core::Scene& scene, const Materials& materials, const Box& box,
                            const std::vector<std::int64_t>& numbers) {
  const double area = box.size[0] * box.size[2];
  std::vector<double> height;
  for (std::size_t j = 0; j < numbers.size(); ++j)
    height.push_back(double(numbers[j]) * closures::sphere_volume(materials.species()[j].radius) /
                     (area * start_fraction(scene)));
  return height;
}

/// Layers of a bed, each as high as the volume of its species needs; or one for all of them.
std::vector<Layer> layers(const core::Scene& scene, const Materials& materials, const Box& box,
                          const std::vector<std::int64_t>& numbers) {
  const std::vector<double> height = heights(scene, materials, box, numbers);
  double sum = std::accumulate(height.begin(), height.end(), 0.0);
  if (scene.bed.start.kind == core::StartKind::random) sum = box.size[1];
  const double floor = floor_of(scene);
  std::vector<Layer> layers(numbers.size(), {floor, floor + sum});
  if (scene.bed.start.kind != core::StartKind::layered) return layers;
  double low = floor;
  for (const std::vector<std::size_t>& members : core::layers_of(scene.bed, numbers.size())) {
    double high = low;
    for (const std::size_t j : members) high += height[j];
    for (const std::size_t j : members) layers[j] = {low, high};
    low = high;
  }
  return layers;
}

/// Velocities of a granular temperature, without net momentum.
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

/// The flow of a sheared box at the start, with the spin of its vorticity: friction alone would need tens of strains
/// for that where contacts are few, and meanwhile its torque is part of the stress.
void shear(std::vector<Particle>& particles, double rate) {
  for (Particle& p : particles) {
    p.motion.v[0] += rate * p.place.x[1];
    p.motion.w[2] -= 0.5 * rate;
  }
}

/// Returns what push_apart() does. \param layer  of each species
double place_without_overlap(std::vector<Particle>& particles, const std::vector<Layer>& layer, const Box& box,
                             const Materials& materials, std::uint64_t seed) {
  if (particles.empty()) return 0;
  std::vector<Region> region;
  double volume = 0, top = 0, bottom = box.size[1];
  std::map<std::pair<double, double>, std::vector<Particle*>> together;
  for (Particle& p : particles) {
    const Layer& own = layer[std::size_t(p.species)];
    region.push_back({{0, own.low, 0}, {box.size[0], own.high, box.size[2]}});
    together[{own.low, own.high}].push_back(&p);
    volume += closures::sphere_volume(p.place.radius);
    top = std::max(top, own.high);
    bottom = std::min(bottom, own.low);
  }
  for (auto& [heights, group] : together) spread(group, region[std::size_t(group.front()->id)], seed);
  HardSpheres spheres(particles, region, box, materials);
  if (const double overlap = push_apart(spheres, gap * materials.least_diameter()); overlap > 0) return overlap;
  equilibrate(spheres, materials.least_diameter(), volume / (box.size[0] * (top - bottom) * box.size[2]), seed);
  spheres.give_back(particles);
  return 0;
}

}  // namespace

std::vector<std::int64_t> particle_numbers(const core::Scene& scene, const Materials& materials, const Box& box) {
  if (!scene.bed.particles.empty()) return scene.bed.particles;
  const double solids = scene.bed.static_height * box.size[0] * box.size[2] * scene.bed.solids_fraction;
  std::vector<std::int64_t> numbers;
  for (std::size_t j = 0; j < materials.species().size(); ++j)
    numbers.push_back(
        std::llround(scene.bed.volume_share[j] * solids / closures::sphere_volume(materials.species()[j].radius)));
  return numbers;
}

double start_height(const core::Scene& scene, const Materials& materials, const Box& box) {
  const core::StartKind start = scene.bed.start.kind;
  if (start != core::StartKind::mixed && start != core::StartKind::layered && start != core::StartKind::settled)
    return box.size[1];
  const std::vector<double> height = heights(scene, materials, box, particle_numbers(scene, materials, box));
  return std::min(box.size[1], floor_of(scene) + std::accumulate(height.begin(), height.end(), 0.0));
}

std::string no_room_for(const core::Scene& scene, const Materials& materials, const Box& box) {
  if (scene.bed.start.kind == core::StartKind::list) return "";
  const std::vector<std::int64_t> numbers = particle_numbers(scene, materials, box);
  const std::vector<Layer> layer = layers(scene, materials, box, numbers);
  double top = 0;
  for (const Layer& one : layer) top = std::max(top, one.high);
  const double floor = floor_of(scene);
  if (top > box.size[1])
    return fmt::format(
        "they fill {:.4g} m of the column's height at a solids fraction of {:.3g}, which is more than it has{}, "
        "{:.4g} m: enlarge column.size",
        top - floor, start_fraction(scene), floor > 0 ? " above the top of [[wall]]" : "", box.size[1] - floor);
  for (std::size_t j = 0; j < layer.size() && !box.periodic[1]; ++j)
    if (const double room = layer[j].high - layer[j].low, diameter = 2 * materials.species()[j].radius;
        numbers[j] > 0 && room < diameter)
      return fmt::format(
          "their bed is {:.4g} m high, less than a particle, {:.4g} m: take more of them, or a smaller "
          "bed.start_solids_fraction",
          room, diameter);
  return "";
}

std::vector<Particle> start_particles(const core::Scene& scene, const Materials& materials, const Box& box) {
  if (scene.bed.start.kind == core::StartKind::list) return listed(scene, materials);
  const std::vector<std::int64_t> numbers = particle_numbers(scene, materials, box);
  const std::vector<Layer> layer = layers(scene, materials, box, numbers);
  const std::uint64_t seed = scene.bed.seed;
  std::vector<Particle> particles;
  particles.reserve(std::size_t(std::accumulate(numbers.begin(), numbers.end(), std::int64_t(0))));
  for (std::size_t j = 0; j < numbers.size(); ++j)
    for (std::int64_t n = 0; n < numbers[j]; ++n)
      particles.push_back(particle(materials, std::int32_t(j), std::int64_t(particles.size())));
  if (const double overlap = place_without_overlap(particles, layer, box, materials, seed); overlap > 0)
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
