// Walls, their edges and corners, and the sum of all that touches a particle: D6 and D13 of the hard cases.
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

/// Forces of the laws of a scene on the first species at one overlap and velocity: against the wall, and against the
/// second species.
struct Two {
  double normal[2], tangential[2];
};

Two laws_of_wall_and_sphere(const core::Scene& scene) {
  const dem::Materials materials(scene);
  const dem::PairLaws laws = dem::make_pair_laws(scene, materials);
  dem::ContactBatch batch;
  batch.count = 2;
  batch.kind[0] = materials.wall_kind(0);
  batch.kind[1] = materials.kind(0, 1);
  for (int c = 0; c < 2; ++c) {
    batch.distance[1][c] = 1;
    batch.overlap[c] = 2e-6;
    batch.speed[c] = -0.02;
    batch.velocity[0][c] = 0.003;
  }
  laws.normal->act(batch);
  laws.tangential->act(batch, 1e-6);
  return {{batch.normal[0], batch.normal[1]}, {batch.tangential[0][0], batch.tangential[0][1]}};
}

// A wall is a sphere of R -> infinity: at 1e14 times the radius every law gives the same to 1e-12.
TEST(DemWalls, AreSpheresOfInfiniteRadius) {
  for (const std::string contact : {"hertz_mindlin", "linear"})
    for (const std::string law : {"hdd", "mindlin"}) {
      if (contact == "linear" && law == "mindlin") continue;  // which needs a radius of contact
      const Material glass{5e6, 0.25, 2500};
      core::Scene scene = dry_box(0.5e-3, glass, {0.01, 0.01, 0.01});
      scene.species.push_back(sphere("b", 0.5e11, glass));
      scene.effects["contact"] = contact;
      scene.dem.normal_stiffness = 1000;
      scene.dem.tangential = core::choice_of<core::Tangential>(law);
      scene.dem.youngs_modulus = glass.youngs_modulus;
      scene.dem.poisson_ratio = glass.poisson_ratio;
      const Two two = laws_of_wall_and_sphere(scene);
      EXPECT_GT(two.normal[0], 0);
      EXPECT_LT(two.tangential[0], 0);
      compare("wall " + contact + " " + law + " normal", two.normal[1], two.normal[0], 1e-12);
      compare("wall " + contact + " " + law + " tangential", two.tangential[1], two.tangential[0], 1e-12);
    }
}

/// An oblique impact from above on the floor, or on a heavy sphere of a ratio of radii: velocity and spin after.
std::array<double, 3> after_impact(double ratio) {
  const double r = 0.5e-3;
  const Material glass{5e6, 0.25, 2500};
  core::Scene scene = dry_box(r, glass, {1, 1, 1});
  scene.dem.youngs_modulus = glass.youngs_modulus;
  scene.dem.poisson_ratio = glass.poisson_ratio;
  scene.dem.fixed_step = 1e-6;
  scene.dem.integrator = core::DemIntegrator::thesis;  // "auto" is another one for unequal spheres
  const dem::Vector v{0.1, -0.2, 0}, w{0, 0, 30};
  if (ratio == 0) {
    Beads beads(scene, {{"a", {0.5, r, 0.5}, v, w}});
    beads.steps(300);
    return {beads.motion(0).v[0], beads.motion(0).v[1], beads.motion(0).w[2]};
  }
  const double big = ratio * r;
  scene.species.push_back(sphere("b", big, {glass.youngs_modulus, glass.poisson_ratio, 2.5e12}));
  Beads beads(scene, {{"a", {0.5, 0.5 + big + r, 0.5}, v, w}, {"b", {0.5, 0.5, 0.5}}});
  beads.steps(300);
  return {beads.motion(0).v[0], beads.motion(0).v[1], beads.motion(0).w[2]};
}

// Whole impacts: on ever larger spheres they approach that on the wall, in proportion to 1/R. Extrapolated from 200 and
// 400 radii: what is left is of second order in 1/R, (1/200)^2 = 2.5e-5, twice that
// allowed.
TEST(DemWalls, AreTheLimitOfLargeSpheres) {
  const auto wall = after_impact(0), near = after_impact(200), far = after_impact(400);
  for (std::size_t k = 0; k < 3; ++k) {
    compare(fmt::format("wall, limit of component {}", k), 2 * far[k] - near[k], wall[k], 5e-5);
    EXPECT_LT(std::abs(far[k] - wall[k]), 0.6 * std::abs(near[k] - wall[k])) << k;
  }
}

