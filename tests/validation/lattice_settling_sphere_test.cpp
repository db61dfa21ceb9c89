// A sphere that falls through a closed box of oil, against the experiment of ten Cate et al. (Phys. Fluids 14 (2002)
// 4012). The box has walls all round, which resolve has not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "multiscale/resolve/lattice/flow.hpp"
#include "scenes/record.hpp"

namespace polybed::validation {
namespace {

using namespace multiscale::lattice;
using scenes::record;

/// One sphere, and a layer of sites that serves as the wall on both sides of the periodic box.
class Tank : public Obstacles {
 public:
  Tank(const Sphere& sphere, const std::array<int, 3>& box) : sphere_({sphere}, box), box_(box) {}
  [[nodiscard]] std::size_t count() const override { return 2; }
  [[nodiscard]] std::vector<std::int32_t> owners(const Sites& sites) const override {
    std::vector<std::int32_t> owner = sphere_.owners(sites);
    for (int i = 0; i < box_[0] + 2; ++i)
      for (int j = 0; j < box_[1] + 2; ++j)
        for (int k = 0; k < box_[2] + 2; ++k)
          if (i % box_[0] == 1 || j % box_[1] == 1 || k % box_[2] == 1) owner[sites.at(i, j, k)] = 1;
    return owner;
  }
  [[nodiscard]] double fraction(std::int32_t owner, const Point& fluid, const std::array<int, 3>& way) const override {
    return owner == 1 ? 0.5 : sphere_.fraction(0, fluid, way);
  }

 private:
  Spheres sphere_;
  std::array<int, 3> box_;
};

constexpr double diameter = 15e-3, solids_density = 1120, wide = 0.1, high = 0.16, gravity = 9.81;

/// Table I, and the greatest velocity over that in an infinite liquid, Table II; m/s, kg/m3, Pa s.
struct Oil {
  double density, viscosity, alone, greatest;
};

struct Moment {
  double time, velocity;  ///< s, m/s
};

/// From rest, the lowest point 120 mm above the floor, until it is one cell above it. Velocity as mean over one cell
/// of the way: forces vary as walls pass the sites.
std::vector<Moment> fall(const Oil& oil, int cells, double speed) {
  const double scale = cells / wide, step = speed / scale / oil.alone, radius = 0.5 * diameter * scale;
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3), mass = solids_density / oil.density * volume;
  const double weight = (mass - volume) * gravity * step * step * scale;
  const std::array<int, 3> box{cells + 1, cells + 1, int(std::lround(high * scale)) + 1};
  const double middle = 0.5 + 0.5 * cells;
  Sphere sphere{{middle + 0.31, middle + 0.17, 0.5 + 0.1275 * scale}, radius};  // off the symmetry of the sites
  Flow<float> flow({box, oil.viscosity / oil.density * step * scale * scale, true, Wall::interpolated},
                   Tank(sphere, box));
  std::vector<Motion> motion(2);
  std::vector<double> height{sphere.centre[2]};
  std::vector<Moment> moments;
  double velocity = 0;
  std::size_t cell_ago = 0;
  for (motion[0].centre = sphere.centre; sphere.centre[2] - radius > 1.5; motion[0].centre = sphere.centre) {
    motion[0].velocity = {0, 0, velocity};
    flow.forget_forces();
    flow.move_to(Tank(sphere, box), motion);
    if (height.size() % 100 == 0) flow.level_density();
    flow.advance({0, 0, 0});
    velocity += (flow.impulses()[0].force[2] - 2 * weight) / mass;
    sphere.centre[2] += 2 * velocity;
    height.push_back(sphere.centre[2]);
    while (height[cell_ago] > sphere.centre[2] + 1 && cell_ago + 1 < height.size()) ++cell_ago;
    const double since = 2 * step * double(height.size() - 1 - cell_ago);
    if (since > 0 && cell_ago > 0)
      moments.push_back(
          {2 * step * double(height.size() - 1) - since / 2, (height[cell_ago] - height.back()) / scale / since});
  }
  return moments;
}

double greatest(const std::vector<Moment>& moments) {
  double most = 0;
  for (const Moment& m : moments) most = std::max(most, m.velocity);
  return most;
}

double velocity_at(const std::vector<Moment>& moments, double time) {
  const auto after =
      std::lower_bound(moments.begin(), moments.end(), time, [](const Moment& m, double t) { return m.time < t; });
  return after == moments.end() ? 0 : after->velocity;
}

const Oil e1{970, 0.373, 0.03829, 0.947}, e4{960, 0.058, 0.12839, 0.955};

// On 7.5 cells per diameter 0.4 and 3.6 % too slow; 3 % were asked.
TEST(SettlingSphere, GreatestVelocityAtReynoldsNumber1) {
  const double ratio = greatest(fall(e1, 50, 0.02)) / e1.alone;
  record("E1", ratio);
  EXPECT_NEAR(ratio, e1.greatest, 0.03 * e1.greatest);
}

/// Figure 8b, case E4, read off by others (GeoTaichi, examples/cfdem/SemiResolved/SphereFallingOil); s, m/s.
constexpr std::array<Moment, 8> measured{{{0.1002, 0.0505},
                                          {0.2005, 0.0790},
                                          {0.3107, 0.1010},
                                          {0.4745, 0.1114},
                                          {0.6081, 0.1185},
                                          {0.8053, 0.1213},
                                          {0.9490, 0.1229},
                                          {1.0959, 0.1229}}};

// Points read off scatter by 2 % of the greatest velocity; the last is 0.8 diameters above the floor.
TEST(SettlingSphere, VelocityOverTimeAtReynoldsNumber32) {
  const std::vector<Moment> moments = fall(e4, 50, 0.05);
  record("E4", greatest(moments) / e4.alone);
  EXPECT_NEAR(greatest(moments) / e4.alone, e4.greatest, 0.05 * e4.greatest);
  double worst = 0;
  for (const Moment& m : measured)
    worst = std::max(worst, std::abs(velocity_at(moments, m.time) - m.velocity) / (e4.greatest * e4.alone));
  record("E4 over time", worst);
  EXPECT_LT(worst, 0.06);
}

}  // namespace
}  // namespace polybed::validation
