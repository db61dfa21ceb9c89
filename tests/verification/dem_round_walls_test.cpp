// Round columns and cones inside them: forces with their curvature, bounces, starts, feeds, and a hopper that empties.
#include "dem/packing.hpp"
#include "dem/scene.hpp"
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

constexpr double r = 0.5e-3, youngs_modulus = 5e7, poisson_ratio = 0.25, density = 2500, deep = 5e-6;

core::Scene column_of(double diameter, double height) {
  core::Scene scene = dry_box(r, {youngs_modulus, poisson_ratio, density}, {diameter, height, diameter});
  scene.column.shape = core::ColumnShape::cylinder;
  return scene;
}

/// Hertz' force on a sphere at rest. \param curvature  1/m, above 0 from inside
double pushed(double curvature) {
  const double modulus = youngs_modulus / (1 - poisson_ratio * poisson_ratio);
  return 4.0 / 3 * modulus * std::sqrt(r / std::sqrt(1 - r * curvature)) * std::pow(deep, 1.5);
}

/// Of a sphere that overlaps by `deep` with a surface, which has a normal there.
/// \param curvature  of the surface, 1/m
void expect_force(const core::Scene& scene, const dem::Vector& foot, const dem::Vector& n, double curvature,
                  double tolerance) {
  dem::Vector x = foot;
  for (std::size_t k = 0; k < 3; ++k) x[k] += (r - deep) * n[k];
  const dem::Vector force = Beads(scene, {{"a", x}}).force(0);
  const double expected = pushed(curvature);
  for (std::size_t k = 0; k < 3; ++k)
    compare(fmt::format("force {}", k), force[k], expected * n[k], tolerance, expected);
}

/// A point at a distance from the axis of a column, in the direction (0.6, 0.8), and a height.
dem::Vector beside_axis(const core::Scene& scene, double distance, double height) {
  return {0.5 * scene.column.size[0] + 0.6 * distance, height, 0.5 * scene.column.size[2] + 0.8 * distance};
}

// A place is known to 2e-18 m, 4e-13 of the overlap.
TEST(DemRoundWalls, ASideCurvesTowardsASphere) {
  const core::Scene scene = column_of(0.01, 0.04);
  expect_force(scene, beside_axis(scene, 5e-3, 0.02), {-0.6, 0, -0.8}, 200, 1e-10);
  const Beads middle(scene, {{"a", {0.005, 0.02, 0.005}}});
  EXPECT_EQ(middle.force(0), (dem::Vector{0, 0, 0}));
}

TEST(DemRoundWalls, ACylinderInsideIsMetFromEitherSide) {
  core::Scene scene = column_of(0.04, 0.04);
  scene.walls.push_back({{0.02, 0.01}, {0.02, 0.03}, core::WallShape::cylinder});
  expect_force(scene, beside_axis(scene, 0.01, 0.02), {-0.6, 0, -0.8}, 100, 1e-10);
  expect_force(scene, beside_axis(scene, 0.01, 0.02), {0.6, 0, 0.8}, -100, 1e-10);
  expect_force(scene, beside_axis(scene, 0.01, 0.03), {0, 1, 0}, 0, 1e-10);  // its upper edge, as a flat wall
  EXPECT_EQ(Beads(scene, {{"a", {0.02, 0.02, 0.02}}}).force(0), (dem::Vector{0, 0, 0}));
}

// A cone that rises along (3, 4)/5, with the radius of curvature rho/(4/5). Its curvature is that of one of 16 bands:
// 0.4 % of the force.
TEST(DemRoundWalls, AConePushesAlongItsNormal) {
  core::Scene scene = column_of(0.04, 0.04);
  scene.walls.push_back({{0.01, 0}, {0.04, 0.02}, core::WallShape::cone});
  for (const double share : {0.1, 0.5, 0.9}) {
    const double rho = 5e-3 + share * 15e-3;
    const dem::Vector foot = beside_axis(scene, rho, share * 20e-3);
    expect_force(scene, foot, {-0.8 * 0.6, 0.6, -0.8 * 0.8}, 0.8 / rho, 4e-3);
    expect_force(scene, foot, {0.8 * 0.6, -0.6, 0.8 * 0.8}, -0.8 / rho, 4e-3);
  }
}

// Without friction and loss a sphere keeps its speed and its angular momentum about the axis; the latter to rounding,
// the former to the integration's error of an impact of 100 steps.
TEST(DemRoundWalls, ABallBouncesRoundAndRound) {
  core::Scene scene = column_of(0.01, 0.04);
  core::set_restitution(scene, 1);
  core::set_friction(scene, 0);
  scene.dem.steps_per_contact = 100;
  Beads beads(scene, {{"a", {0.007, 0.02, 0.005}, {0.3, 0, 0.8}}});
  const auto turning = [&] {
    const dem::Vector &x = beads.place(0).x, &v = beads.motion(0).v;
    return (x[0] - 0.005) * v[2] - (x[2] - 0.005) * v[0];
  };
  const double before = turning(), energy = dem::totals_of(beads.model).sum();
  std::int64_t bounces = 0;
  bool touched = false;
  beads.run_while([&] {
    const bool touches = !beads.model.walls().touching.empty();
    bounces += touched && !touches ? 1 : 0;
    touched = touches;
    return bounces < 20;
  });
  compare("angular momentum after 20 bounces", turning(), before, 1e-9);
  compare("energy after 20 bounces", dem::totals_of(beads.model).sum(), energy, 1e-4);
}

