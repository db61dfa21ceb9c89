// Janssen's silo: what the walls carry of a column of spheres at rest, and what is left for its floor. Minutes.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "dem/stress.hpp"
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

constexpr double diameter = 1e-3, density = 2500, gravity = 9.81;  // m, kg/m3, m/s2
constexpr double width = 8 * diameter, depth = 5 * diameter;       // between two walls, and periodic
constexpr double wall_friction = 0.2;                              // of spheres with each other 0.5
constexpr int slices = 20;

/// Some 40 diameters high once it has settled.
core::Scene silo(std::uint64_t seed) {
  core::Scene scene = dry_box(0.5 * diameter, {3e6, 0.25, density}, {width, 88 * diameter, depth});
  scene.column.dimensions = 2;
  scene.column.gravity = gravity;
  scene.dem.youngs_modulus = 3e6;
  scene.dem.poisson_ratio = 0.25;
  core::set_friction(scene, 0.5);
  core::set_restitution(scene, 0.5);
  scene.contact_pairs = {{{"a", "wall"}, {}, {}, wall_friction, {}}};
  scene.bed.start = {core::StartKind::mixed};
  scene.bed.start_solids_fraction = 0.4;
  scene.bed.solids_fraction = 0.6;
  scene.bed.particles = {1833};
  scene.bed.seed = seed;
  return scene;
}

/// The cross-section of a silo, what of its edge is wall, and the radius of a round one; m2 and m.
struct Section {
  double area, edge, radius = 0;

  /// Towards the wall.
  [[nodiscard]] dem::Vector outwards(double x, double z) const {
    if (radius == 0) return {1, 0, 0};
    const double r = std::hypot(x - radius, z - radius);
    return {(x - radius) / r, 0, (z - radius) / r};
  }
};
constexpr Section slot{width * depth, 2 * depth}, tube{25 * pi * diameter * diameter, 10 * pi*diameter, 5 * diameter};

/// The same in a tube of ten diameters.
core::Scene round_silo(std::uint64_t seed) {
  core::Scene scene = silo(seed);
  scene.column.shape = core::ColumnShape::cylinder;
  scene.column.dimensions = 3;
  scene.column.sides = core::Boundary::wall;
  scene.column.size = {10 * diameter, 70 * diameter, 10 * diameter};
  scene.bed.particles = {3480};
  return scene;
}

/// The particle at a height and what a wall does to it.
struct WallForce {
  double height, normal, up;  ///< m, N
  bool floor;
};

std::vector<WallForce> wall_forces(const dem::Model& model) {
  std::vector<WallForce> forces;
  const dem::Contacts& walls = model.walls();
  dem::ContactBatch batch;
  for (std::size_t begin = 0; begin < walls.touching.size(); begin += dem::ContactBatch::width) {
    model.pair_forces().loader().load_touching_walls(model.particles(), walls, begin, batch);
    model.laws().normal->act(batch);
    model.laws().tangential->act(batch, 0);
    for (int c = 0; c < batch.count; ++c)
      forces.push_back({model.particles().place[std::size_t(batch.first[c])].x[1], batch.normal[c],
                        batch.tangential[1][c], model.box().walls[std::size_t(batch.second[c])].axis == 1});
  }
  return forces;
}

using Slices = std::array<double, slices>;

/// A column in slices from the top down: weight and what the walls carry of it, N, and vertical stress below, Pa.
struct Column {
  Section section;
  double height = 0, weight = 0, floor = 0;  ///< m, N
  Slices loads{}, carried{}, pushed{}, stress{};
  Slices axial{}, outward{};  ///< stresses of the contacts, Pa: sums of branch times force over the volume

  Column(dem::Model& model, const Section& of) : section(of) {
    const dem::Particles& p = model.particles();
    for (std::size_t i = 0; i < p.owned; ++i) height = std::max(height, p.place[i].x[1] + 0.5 * diameter);
    const auto slice = [&](double y) { return std::size_t(std::clamp(int((1 - y / height) * slices), 0, slices - 1)); };
    for (std::size_t i = 0; i < p.owned; ++i) loads[slice(p.place[i].x[1])] += gravity / p.motion[i].inverse_mass;
    const double volume = section.area * height / slices;
    for (const dem::ContactForce& c : dem::contact_forces(model)) {
      dem::Vector x = p.place[c.first].x;
      for (std::size_t k = 0; k < 3; ++k) x[k] -= 0.5 * c.length * c.normal[k];
      const dem::Vector out = section.outwards(x[0], x[2]);
      const auto along = [&](const dem::Vector& v) { return v[0] * out[0] + v[2] * out[2]; };
      axial[slice(x[1])] += c.length * c.normal[1] * c.force[1] / volume;
      outward[slice(x[1])] += c.length * along(c.normal) * along(c.force) / volume;
    }
    for (const WallForce& f : wall_forces(model)) {
      if (f.floor) floor += f.normal;
      if (f.floor) continue;
      outward[slice(f.height)] += 0.5 * diameter * f.normal / volume;
      carried[slice(f.height)] += f.up;
      pushed[slice(f.height)] += f.normal;
    }
    double above = 0;
    for (std::size_t s = 0; s < slices; ++s) {
      weight += loads[s];
      above += loads[s] - carried[s];
      stress[s] = above / section.area;
    }
  }
  [[nodiscard]] double all_carried() const { return std::accumulate(carried.begin(), carried.end(), 0.0); }
  /// mu K of Janssen: friction of the walls over the vertical stress beside them, from slices first to last - 1.
  [[nodiscard]] double friction_ratio(std::size_t first, std::size_t last) const {
    double shear = 0, vertical = 0;
    for (std::size_t s = first; s < last; ++s) {
      shear += carried[s];
      vertical += 0.5 * (stress[s] + (s > 0 ? stress[s - 1] : 0)) * section.edge * height / slices;
    }
    return shear / vertical;
  }
  /// Janssen's lambda with that of some slices, m.
  [[nodiscard]] double decay(std::size_t first, std::size_t last) const {
    return section.area / (section.edge * friction_ratio(first, last));
  }
};

