#include "multiscale/resolve/lattice/flow.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "unit/lattice/cubic_arrays.hpp"

using namespace polybed::multiscale::lattice;

namespace {

/// Walls across y: a channel along x between planes at `low` and `high`.
class Channel : public Obstacles {
 public:
  Channel(double low, double high) : low_(low), high_(high) {}
  std::size_t count() const override { return 2; }
  std::vector<std::int32_t> owners(const Sites& sites) const override {
    std::vector<std::int32_t> owner(sites.count(), none);
    for (int i = 0; i < sites.box[0] + 2; ++i)
      for (int j = 0; j < sites.box[1] + 2; ++j)
        for (int k = 0; k < sites.box[2] + 2; ++k) {
          const int y = (j - 1 + sites.box[1]) % sites.box[1];
          if (y <= low_) owner[sites.at(i, j, k)] = 0;
          if (y >= high_) owner[sites.at(i, j, k)] = 1;
        }
    return owner;
  }
  double fraction(std::int32_t owner, const Point& fluid, const std::array<int, 3>&) const override {
    return owner == 0 ? fluid[1] - low_ : high_ - fluid[1];
  }

 private:
  double low_, high_;
};

/// Greatest error of the parabola in a channel, over its peak.
double channel_error(double low, double high, int sites, Wall wall, double viscosity, bool inertia) {
  const FlowSetup setup{{3, sites, 2}, viscosity, inertia, wall};
  Flow<double> flow(setup, Channel(low, high));
  const double width = high - low, push = 8 * viscosity * 0.01 / (width * width);
  for (int n = 0; n < int(5 * width * width / viscosity / 2); ++n) flow.advance({push, 0, 0});
  double worst = 0;
  for (int y = 0; y < sites; ++y) {
    if (y <= low || y >= high) continue;
    const double exact = push * (y - low) * (high - y) / (2 * viscosity);
    worst = std::max(worst, std::abs(flow.velocity_at(1, y, 1)[0] - exact) / 0.01);
  }
  return worst;
}

}  // namespace

// The magic parameter 3/16 makes half-way walls exact for a parabola, at any viscosity.
TEST(Flow, ChannelIsExactBetweenHalfWayWalls) {
  for (const double viscosity : {0.1, 1.0})
    for (const bool inertia : {false, true})
      EXPECT_LT(channel_error(0.5, 8.5, 10, Wall::half_way, viscosity, inertia), 1e-10) << viscosity << inertia;
}

TEST(Flow, InterpolatedWallsAreOfSecondOrder) {
  const double coarse = channel_error(0.8, 8.1, 10, Wall::interpolated, 1.0 / 6, false);
  const double fine = channel_error(1.6, 16.2, 19, Wall::interpolated, 1.0 / 6, false);
  EXPECT_LT(fine, 0.01);
  EXPECT_GT(coarse / fine, 3.4);
  // Taken as half-way, the same walls are off by half a cell at most: first order.
  EXPECT_GT(channel_error(1.6, 16.2, 19, Wall::half_way, 1.0 / 6, false), 2 * fine);
}

TEST(Flow, ForcesBalanceThePressureGradient) {
  for (const Wall wall : {Wall::half_way, Wall::interpolated}) {
    const FlowSetup setup{{12, 12, 12}, 0.3, false, wall};
    const std::vector<Sphere> spheres = cubic_array(Cubic::body_centred, 0.3, 12);
    const CubicFlow found = flow_through(spheres, setup, {1e-3, 0, 0}, 1e-9);
    Flow<double> flow(setup, Spheres(spheres, setup.box));
    double sum = 0;
    for (const Point& on : found.flow.forces) sum += on[0];
    EXPECT_NEAR(sum, found.flow.driving[0] * flow.fluid_sites(), 1e-6 * sum);
    EXPECT_NEAR(found.flow.forces[0][0], found.flow.forces[1][0], 1e-3 * sum);
  }
}

// Narrow gaps between the spheres are what a wall whose place depends on the viscosity gets most wrong.
TEST(Flow, DragDoesNotDependOnViscosity) {
  const std::vector<Sphere> spheres = cubic_array(Cubic::simple, 0.5, 10);
  for (const Wall wall : {Wall::half_way, Wall::interpolated}) {
    const double one = flow_through(spheres, {{10, 10, 10}, 0.1, false, wall}, {1e-3, 0, 0}, 1e-8).net;
    const double two = flow_through(spheres, {{10, 10, 10}, 0.8, false, wall}, {1e-3, 0, 0}, 1e-8).net;
    EXPECT_NEAR(one, two, 1e-4 * one);  // what is left of the start, 1e-5
  }
}

TEST(Flow, SinglePrecisionAgrees) {
  const std::vector<Sphere> spheres = cubic_array(Cubic::simple, 0.3, 12);
  for (const Wall wall : {Wall::half_way, Wall::interpolated}) {
    const FlowSetup setup{{12, 12, 12}, 0.1, true, wall};
    const double two = flow_through<double>(spheres, setup, {0.01, 0, 0}, 1e-5).net;
    const double one = flow_through<float>(spheres, setup, {0.01, 0, 0}, 1e-5).net;
    EXPECT_NEAR(one, two, 1e-4 * two);  // round-off of thousands of steps
  }
}

// The lattice knows its axes: drag along a diagonal, and of a box cut otherwise, agrees as far as the grid is fine.
TEST(Flow, DragIsTheSameAlongEveryAxisAndDiagonal) {
  const std::vector<Sphere> spheres = cubic_array(Cubic::simple, 0.2, 16);
  const FlowSetup setup{{16, 16, 16}, 1.0 / 6, false, Wall::interpolated};
  const double x = flow_through(spheres, setup).net;
  EXPECT_NEAR(flow_through(spheres, setup, {0, 1e-3, 0}).net, x, 1e-4 * x);
  EXPECT_NEAR(flow_through(spheres, setup, {0, 0, 1e-3}).net, x, 1e-4 * x);
  EXPECT_NEAR(flow_through(spheres, setup, {1e-3, 1e-3, 0}).net, x, 1e-3 * x);
  EXPECT_NEAR(flow_through(spheres, setup, {6e-4, 6e-4, 6e-4}).net, x, 1e-3 * x);
}

TEST(Flow, SpheresMayLieAcrossTheEdgesOfTheBox) {
  const FlowSetup setup{{12, 12, 12}, 1.0 / 6, true, Wall::interpolated};
  std::vector<Sphere> spheres = cubic_array(Cubic::simple, 0.3, 12);
  const double inside = flow_through(spheres, setup).net;
  spheres[0].centre = {spheres[0].centre[0] - 3, spheres[0].centre[1] + 9, spheres[0].centre[2] - 15};
  EXPECT_NEAR(flow_through(spheres, setup).net, inside, 1e-5 * inside);
}

TEST(Flow, UsesLittleMemory) {
  const FlowSetup setup{{32, 32, 32}, 1.0 / 6, false, Wall::interpolated};
  const Flow<float> flow(setup, Spheres(cubic_array(Cubic::simple, 0.5, 32, 2), setup.box));
  EXPECT_LT(double(flow.memory_bytes()), 200.0 * 32 * 32 * 32);
}
