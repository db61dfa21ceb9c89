// A fluid alone in a round column, or crossing the sides of a box: what enters leaves, through every layer and out of
// every cell.
#include "fluid/flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/case/scene.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/operators.hpp"

namespace polybed::fluid {
namespace {

using core::Index;

constexpr double inflow = 0.02;  // m/s

core::Scene round_scene(int across, int deep) {
  core::Scene scene;
  scene.column.dimensions = 3;
  scene.column.shape = core::ColumnShape::cylinder;
  scene.column.size = {60e-3, 80e-3, 60e-3};
  scene.column.cells = {across, 8, deep};
  scene.fluid.name = "test fluid";
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 1e-3;
  scene.effects["fluid_stress"] = "newtonian";
  scene.inlet.superficial_velocity = {{0.0, inflow}};
  return scene;
}

/// Particles at random, as sums on faces: what they displace and how their flux differs from place to place.
ParticlePhase stirred(const core::Grid& grid) {
  ParticlePhase phase(grid, false);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> one(0, 1);
  core::for_each_row(grid, {{0, 0, 0}, {grid.cells[0], 4, grid.cells[2]}}, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      phase.voidage[c] = 1 - 0.4 * one(random);
      for (std::size_t a = 0; a < 3; ++a) {
        phase.voidage_on[a][c] = 1 - 0.4 * one(random);
        phase.flux[a][c] = 0.4 * inflow * (one(random) - 0.5);
        phase.drag[a][c] = 200 * one(random);
      }
    }
  });
  core::for_each_row(grid, {{0, 0, 0}, {grid.cells[0], 1, grid.cells[2]}}, [&](Index begin, Index end) {
    std::fill(phase.flux[1].begin() + begin, phase.flux[1].begin() + end, 0.0);  // nothing passes the bottom
  });
  core::hold_closed(grid, phase.flux);
  return phase;
}

void expect_volume_kept(const Flow& flow) {
  const core::Grid& grid = flow.grid();
  core::Field outflow = core::make_field(grid);
  core::divergence(grid, flow.state().flux, outflow);
  double worst = 0;
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) worst = std::max(worst, std::abs(outflow[c]));
  });
  EXPECT_LT(worst * grid.smallest_spacing() / inflow, 1e-6);  // residual of 1e-8 in the norm of all cells
  const double area = core::open_cells_of_layer(grid);
  for (int j = 0; j <= grid.cells[1]; ++j) {
    double passing = 0;
    core::for_each_row(grid, {{0, j, 0}, {grid.cells[0], j + 1, grid.cells[2]}}, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        passing += grid.metric->open[1][c] * flow.state().flux[1][c];
    });
    EXPECT_NEAR(passing / area, inflow, 1e-7 * inflow) << j;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = std::size_t(axis);
    core::for_each_row(grid, core::owned_faces(grid, axis), [&](Index begin, Index end) {
      for (auto f = std::size_t(begin); f < std::size_t(end); ++f) {
        const double open = grid.metric->open[a][f];
        EXPECT_TRUE(open > 0 || flow.state().velocity[a][f] == 0) << a;
        EXPECT_TRUE(open > 0 || flow.state().flux[a][f] == 0) << a;
      }
    });
  }
}

TEST(FlowInARoundColumn, KeepsItsVolume) {
  for (const auto& cells : {std::array{4, 4}, {7, 7}, {12, 12}, {6, 9}}) {
    SCOPED_TRACE(testing::Message() << cells[0] << " x " << cells[1] << " cells");
    const core::Scene scene = round_scene(cells[0], cells[1]);
    Flow flow(scene, core::grid_of(scene.column, nullptr), 1e-8);
    const ParticlePhase none(flow.grid(), false), some = stirred(flow.grid());
    for (const ParticlePhase* phase : {&none, &some}) {
      flow.begin(0, *phase);
      expect_volume_kept(flow);
      for (int n = 0; n < 20; ++n) (void)flow.advance(n * 2e-3, 2e-3, *phase);
      expect_volume_kept(flow);
    }
  }
}

// Without friction a plug of fluid stays one, and no pressure drives it.
TEST(FlowInARoundColumn, WithoutViscosityIsAPlug) {
  core::Scene scene = round_scene(9, 9);
  scene.effects["fluid_stress"] = "none";
  Flow flow(scene, core::grid_of(scene.column, nullptr), 1e-10);
  const ParticlePhase none(flow.grid(), false);
  flow.begin(0, none);
  for (int n = 0; n < 20; ++n) (void)flow.advance(n * 2e-3, 2e-3, none);
  const core::Grid& grid = flow.grid();
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      const bool open = grid.metric->volume[c] > 0;
      EXPECT_NEAR(flow.state().velocity[1][c], open ? inflow : 0, 1e-8 * inflow);
      EXPECT_NEAR(flow.state().pressure[c], 0, 1e-6 * 1000 * inflow * inflow);
    }
  });
}