/// Share of the weight that is left at a depth, of a column that deep: (lambda/z)(1 - exp(-z/lambda)), lambda =
/// W/(2 mu K) between two plates (Janssen, Z. Ver. Dt. Ing. 39, 1895, 1045).
double janssen(double depth_over_lambda) { return (1 - std::exp(-depth_over_lambda)) / depth_over_lambda; }

/// Vertical stress below each slice by Janssen's balance A dsigma/dz = load - edge mu K sigma, by the trapezoidal rule,
/// with the friction mu that the wall bears in each slice and one K. For one mu it is the exponential above.
Slices balance(const Slices& loads, const Slices& mu, double k, double depth, const Section& section) {
  Slices stress{};
  double above = 0;
  for (std::size_t s = 0; s < slices; ++s) {
    const double half = 0.5 * mu[s] * k * section.edge / section.area * depth / slices;
    above = stress[s] = (above * (1 - half) + loads[s] / section.area) / (1 + half);
  }
  return stress;
}

/// By how much the stress leaves Janssen's, rho g lambda (1 - exp(-z/lambda)), over that on the floor. mu K is that of
/// all of the wall, so that both meet on the floor: it is the shape that is looked at.
Slices off_the_exponential(const Column& column) {
  const double lambda = column.decay(0, slices), loads = column.weight / column.section.area;
  Slices off{};
  for (std::size_t s = 0; s < slices; ++s) {
    const double z = column.height * double(s + 1) / slices;
    off[s] = column.stress[s] - loads / column.height * lambda * (1 - std::exp(-z / lambda));
    off[s] /= column.stress[slices - 1];
  }
  return off;
}

double root_mean_square(const Slices& a) {
  return std::sqrt(std::inner_product(a.begin(), a.end(), a.begin(), 0.0) / slices);
}

/// A column after a step of gravity, at rest again.
std::unique_ptr<dem::Model> under(core::Scene& scene, double g, const dem::Model& before, double time,
                                  core::Timers& timers) {
  scene.column.gravity = g;
  auto next = std::make_unique<dem::Model>(scene, timers);
  next->start_from(before.checkpoint());
  while (next->time() < time) next->step(1e300);
  return next;
}

/// Janssen takes for granted that the column slides down its walls. One that has fallen together rebounds a little in
/// the end, and hardly any friction is left at its walls (measured: 9 and 15 % of what they could give). So its weight
/// is taken away and given back in steps, under which it yields downwards everywhere.
Column settled(core::Scene scene, const Section& section) {
  core::Timers timers;
  auto model = std::make_unique<dem::Model>(scene, timers);
  while (model->time() < 0.25) model->step(1e300);
  for (const double share : {0.5, 0.25, 0.125}) model = under(scene, share * gravity, *model, 0.015, timers);
  constexpr int steps = 10;
  for (int k = 1; k <= steps; ++k)
    model = under(scene, gravity * std::pow(0.125, 1 - double(k) / steps), *model, k < steps ? 0.015 : 0.15, timers);
  return Column(*model, section);
}