// In a corner of three walls each pushes as if it were alone; in an edge two; a hair off the walls there is no force.
TEST(DemWalls, AddUpInEdgesAndCorners) {
  const double r = 0.5e-3;
  core::Scene scene = dry_box(r, {5e6, 0.25, 2500}, {0.01, 0.01, 0.01});
  scene.column.closed = true;
  const double k = 4.0 / 3 * 5e6 / (1 - 0.25 * 0.25) * std::sqrt(r);
  const auto push = [&](double overlap) { return overlap > 0 ? k * std::pow(overlap, 1.5) : 0.0; };
  for (const int sides : {0b000, 0b001, 0b010, 0b011, 0b100, 0b101, 0b110, 0b111})
    for (const double deep : {5e-6, 1e-7, -1e-12}) {
      const std::array<double, 3> overlap{deep, 2 * deep, 3 * deep};
      Bead bead{"a", {}};
      for (std::size_t d = 0; d < 3; ++d) bead.x[d] = (sides >> d & 1) != 0 ? 0.01 - r + overlap[d] : r - overlap[d];
      const Beads beads(scene, {bead});
      for (std::size_t d = 0; d < 3; ++d) {
        const double expected = ((sides >> d & 1) != 0 ? -1 : 1) * push(overlap[d]);
        // The place is known to 1e-18 m, 1e-11 of the least overlap; the force to its unit.
        EXPECT_NEAR(beads.force(0)[d], expected, 1e-10 * std::abs(expected) + beads.model.unit_of_force().unit);
      }
      EXPECT_EQ(beads.model.walls().touching.size(), deep > 0 ? 3U : 0U);
    }
}

// At the open top nothing pushes from above, and the side wall still does.
TEST(DemWalls, OpenTop) {
  core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.01, 0.01, 0.01});
  const Beads free(scene, {{"a", {0.005, 0.01, 0.005}}});
  EXPECT_EQ(free.force(0), (dem::Vector{0, 0, 0}));
  const Beads aside(scene, {{"a", {0.49e-3, 0.01, 0.005}}});
  const double k = 4.0 / 3 * 5e6 / (1 - 0.25 * 0.25) * std::sqrt(0.5e-3);
  compare("side wall at the open top", aside.force(0)[0], k * std::pow(1e-5, 1.5), 1e-10);
  EXPECT_EQ(aside.force(0)[1], 0);
  scene.column.closed = true;
  const Beads lid(scene, {{"a", {0.005, 0.01 - 0.49e-3, 0.005}}});
  EXPECT_LT(lid.force(0)[1], 0);
}

// A coarse sphere under 500 fine ones: its load is the sum of theirs to the last unit, and each is Hertz's.
TEST(DemWalls, CoarseUnder500Fines) {
  const double big = 5e-3, small = 0.1e-3, deep = 1e-6;
  core::Scene scene = dry_box(big, {5e6, 0.25, 2500}, {0.03, 0.03, 0.03});
  scene.species.push_back(sphere("b", small, {5e6, 0.25, 2500}));
  std::vector<Bead> start{{"a", {0.015, 0.015, 0.015}}};
  const double reach = big + small - deep, golden = pi * (3 - std::sqrt(5.0));
  for (int n = 0; n < 500; ++n) {  // on the upper half, evenly, none touching another
    const double y = (n + 0.5) / 500, rho = std::sqrt(1 - y * y), angle = golden * n;
    start.push_back(
        {"b", {0.015 + reach * rho * std::cos(angle), 0.015 + reach * y, 0.015 + reach * rho * std::sin(angle)}});
  }
  const Beads beads(scene, start);
  ASSERT_EQ(beads.model.pairs().touching.size(), 500U);
  std::array<std::int64_t, 3> sum{};
  const dem::Particles& p = beads.model.particles();
  for (std::size_t i = 0; i < p.owned; ++i)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += p.load[i].force[k];
  EXPECT_EQ(sum, (std::array<std::int64_t, 3>{0, 0, 0}));
  const double k = 4.0 / 3 * 0.5 * 5e6 / (1 - 0.25 * 0.25) * std::sqrt(big * small / (big + small));
  double down = 0;
  for (int n = 0; n < 500; ++n) down -= k * std::pow(deep, 1.5) * (n + 0.5) / 500;
  // Places are known to 2e-18 m, 3e-12 of the force, and 500 forces to a unit each.
  compare("500 fines", beads.force(0)[1], down, 1e-11 - 500 * beads.model.unit_of_force().unit / down);
}

}  // namespace
}  // namespace polybed::scenes