void expect_inside(const core::Scene& scene, const dem::Vector& x, double radius) {
  const double half = 0.5 * scene.column.size[0];
  EXPECT_LE(std::hypot(x[0] - half, x[2] - half) + radius, half * (1 + 1e-9));
}

// Spheres in the volume of the cylinder, evenly: the mean square of their distance from the axis is half the greatest,
// and 0.04 of it more as they crowd at the side, as at any wall.
TEST(DemRoundWalls, ABedFillsTheCircle) {
  for (const core::StartKind kind : {core::StartKind::mixed, core::StartKind::random}) {
    core::Scene scene = column_of(0.02, 0.04);
    scene.bed.start = {kind};
    scene.bed.solids_fraction = 0.6;
    scene.bed.start_solids_fraction = 0.2;
    scene.bed.static_height = 0.01;
    scene.bed.volume_share = {1};
    const dem::Box box = dem::box_of(scene);
    const std::vector<dem::Particle> particles = dem::start_particles(scene, dem::Materials(scene), box);
    // 0.6 pi (10 mm)^2 10 mm over pi/6 (1 mm)^3
    ASSERT_EQ(particles.size(), 3600U);
    double squares = 0;
    for (const dem::Particle& p : particles) {
      expect_inside(scene, p.place.x, r);
      squares += std::pow(p.place.x[0] - 0.01, 2) + std::pow(p.place.x[2] - 0.01, 2);
    }
    EXPECT_NEAR(squares / 3600, 0.5 * std::pow(0.01 - r, 2), 0.06 * std::pow(0.01 - r, 2));
  }
}

TEST(DemRoundWalls, AFeedEntersWithinTheCircle) {
  core::Scene scene = column_of(0.01, 0.02);
  scene.column.gravity = 9.81;
  scene.feeds.push_back({"a", core::ColumnFace::top, {{0, 0.05}}, 0.5, {}, {}});
  Beads beads(scene, {{"a", {0.005, r, 0.005}}});
  std::int64_t seen = 0;
  beads.run_while([&] {
    const dem::Particles& p = beads.model.particles();
    for (std::size_t i = 0; i < p.owned; ++i) seen = std::max(seen, p.id[i]);
    return beads.model.time() < 0.02;
  });
  // 0.05 m/s for 20 ms through the circle of 10 mm: 78.5 mm3, of 0.5236 mm3 each
  EXPECT_NEAR(double(seen), 150, 1);
  for (std::size_t i = 0; i < beads.model.particles().owned; ++i)
    expect_inside(scene, beads.model.particles().place[i].x, 0.9 * r);
}

// A round hopper: every sphere is in it or counted, none is outside, and the ledger of energy closes to V5.
TEST(DemRoundWalls, ARoundHopperEmpties) {
  core::Scene scene = column_of(0.016, 0.03);
  scene.species[0].youngs_modulus = scene.dem.youngs_modulus = 5e6;
  scene.dem.greatest_speed = {};
  scene.column.gravity = 9.81;
  core::set_friction(scene, 0.3);
  core::set_restitution(scene, 0.7);
  scene.walls.push_back({{0.006, 0}, {0.016, 0.008}, core::WallShape::cone});
  scene.dem.opening = 6e-3;
  scene.bed.start = {core::StartKind::mixed};
  scene.bed.start_solids_fraction = 0.5;
  scene.bed.particles = {600};
  core::Timers timers;
  dem::Model model(scene, timers);
  for (std::size_t i = 0; i < 600; ++i) EXPECT_GT(model.particles().place[i].x[1], 0.008);
  const dem::Totals start = dem::totals_of(model);
  double greatest = 0, miss = 0;
  while (model.particle_count() > 0) {
    ASSERT_LT(model.time(), 2) << model.particle_count() << " remain";
    model.step(1e300);
    if (model.steps() % 200 != 0) continue;
    const dem::Totals now = dem::totals_of(model);
    greatest = std::max({greatest, now.kinetic + now.rotational, now.dissipated, now.elastic});
    miss = std::max(miss, std::abs(now.sum() - start.sum()));
    ASSERT_EQ(std::int64_t(model.particles().owned) + model.outflow()->number[0], 600);
    for (std::size_t i = 0; i < model.particles().owned; ++i) {
      const dem::Vector& x = model.particles().place[i].x;
      const double rho = std::hypot(x[0] - 0.008, x[2] - 0.008);
      // The cone rises by 8 mm in 5 mm: its outer normal is (8, -5)/sqrt(89).
      const double beyond = (8 * (rho - 0.003) - 5 * x[1]) / std::sqrt(89.0);
      EXPECT_LT(x[1] > r ? beyond : -r, -0.85 * r) << "beyond the cone";
    }
  }
  compare("ledger of a round hopper", miss / greatest, 0, 1e-3, 1);
}

}  // namespace
}  // namespace polybed::scenes
