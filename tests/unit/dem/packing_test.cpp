// The start of particles: pair distributions of a fluid of hard spheres, no order, no overlap, every shape of bed.
#include "dem/packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "closures/sphere.hpp"
#include "dem/scene.hpp"

namespace polybed::dem::test {
namespace {

using std::numbers::pi;

struct Sort {
  double diameter;
  std::int64_t number;
};

core::Scene box_of_spheres(const std::vector<Sort>& sorts, double fraction) {
  core::Scene scene;
  double volume = 0;
  for (const Sort& sort : sorts) {
    core::Species species;
    species.name = "d" + std::to_string(scene.species.size());
    species.diameter = sort.diameter;
    species.density = 2500;
    scene.species.push_back(species);
    scene.bed.particles.push_back(sort.number);
    volume += double(sort.number) * closures::sphere_volume(0.5 * sort.diameter);
  }
  const double side = std::cbrt(volume / fraction);
  scene.fluid.name = "none";
  scene.column.size = {side, side, side};
  scene.column.dimensions = 3;
  scene.column.sides = scene.column.ends = core::Boundary::periodic;
  scene.bed.start = {core::StartKind::random};
  return scene;
}

std::vector<Particle> placed(const core::Scene& scene) {
  return start_particles(scene, Materials(scene), box_of(scene));
}

/// Distance over the sum of the radii, of the nearest images.
double distance(const Particle& a, const Particle& b, const Box& box) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double d = a.place.x[k] - b.place.x[k];
    if (box.periodic[k]) d -= box.size[k] * std::round(d / box.size[k]);
    square += d * d;
  }
  return std::sqrt(square) / (a.place.radius + b.place.radius);
}

/// Pair distribution of two species between distances, in units of contact, and the pairs counted there.
struct Shells {
  std::vector<double> g, pairs;
};

Shells shells(const core::Scene& scene, int one, int other, const std::vector<double>& edges) {
  const std::vector<Particle> particles = placed(scene);
  const Box box = box_of(scene);
  Shells found{{}, std::vector<double>(edges.size() - 1, 0)};
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const int a = particles[i].species, b = particles[j].species;
      if (std::min(a, b) != one || std::max(a, b) != other) continue;
      const double r = std::max(1.0, distance(particles[i], particles[j], box));
      const auto shell = std::upper_bound(edges.begin(), edges.end(), r) - edges.begin() - 1;
      if (shell < std::ptrdiff_t(found.pairs.size())) ++found.pairs[std::size_t(shell)];
    }
  const auto number = [&](int j) { return double(scene.bed.particles[std::size_t(j)]); };
  const double all = one == other ? 0.5 * number(one) * (number(one) - 1) : number(one) * number(other);
  const double contact =
      0.5 * (scene.species[std::size_t(one)].diameter + scene.species[std::size_t(other)].diameter) / box.size[0];
  for (std::size_t n = 0; n < found.pairs.size(); ++n)
    found.g.push_back(found.pairs[n] /
                      (all * 4 * pi / 3 * (std::pow(edges[n + 1] * contact, 3) - std::pow(edges[n] * contact, 3))));
  return found;
}

struct Contact {
  double g, deviation;
};

/// Extrapolated from shells of 0.02: g'' leaves an error below 1 %. Deviation of two counts.
Contact contact_value(const core::Scene& scene, int one, int other) {
  const Shells near = shells(scene, one, other, {1, 1.02, 1.04});
  return {1.5 * near.g[0] - 0.5 * near.g[1],
          std::hypot(1.5 * near.g[0] / std::sqrt(near.pairs[0]), 0.5 * near.g[1] / std::sqrt(near.pairs[1]))};
}

