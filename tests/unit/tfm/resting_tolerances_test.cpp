// Tolerances of velocities that follow how fast a bed moves.
#include "tfm/tolerances.hpp"

#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using Kind = tfm::StateLayout::Entry::Kind;

/// Eight cells one above the other, the lower four full; tolerances of 1e-5, a velocity scale of 0.02 m/s, 10 m/s2.
struct Column {
  core::Timers timers;
  tfm::Model model{closed(), timers};
  const core::Grid& grid = model.constants().grid;
  tfm::StateLayout layout{grid, 1, false};
  tfm::RestingTolerances tolerances{grid, model.boundaries(), layout, std::vector<double>(layout.size(), 1e-5), 0.02,
                                    10};
  std::vector<double> y = std::vector<double>(layout.size(), 0.0), atol = y;

  static core::Scene closed() {
    core::Scene scene = uniform_bed(1e-3, 2500, 1000, 1e-3, 0.5, 8, 0.04);
    scene.column.closed = true;
    return scene;
  }
  Column() {
    for (std::size_t c = 0; c < 4; ++c) y[c] = 0.5;
  }
  /// Place in the state of what stands on the lower face of a cell.
  [[nodiscard]] std::size_t on_face(Kind kind, std::size_t cell) const {
    for (const tfm::StateLayout::Entry& entry : layout.entries())
      if (entry.kind == kind && entry.axis == 1) return entry.begin + cell;
    throw std::logic_error("no such field");
  }
  void find(std::span<const double> dydt = {}) { tolerances(y, dydt, atol); }
};

TEST(RestingTolerances, ShrinkWithTheSpeedAndStopAtAMillionthOfATenth) {
  Column column;
  const std::size_t within = column.on_face(Kind::velocity, 2), flux = column.on_face(Kind::flux, 6);
  column.find();
  EXPECT_DOUBLE_EQ(column.atol[within], 1e-12);
  EXPECT_DOUBLE_EQ(column.atol[flux], 1e-12);
  EXPECT_EQ(column.atol[0], 1e-5) << "a fraction";
  column.y[within] = -0.002;
  column.find();
  EXPECT_DOUBLE_EQ(column.atol[within], 1e-6);
  column.y[flux] = 0.03;
  column.find();
  EXPECT_EQ(column.atol[within], 1e-5) << "never above that of a bed that moves";
}

TEST(RestingTolerances, WhatFallsInTheEmptyColumnNeitherCountsNorShrinks) {
  Column column;
  for (const std::size_t cell : {5, 6}) {  // above the surface
    column.y[column.on_face(Kind::velocity, cell)] = -0.1;
    column.find();
    EXPECT_EQ(column.atol[column.on_face(Kind::velocity, cell)], 1e-5) << cell;
    EXPECT_DOUBLE_EQ(column.atol[column.on_face(Kind::velocity, 2)], 1e-12) << cell;
  }
}

// The surface, with solids below alone, rests with them, but falls on where nothing holds them.
TEST(RestingTolerances, TheSurfaceShrinksAndDoesNotCount) {
  Column column;
  column.y[column.on_face(Kind::velocity, 4)] = -0.1;
  column.find();
  EXPECT_DOUBLE_EQ(column.atol[column.on_face(Kind::velocity, 4)], 1e-12);
  EXPECT_DOUBLE_EQ(column.atol[column.on_face(Kind::velocity, 2)], 1e-12);
}

// 0.02 m/s after 2 ms at 10 m/s2: at 1 m/s2 a tenth.
TEST(RestingTolerances, ABedThatIsLetGoIsNotAtRest) {
  Column column;
  std::vector<double> dydt(column.layout.size(), 0.0);
  dydt[column.on_face(Kind::velocity, 2)] = -1;
  column.find(dydt);
  EXPECT_DOUBLE_EQ(column.atol[column.on_face(Kind::velocity, 3)], 1e-6);
}

}  // namespace
}  // namespace polybed::scenes
