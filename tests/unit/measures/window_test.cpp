#include "measures/window.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace polybed::measures {
namespace {

TEST(Window, HasTheRowsAtItsEnds) {
  const std::vector<double> time{0, 0.1, 0.1 + 0.2, 0.4};
  EXPECT_EQ((Window{0.3, 0.4}.rows(time).begin), 2u);  // which is less than 0.1 + 0.2
  EXPECT_EQ((Window{0.1, 0.3}.rows(time).end), 3u);
  EXPECT_EQ((Window{0.5, 1}.rows(time).count()), 0u);
  EXPECT_EQ((Window{0, 1}.rows({}).count()), 0u);
}

// A bed of 0.1 m with centres at 0.02 and 0.07 m, lighter than the fluid: 45 of 50 Pa.
TEST(Window, MeansAreOfColumnsAndOfWhatFollowsFromThem) {
  StoredRun run{{"a", "b"},
                {{"time_s", "bed_height_m", "centre_a_m", "centre_b_m", "pressure_drop_Pa", "buoyant_weight_Pa"},
                 {{0, 0.25, 0.5}, {9, 0.1, 0.1}, {9, 0.02, 0.02}, {9, 0.07, 0.07}, {9, -45, -45}, {9, -50, -50}}}};
  const InWindow found = in_window(run, {0.25, 1});
  EXPECT_EQ(found.rows, 2u);
  EXPECT_EQ(found.step, 0.25);
  EXPECT_EQ(found.means.at("pressure_drop_over_weight").mean, 0.9);
  EXPECT_NEAR(found.means.at("centre_difference").mean, 0.5, 1e-15);
  EXPECT_FALSE(found.means.contains("time_s"));
  run.history.values[5][2] = 0;
  EXPECT_FALSE(in_window(run, {0.25, 1}).means.contains("pressure_drop_over_weight"));
}

// One bed on four slabs of 0.1 m and on two of 0.2 m, and one with half of the solids: 0.25 of 0.5 are apart.
TEST(Window, DistancesAreOnTheSlabsAskedFor) {
  const auto run = [](double slab, std::vector<double> phi) {
    return StoredRun{{"a"}, {}, {1}, {{.profile = {slab, {std::move(phi)}, {}}}}};
  };
  const StoredRun fine = run(0.1, {0.5, 0.5, 0, 0}), coarse = run(0.2, {0.5, 0}), low = run(0.1, {0.5, 0, 0, 0});
  EXPECT_THROW((void)distances(fine, coarse, {0, 1}), core::FileError);
  EXPECT_NEAR(distances(fine, coarse, {0, 1}, 2).at("profile").mean, 0, 1e-15);
  EXPECT_NEAR(distances(low, coarse, {0, 1}, 2).at("profile").mean, 0.5, 1e-15);
}

}  // namespace
}  // namespace polybed::measures