// (1 - phi/2)/(1 - phi)^3. Four deviations of the counts of 8000 spheres: 16 % at 0.3, 9 % at 0.5. Spheres pushed apart
// from random places to contact and no further had 8 times too many pairs there.
TEST(Packing, TouchesAsOftenAsAFluidOfHardSpheres) {
  for (const double phi : {0.3, 0.5}) {
    const Contact found = contact_value(box_of_spheres({{1e-3, 8000}}, phi), 0, 0);
    EXPECT_NEAR(found.g, (1 - 0.5 * phi) / std::pow(1 - phi, 3), 4 * found.deviation) << phi;
    EXPECT_LT(found.deviation / found.g, 0.045) << "or the test says nothing";
  }
}

// Percus and Yevick with Verlet and Weis's correction (Phys. Rev. A 5, 1972), integrated over the shells. At 0.5,
// beyond freezing, that itself is 4 % from Monte Carlo of 2000 sweeps between 1.25 and 1.5; four deviations of the
// counts more.
TEST(Packing, HasTheFirstShellOfPercusAndYevick) {
  const std::vector<double> edges{1, 1.1, 1.25, 1.5, 2};
  for (const auto& [phi, expected] : {std::pair{0.3, std::vector{2.1663, 1.5827, 1.0852, 0.9070}},
                                      {0.5, std::vector{3.9117, 1.5774, 0.6464, 0.9775}}}) {
    const Shells found = shells(box_of_spheres({{1e-3, 8000}}, phi), 0, 0, edges);
    for (std::size_t n = 0; n < expected.size(); ++n)
      EXPECT_NEAR(found.g[n], expected[n], (0.04 + 4 / std::sqrt(found.pairs[n])) * expected[n]) << phi << ", " << n;
  }
}

// Boublik (1970), Mansoori et al. (1971): 1/(1 - phi) + 3 z q/(1 - phi)^2 + 2 z^2 q^2/(1 - phi)^3, q = d_i d_j/(d_i +
// d_j), z = pi/6 sum n d^2.
TEST(Packing, TouchesAsOftenInAMixtureToo) {
  const std::vector<Sort> sorts{{1e-3, 9000}, {2e-3, 1000}};
  const double phi = 0.3;
  const core::Scene scene = box_of_spheres(sorts, phi);
  double z = 0;
  for (const Sort& s : sorts)
    z += pi / 6 * double(s.number) * s.diameter * s.diameter / std::pow(scene.column.size[0], 3);
  for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {1, 1}}) {
    const double one = sorts[std::size_t(i)].diameter, other = sorts[std::size_t(j)].diameter;
    const double zq = z * one * other / (one + other), free = 1 - phi;
    const Contact found = contact_value(scene, i, j);
    EXPECT_NEAR(found.g, 1 / free + 3 * zq / (free * free) + 2 * zq * zq / (free * free * free), 4 * found.deviation)
        << i << j;
  }
}

// |sum exp(i k x)|^2/N is about exponentially distributed; its mean is at most 3 in a fluid at 0.5, so that one of 300
// wave vectors exceeds 42 once in 4000 seeds. Places in equal parts of the box gave 84 after pushing.
TEST(Packing, HasNoOrder) {
  const core::Scene scene = box_of_spheres({{1e-3, 16384}}, 0.5);
  const std::vector<Particle> particles = placed(scene);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int wave = 1; wave <= 100; ++wave) {
      std::complex<double> sum = 0;
      for (const Particle& p : particles)
        sum += std::polar(1.0, 2 * pi * wave * p.place.x[axis] / scene.column.size[axis]);
      EXPECT_LT(std::norm(sum) / double(particles.size()), 42) << axis << ", " << wave;
    }
}

double least_distance(const std::vector<Particle>& particles, const Box& box) {
  double least = 1e300;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(particles[i], particles[j], box));
  return least;
}

TEST(Packing, IsReproducibleFromTheSeed) {
  core::Scene scene = box_of_spheres({{1e-3, 300}, {2e-3, 20}}, 0.45);
  const std::vector<Particle> one = placed(scene), again = placed(scene);
  scene.bed.seed += 1;
  const std::vector<Particle> other = placed(scene);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].place.x, again[i].place.x);
    EXPECT_NE(one[i].place.x, other[i].place.x);
    EXPECT_EQ(one[i].id, std::int64_t(i));
    EXPECT_EQ(one[i].species, i < 300 ? 0 : 1);
  }
}