// A jump of pressure across the wall is none: what stands on closed faces is the gradient beside them.
TEST(FlowInARoundColumn, HasTheGradientOfItsNeighbourOnClosedFaces) {
  const core::Scene scene = round_scene(6, 6);
  Flow flow(scene, core::grid_of(scene.column, nullptr), 1e-8);
  const core::Grid& grid = flow.grid();
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 6; ++i) flow.state().pressure[std::size_t(grid.index(i, j, k))] = 3.0 * i;
  flow.set_gradient();
  for (int i = 0; i <= 6; ++i) {
    const auto f = std::size_t(grid.index(i, 4, 2));
    EXPECT_NEAR(flow.gradient()[0][f], 3.0 / grid.spacing[0], 1e-9) << i;
  }
}

/// A box of 8 x 6 cells of 10 mm without viscosity, its fluid alone.
core::Scene box_scene() {
  core::Scene scene;
  scene.column.size = {0.08, 0.06, 0.01};
  scene.column.cells = {8, 6, 1};
  scene.fluid.name = "test fluid";
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 1e-3;
  scene.inlet.superficial_velocity = {{0.0, 0.0}};
  return scene;
}

// In over the whole left side, out over the whole right one: a plug that no pressure drives.
TEST(FlowThroughSides, IsAPlugBetweenTwoWholeSides) {
  core::Scene scene = box_scene();
  scene.inlet.at = core::ColumnEnd::top;
  scene.jets.push_back({{0.0}, {0.06}, {{0.0, inflow}}, core::ColumnFace::left});
  scene.jets.push_back({{0.0}, {0.06}, {{0.0, -inflow}}, core::ColumnFace::right});
  Flow flow(scene, core::grid_of(scene.column, nullptr), 1e-10);
  const ParticlePhase none(flow.grid(), false);
  flow.begin(0, none);
  for (int n = 0; n < 20; ++n) (void)flow.advance(n * 0.02, 0.02, none);
  core::for_each_row(flow.grid(), core::owned_faces(flow.grid(), 0), [&](Index begin, Index end) {
    for (auto f = std::size_t(begin); f < std::size_t(end); ++f)
      EXPECT_NEAR(flow.state().velocity[0][f], inflow, 1e-8 * inflow);
  });
  core::for_each_row(flow.grid(), [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      EXPECT_NEAR(flow.state().velocity[1][c], 0, 1e-8 * inflow);
      EXPECT_NEAR(flow.state().pressure[c] - flow.state().pressure[std::size_t(flow.grid().index(0, 0))], 0,
                  1e-6 * 1000 * inflow * inflow);
    }
  });
}

// Jets over 10 and 15 mm of the sides: each level above them carries (10 + 15) mm x 20 mm/s over 80 mm.
TEST(FlowThroughSides, PassesOnWhatJetsBring) {
  core::Scene scene = box_scene();
  scene.effects["fluid_stress"] = "newtonian";
  scene.jets.push_back({{0.005}, {0.015}, {{0.0, inflow}}, core::ColumnFace::left});
  scene.jets.push_back({{0.01}, {0.025}, {{0.0, inflow}}, core::ColumnFace::right});
  Flow flow(scene, core::grid_of(scene.column, nullptr), 1e-10);
  const core::Grid& grid = flow.grid();
  const ParticlePhase none(grid, false);
  flow.begin(0, none);
  for (int n = 0; n < 20; ++n) (void)flow.advance(n * 0.02, 0.02, none);
  for (int j = 3; j <= 6; ++j) {
    double passing = 0;
    for (int i = 0; i < 8; ++i) passing += flow.state().flux[1][std::size_t(grid.index(i, j))];
    EXPECT_NEAR(passing / 8, inflow * 25 / 80, 1e-9 * inflow) << j;
  }
  EXPECT_NEAR(flow.state().velocity[0][std::size_t(grid.index(0, 0))], 0.5 * inflow, 1e-17);
  EXPECT_NEAR(flow.state().velocity[0][std::size_t(grid.index(8, 1))], -inflow, 1e-17);
}

}  // namespace
}  // namespace polybed::fluid
