// A flat hopper, square and round: how fast spheres flow out through a round hole in the bottom, against its diameter.
// Minutes.
#include <gtest/gtest.h>

#include "dem/settling.hpp"
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

constexpr double diameter = 1e-3, density = 2500, gravity = 9.81;  // m, kg/m3, m/s2
constexpr double width = 20 * diameter;                            // of the bottom, square, between four walls

/// Some 20 diameters high once it has settled.
core::Scene hopper() {
  core::Scene scene = dry_box(0.5 * diameter, {2e6, 0.25, density}, {width, 32 * diameter, width});
  scene.column.gravity = gravity;
  scene.dem.youngs_modulus = 2e6;
  scene.dem.poisson_ratio = 0.25;
  core::set_friction(scene, 0.5);
  core::set_restitution(scene, 0.8);
  scene.dem.greatest_speed = 0.8;
  scene.dem.ledger = false;
  scene.bed.start = {core::StartKind::settled};
  scene.bed.start_solids_fraction = 0.5;
  scene.bed.solids_fraction = 0.6;
  scene.bed.particles = {9200};
  scene.dem.opening = 5 * diameter;
  return scene;
}

/// Particles that leave in a second, from when the flow has set in until so many have; 0 if they never do.
struct Flow {
  double rate = 0;     ///< 1/s
  double scatter = 0;  ///< standard error of it, from eight parts of the time
};

/// \param counted  particles, a multiple of 8
Flow flow_through(core::Scene scene, double opening, const core::Checkpoint& settled, std::int64_t counted) {
  constexpr double sets_in = 0.06;  // s: a fall of 18 diameters
  core::Timers timers;
  scene.dem.opening = opening;
  dem::Model model(scene, timers);
  model.start_from(settled);
  while (model.time() < sets_in) model.step(1e300);
  const std::int64_t before = model.outflow()->all();
  std::vector<double> times{model.time()};
  for (int part = 1; part <= 8; ++part) {
    while (model.outflow()->all() - before < part * counted / 8 && model.time() < 2) model.step(1e300);
    times.push_back(model.time());
  }
  Flow flow;
  if (model.outflow()->all() - before < counted) return flow;
  flow.rate = double(model.outflow()->all() - before) / (times.back() - times.front());
  double squares = 0;
  for (std::size_t n = 1; n < times.size(); ++n) {
    const double off = (times[n] - times[n - 1]) * 8 / (times.back() - times.front()) - 1;
    squares += off * off;
  }
  flow.scatter = flow.rate * std::sqrt(squares / (8 * 7));
  return flow;
}

/// Slope of the straight line of least squares through points.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = double(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// Beverloo, Leniger and van de Velde (Chem. Eng. Sci. 15, 1961, 260): W = C rho_b g^(1/2) (D - k d)^2.5, k = 1.4 for
// spheres. The exponent of (D - 1.4 d) is held to 0.1 of theirs, the rate itself is only told: C and k depend on
// friction.
TEST(DemHopper, FlowsByThePowerTwoAndAHalf) {
  core::Timers timers;
  const core::Scene scene = hopper();
  const double dt = dem::Model(scene, timers).limits().dt;
  const core::Checkpoint settled = dem::settled(scene, dt, nullptr);
  std::vector<double> opening, rate;
  std::string points;
  for (const double d : {5.0, 6.0, 7.0, 8.0}) {
    const Flow flow = flow_through(scene, d * diameter, settled, 800);
    ASSERT_GT(flow.rate, 0) << "jammed at " << d << " diameters";
    opening.push_back(std::log(d - 1.4));
    rate.push_back(std::log(flow.rate));
    points += fmt::format("{:g} {:.5g} {:.2g}; ", d, flow.rate, flow.scatter);
  }
  testing::Test::RecordProperty("opening in diameters, particles per second, its standard error", points);
  compare("exponent of D - 1.4 d", slope(opening, rate), 2.5, 0.1, 1);
}

// The same in a cylinder, as high: two holes, whose rates are in the ratio of (D - 1.4 d)^2.5.
TEST(DemHopper, OfTwoRoundSilosFlowsByBeverloosRatio) {
  core::Timers timers;
  core::Scene scene = hopper();
  scene.column.shape = core::ColumnShape::cylinder;
  scene.bed.particles = {7200};
  const core::Checkpoint settled = dem::settled(scene, dem::Model(scene, timers).limits().dt, nullptr);
  const Flow narrow = flow_through(scene, 6 * diameter, settled, 2400);
  const Flow wide = flow_through(scene, 8 * diameter, settled, 2400);
  ASSERT_GT(narrow.rate, 0);
  testing::Test::RecordProperty(
      "round silo, particles per second and standard errors",
      fmt::format("6 d {:.5g} {:.2g}, 8 d {:.5g} {:.2g}", narrow.rate, narrow.scatter, wide.rate, wide.scatter));
  compare("ratio of the rates through 8 and 6 diameters", wide.rate / narrow.rate, std::pow(6.6 / 4.6, 2.5), 0.03);
}

}  // namespace
}  // namespace polybed::scenes