// Stress against depth, and from what the walls bear in the upper half what the floor bears. Janssen takes friction at
// the walls and the ratio of stresses for constants; of a column at rest they are not. Allowed of one column is 1.5
// times what the worst of eight was found to have, 2.0 % of the shape, and twice for the load on the floor, 5.8 %. Of
// the mean of all, which has a third of their scatter, 1.5 times 1.1 %: 1 %, this project's goal, is not met.
TEST(DemJanssen, StressAgainstDepth) {
  constexpr std::size_t top = 2, middle = 10;  // not the surface, where a slice is half empty
  constexpr int columns = 8;
  Slices mean{};
  for (std::uint64_t seed = 1; seed <= columns; ++seed) {
    const Column column = settled(silo(seed), slot);
    const std::string run = fmt::format(" of column {}", seed);
    // Rest: what moves still is below a thousandth of the weight.
    compare("floor and walls over the weight" + run, (column.floor + column.all_carried()) / column.weight, 1, 1e-3);
    const double above = column.friction_ratio(top, middle), below = column.friction_ratio(middle, slices - 1);
    const double expected = janssen(column.height / column.decay(top, middle)), share = column.floor / column.weight;
    compare("share of the floor" + run, share, expected, 0.11);
    const Slices off = off_the_exponential(column);
    for (std::size_t s = 0; s < slices; ++s) mean[s] += off[s] / columns;
    compare("stress off the exponential" + run, root_mean_square(off), 0, 0.03, 1);
    std::string profile;
    for (const double s : column.stress) profile += fmt::format("{:.1f} ", s);
    const double pushed = std::accumulate(column.pushed.begin(), column.pushed.end(), 0.0);
    testing::Test::RecordProperty(
        "column" + run,
        fmt::format("height {:.4g} m, weight {:.5g} Pa, mu K {:.4g}, above {:.4g}, below {:.4g}, friction "
                    "mobilised {:.3g} of {}; stress from the top, Pa: {}",
                    column.height, column.weight / column.section.area, column.friction_ratio(0, slices), above, below,
                    column.all_carried() / pushed, wall_friction, profile));
    EXPECT_LT(share, 0.9) << "the walls carry something";
  }
  compare("stress off the exponential, mean of the columns", root_mean_square(mean), 0, 0.016, 1);
}

// A column as deep as lambda leaves 1 - 1/e = 0.632121 of its weight; the rule of 20 slices errs by 1/(12 20^2).
TEST(DemJanssen, BalanceOfAnEvenWall) {
  Slices loads, mu;
  loads.fill(tube.area / slices), mu.fill(0.25);
  const double depth = tube.area / tube.edge / (0.25 * 0.4);
  EXPECT_NEAR(balance(loads, mu, 0.4, depth, tube).back(), 0.632121, 0.632121 / 4800);
}

// The same in a round silo, with the ratio K of outward to axial stress of all contacts. The wall bears a friction of
// 0.16 half-way down, less near the floor, which does not let particles slide, and hardly any near the surface: 0.12 of
// 0.2 on the whole. With this friction Janssen's balance has the load of the floor within 1.5 to 2.4 % and the stress
// at all depths within 4.1 % of it: 5 %, the goal, is met. An exponential with the K and friction of the upper half is
// 8 to 10 % off.
TEST(DemJanssen, ARoundSilo) {
  constexpr std::size_t top = 2, middle = 10;
  constexpr int columns = 3;
  constexpr double goal = 0.05;
  for (std::uint64_t seed = 1; seed <= columns; ++seed) {
    const Column column = settled(round_silo(seed), tube);
    const std::string run = fmt::format(" of column {}", seed);
    compare("floor and walls over the weight" + run, (column.floor + column.all_carried()) / column.weight, 1, 1e-3);
    const auto sum = [](const Slices& a, std::size_t from = 0, std::size_t to = slices) {
      return std::accumulate(a.begin() + long(from), a.begin() + long(to), 0.0);
    };
    // Without the lowest slice, whose contacts with the floor are not counted. Measured: 0.13 %.
    double between = 0;
    for (std::size_t s = top; s < slices - 1; ++s) between += 0.5 * (column.stress[s - 1] + column.stress[s]);
    compare("stress of the contacts over that of the balance" + run, sum(column.axial, top, slices - 1) / between, 1,
            0.002);
    const double k = sum(column.outward) / sum(column.axial);
    Slices mu{};
    for (std::size_t s = 0; s < slices; ++s) mu[s] = column.carried[s] / column.pushed[s];
    const Slices expected = balance(column.loads, mu, k, column.height, tube);
    compare("load of the floor" + run, column.stress.back(), expected.back(), goal);
    double worst = 0;
    for (std::size_t s = 0; s < slices; ++s) worst = std::max(worst, std::abs(column.stress[s] - expected[s]));
    compare("stress at any depth" + run, worst / column.stress.back(), 0, goal, 1);
    compare("stress off the exponential" + run, root_mean_square(off_the_exponential(column)), 0, 0.063, 1);
    const double exponential = janssen(column.height / column.decay(top, middle));
    const double share = column.floor / column.weight;
    compare("share of the floor by the upper half" + run, share, exponential, 0.155);
    testing::Test::RecordProperty(
        "round column" + run,
        fmt::format("height {:.4g} m, floor {:.4g} of the weight, mobilised {:.3g} of {}, K {:.4g}", column.height,
                    share, sum(column.carried) / sum(column.pushed), wall_friction, k));
  }
}

}  // namespace
}  // namespace polybed::scenes