// Each species in its layer, at 0.45 between walls that are 6 of the large ones apart.
TEST(Packing, KeepsToLayersAndWalls) {
  core::Scene scene = box_of_spheres({{1e-3, 1500}, {2e-3, 200}}, 0.5);
  scene.column.size = {0.012, 0.05, 0.012};
  scene.column.sides = scene.column.ends = core::Boundary::wall;
  scene.bed.start = {core::StartKind::layered};
  scene.bed.start_solids_fraction = 0.45;
  const Box box = box_of(scene);
  const std::vector<Particle> particles = placed(scene);
  EXPECT_GT(least_distance(particles, box), 1 - 1e-3);
  const double fine = 1500 * closures::sphere_volume(0.5e-3) / (0.45 * 0.012 * 0.012);
  for (const Particle& p : particles) {
    const double low = p.species == 0 ? 0 : fine;
    EXPECT_GE(p.place.x[1], low + p.place.radius);
    if (p.species == 0) {
      EXPECT_LE(p.place.x[1], fine - p.place.radius);
    }
    for (const std::size_t k : {0U, 2U}) {
      EXPECT_GE(p.place.x[k], p.place.radius);
      EXPECT_LE(p.place.x[k], 0.012 - p.place.radius);
    }
  }
}

// Species of one layer are mixed there: those of 1 and 1.5 mm below, those of 2 mm above.
TEST(Packing, MixesTheSpeciesOfALayer) {
  core::Scene scene = box_of_spheres({{1e-3, 600}, {1.5e-3, 200}, {2e-3, 100}}, 0.5);
  scene.column.size = {0.012, 0.05, 0.012};
  scene.column.sides = scene.column.ends = core::Boundary::wall;
  scene.bed.start = {core::StartKind::layered};
  scene.bed.start_solids_fraction = 0.45;
  scene.bed.layer = {1, 1, 2};
  const std::vector<Particle> particles = placed(scene);
  const double volume = 600 * closures::sphere_volume(0.5e-3) + 200 * closures::sphere_volume(0.75e-3);
  const double border = volume / (0.45 * 0.012 * 0.012);
  std::array<double, 3> lowest{1, 1, 1}, highest{};
  for (const Particle& p : particles) {
    const auto j = std::size_t(p.species);
    lowest[j] = std::min(lowest[j], p.place.x[1]);
    highest[j] = std::max(highest[j], p.place.x[1]);
  }
  for (const std::size_t j : {0U, 1U}) {
    EXPECT_LT(lowest[j], 0.2 * border);
    EXPECT_GT(highest[j], 0.8 * border);
    EXPECT_LT(highest[j], border);
  }
  EXPECT_GT(lowest[2], border);
}

