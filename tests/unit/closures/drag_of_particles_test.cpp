// The drag of many particles, each in a mixture of its own, is that of its species in a cell with that mixture.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "closures/drag.hpp"

namespace polybed::closures {
namespace {

constexpr std::size_t species = 3;
constexpr std::size_t particles = 300;  // more than are worked on together, and not a multiple of that
const std::vector<double> sizes{0.4e-3, 1e-3, 2.5e-3};

/// Surroundings of every particle, and which species it is.
struct Scene {
  std::vector<double> voidage, per_mean, average, per_square, share, diameter, slip;
  std::vector<std::array<double, species>> shares;
  std::vector<std::size_t> own;
};

Scene random_scene() {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  Scene s;
  for (std::size_t p = 0; p < particles; ++p) {
    std::array<double, species> x{uniform(random), uniform(random), uniform(random)};
    if (p % 7 == 0) x[(p + 1) % species] = 0;  // a species is absent, but not the particle's own
    const double sum = x[0] + x[1] + x[2];
    for (double& part : x) part /= sum;
    const Composition c = composition_of(x, sizes);
    s.shares.push_back(x);
    s.own.push_back(p % species);
    s.voidage.push_back(p == 0 ? 1 : 0.26 + 0.74 * uniform(random));
    s.per_mean.push_back(c.per_mean);
    s.average.push_back(c.average);
    s.per_square.push_back(c.per_square);
    s.share.push_back(x[p % species]);
    s.diameter.push_back(sizes[p % species]);
    s.slip.push_back(p == 2 ? 0 : std::pow(10.0, 4 * uniform(random) - 4));
  }
  return s;
}

TEST(DragOfParticles, EqualsTheSpeciesOfACell) {
  const Scene s = random_scene();
  for (const std::string& name : drag_law_names())
    for (const Guard guard : {Guard::on, Guard::off}) {
      if (name == "fand" && guard == Guard::off) continue;  // refuses the gaps between its regimes
      const DragLaw law = drag_law(name, guard);
      std::vector<double> f(particles, -1);
      GuardCount count;
      drag_of_particles(law, s.voidage, s.per_mean, s.average, s.per_square, sizes.back(), s.share, s.diameter, s.slip,
                        1000, 1e-3, f, count);
      EXPECT_EQ(count.evaluations, particles);
      for (std::size_t p = 0; p < particles; ++p) {
        std::array<double, species> cell, slope, slip;
        slip.fill(s.slip[p]);
        drag_of_mixture(law, s.voidage[p], s.shares[p], sizes, slip, 1000, 1e-3, cell, slope);
        // Only the order of the three factors of Re differs: a few units in the last place, times df/dRe Re/f < 4.
        EXPECT_NEAR(f[p], cell[s.own[p]], 1e-13 * std::abs(cell[s.own[p]])) << name << " " << p;
      }
    }
}

TEST(DragOfParticles, ByHandWithoutAMixture) {
  // Stokes: 1 whatever the surroundings. Syamlal: the share times gidaspow of the mean size, here at Re 100.
  const std::vector<double> eps{0.9}, per_mean{1e3}, average{1e-3}, share{0.25}, diameter{1e-3}, slip{0.1};
  std::vector<double> f(1);
  GuardCount count;
  drag_of_particles(drag_law("stokes", Guard::on), eps, per_mean, average, {}, 1e-3, share, diameter, slip, 1000, 1e-3,
                    f, count);
  EXPECT_EQ(f[0], 1);
  EXPECT_EQ(count.guarded, 1u);  // Re 100 is beyond creeping flow
  drag_of_particles(drag_law("syamlal", Guard::on), eps, per_mean, average, {}, 1e-3, share, diameter, slip, 1000, 1e-3,
                    f, count);
  std::vector<double> whole(1), slope(1);
  drag_of_points(drag_law("gidaspow", Guard::on), eps, std::vector<double>{100}, whole, slope, count);
  EXPECT_NEAR(f[0], 0.25 * whole[0], 1e-14 * whole[0]);  // round-off of one product
}

TEST(DragOfParticles, NoneIsFine) {
  GuardCount count;
  drag_of_particles(drag_law("cello", Guard::on), {}, {}, {}, {}, 1e-3, {}, {}, {}, 1000, 1e-3, {}, count);
  EXPECT_EQ(count.evaluations, 0u);
}

}  // namespace
}  // namespace polybed::closures