// A dam of 1 mm beads over 12 of 30 mm, 15 mm high and settled at 0.6, with a layer of both sizes on it, and 2 mm beads
// on the right. Numbers follow from the volumes; beads keep to their own boxes, which are as high as 0.45 makes them.
TEST(Packing, KeepsToLayersSideBySide) {
  core::Scene scene = box_of_spheres({{1e-3, 1}, {2e-3, 1}}, 0.5);
  scene.bed.particles.clear();
  scene.column.size = {0.03, 0.05, 0.012};
  scene.column.sides = scene.column.ends = core::Boundary::wall;
  scene.bed.start = {core::StartKind::layered};
  scene.bed.start_fraction = 0.45;
  scene.layers = {{"", {1, 0}, 0.015, 0.6, {0, 0}, {0.012, 0.012}},
                  {"", {0.5, 0.5}, 0.008, 0.5, {0, 0}, {0.012, 0.012}},
                  {"", {0, 1}, 0.01, 0.6, {0.018, 0}, {0.03, 0.012}}};
  const auto number = [](double volume, double diameter) {
    return std::llround(volume / closures::sphere_volume(0.5 * diameter));
  };
  const double area = 0.012 * 0.012;
  const std::int64_t below = number(0.6 * 0.015 * area, 1e-3), above = number(0.25 * 0.008 * area, 1e-3),
                     coarse = number(0.25 * 0.008 * area, 2e-3), right = number(0.6 * 0.01 * area, 2e-3);
  const Box box = box_of(scene);
  EXPECT_EQ(no_room_for(scene, Materials(scene), box), "");
  EXPECT_EQ(particle_numbers(scene, Materials(scene)), (std::vector<std::int64_t>{below + above, coarse + right}));
  const std::vector<Particle> particles = placed(scene);
  ASSERT_EQ(std::int64_t(particles.size()), below + above + coarse + right);
  EXPECT_GT(least_distance(particles, box), 1 - 1e-3);
  const double border = double(below) * closures::sphere_volume(0.5e-3) / (0.45 * area);
  std::array<std::int64_t, 3> found{};  // below and above on the left, right
  for (const Particle& p : particles) {
    const bool left = p.place.x[0] < 0.015;
    EXPECT_GE(p.place.x[1], p.place.radius);
    if (!left) {
      EXPECT_EQ(p.species, 1);
      EXPECT_GE(p.place.x[0], 0.018 + p.place.radius);
      ++found[2];
      continue;
    }
    EXPECT_LE(p.place.x[0], 0.012 - p.place.radius);
    const bool high = p.place.x[1] > border;
    ++found[high ? 1 : 0];
    if (!high) {
      EXPECT_EQ(p.species, 0);
      EXPECT_LE(p.place.x[1], border - p.place.radius);
    } else {
      EXPECT_GE(p.place.x[1], border + p.place.radius);
    }
  }
  EXPECT_EQ(found, (std::array<std::int64_t, 3>{below, above + coarse, right}));
  EXPECT_NEAR(start_height(scene, Materials(scene), box), border + 0.008 * 0.5 / 0.45,
              0.008 * 0.02);  // whole numbers of beads
}

TEST(Packing, ALayerNarrowerThanAParticleIsRefused) {
  core::Scene scene = box_of_spheres({{2e-3, 1}}, 0.5);
  scene.bed.particles.clear();
  scene.column.size = {0.03, 0.5, 0.012};
  scene.column.sides = scene.column.ends = core::Boundary::wall;
  scene.bed.start = {core::StartKind::layered};
  scene.layers = {{"", {1}, 0.015, 0.6, {0.01, 0}, {0.0115, 0.012}}};
  EXPECT_EQ(no_room_for(scene, Materials(scene), box_of(scene)),
            "a layer is 0.0015 m wide, less than a particle, 0.002 m: move layer.from and layer.to apart");
}

// Boxes of calibrations are this dense; overlaps of a thousandth of a radius are left there.
TEST(Packing, ReachesTheDensestBoxes) {
  const core::Scene scene = box_of_spheres({{1e-3, 1000}}, 0.61);
  EXPECT_GT(least_distance(placed(scene), box_of(scene)), 1 - 0.5e-3);
}

// Three beads of 2 mm in a box of 20 mm make a bed of a tenth of a millimetre; in a checkpoint they are anywhere.
TEST(Packing, FewParticlesOfACheckpointHaveRoom) {
  core::Scene scene = box_of_spheres({{2e-3, 3}}, 1.57e-3);
  scene.column.sides = scene.column.ends = core::Boundary::wall;
  scene.bed.solids_fraction = scene.bed.start_solids_fraction = 0.6;
  scene.bed.volume_share = {1};
  scene.bed.start = {core::StartKind::mixed};
  EXPECT_NE(no_room_for(scene, Materials(scene), box_of(scene)), "");
  scene.bed.start = {core::StartKind::checkpoint, "first/checkpoint.h5"};
  EXPECT_EQ(no_room_for(scene, Materials(scene), box_of(scene)), "");
  EXPECT_EQ(placed(scene).size(), 3U);
}

}  // namespace
}  // namespace polybed::dem::test
