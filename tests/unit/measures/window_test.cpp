#include "measures/window.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"

namespace polybed::measures {
namespace {

/// 401 rows from 0 to 100 s of a bed whose height is a function of time, its centres 0.2 and 0.7 of it; a profile every
/// second, of one slab of 1 m.
template <class Height>
StoredRun run_of(const Height& height) {
  StoredRun run{{"a", "b"},
                {{"time_s", "bed_height_m", "centre_a_m", "centre_b_m", "pressure_drop_Pa", "buoyant_weight_Pa"}, {}}};
  run.history.values.resize(run.history.columns.size());
  for (int n = 0; n <= 400; ++n) {
    const double h = height(n / 4.0), row[] = {n / 4.0, h, 0.2 * h, 0.7 * h, -45, -50};
    for (std::size_t c = 0; c < run.history.values.size(); ++c) run.history.values[c].push_back(row[c]);
  }
  for (int n = 0; n <= 100; ++n) {
    run.time.push_back(n);
    run.beds.push_back({{1, {{0.5}, {0.1}}, {}}});
  }
  return run;
}

const auto still = [](double) { return 0.1; };

TEST(Window, IsTheLastQuarterOfWhatAllHave) {
  StoredRun run = run_of(still), other = run;
  const Window own = common_window({&run});
  EXPECT_EQ(own.begin, 75);
  EXPECT_EQ(own.end, 100);
  EXPECT_FALSE(own.shortened);
  for (std::vector<double>& column : other.history.values) column.resize(161);  // to 40 s
  EXPECT_EQ(common_window({&run, &other}).begin, 30);
  EXPECT_EQ(common_window({&run, &other}).end, 40);
  for (std::vector<double>& column : other.history.values) column.resize(1);
  EXPECT_THROW((void)common_window({&run, &other}), core::FileError);
  for (std::vector<double>& column : other.history.values) column.clear();
  EXPECT_THROW((void)common_window({&other}), core::FileError);
}

TEST(Window, OfABedThatStillRisesIsShorter) {
  const StoredRun run = run_of([](double t) { return 0.1 + 1e-3 * t; });
  EXPECT_TRUE(common_window({&run}).shortened);
  EXPECT_NEAR(common_window({&run}).begin, 87.5, 0.3);  // at most half of the window is dropped
}

TEST(Window, HasTheRowsAtItsEnds) {
  const std::vector<double> time{0, 0.1, 0.1 + 0.2, 0.4};
  EXPECT_EQ((Window{0.3, 0.4}.rows(time).begin), 2u);  // which is less than 0.1 + 0.2
  EXPECT_EQ((Window{0.1, 0.3}.rows(time).end), 3u);
  EXPECT_EQ((Window{0.5, 1}.rows(time).count()), 0u);
  EXPECT_EQ((Window{0, 1}.rows({}).count()), 0u);
}

// Lighter than the fluid: 45 of 50 Pa.
TEST(Window, MeansAreOfColumnsAndOfWhatFollowsFromThem) {
  StoredRun run = run_of(still);
  const InWindow found = in_window(run, {75, 100});
  EXPECT_EQ(found.rows, 101u);
  EXPECT_EQ(found.step, 0.25);
  EXPECT_EQ(found.means.at("pressure_drop_over_weight").mean, 0.9);
  EXPECT_NEAR(found.means.at("centre_difference").mean, 0.5, 1e-15);
  EXPECT_FALSE(found.means.contains("time_s"));
  run.history.values[5][350] = 0;
  EXPECT_FALSE(in_window(run, {75, 100}).means.contains("pressure_drop_over_weight"));
}

// The first of 24 profiles has 0.24 more: 0.01 in the mean. Ten groups of two or three: without the first 0.5, else
// 0.24 over the 22 or 21 that are left. Two slabs of half a metre have what the one has; the centre stays where it is.
TEST(Window, MeanProfileLeavesOutGroupsForItsInterval) {
  StoredRun run = run_of(still);
  run.beds[72].profile.fraction[0][0] += 0.24;
  const InWindow found = in_window(run, {72, 95}, 2);
  EXPECT_EQ(found.profiles, 24u);
  EXPECT_EQ(found.height, (std::vector{0.25, 0.75}));
  std::vector<Value> without_group;
  for (const Rows& group : groups_of(24))
    without_group.push_back(group.begin == 0 ? 0.5 : 0.5 + 0.24 / double(24 - group.count()));
  EXPECT_NEAR(found.mean[0][1].mean, 0.51, 1e-15);
  EXPECT_NEAR(found.mean[0][1].interval.value(), jackknife_interval(without_group).value(), 1e-15);
  EXPECT_EQ(found.mean[1][0].interval, 0);
  EXPECT_NEAR(found.of_mean.at("centre_a_m").mean, 0.5, 1e-15);
  EXPECT_NEAR(found.means.at("centre_a_m").mean, 0.02, 1e-15);
}

// |0.51 - 0.5| over 0.5.
TEST(Window, DistancesAreOfMeanProfiles) {
  StoredRun run = run_of(still);
  const StoredRun reference = run;
  run.beds[72].profile.fraction[0][0] += 0.24;
  EXPECT_NEAR(distances(run, reference, {72, 95}).at("profile_a").mean, 0.02, 1e-14);
  EXPECT_GT(distances(run, reference, {72, 95}).at("profile_a").interval.value(), 0);
  EXPECT_TRUE(distances(run, reference, {200, 300}).empty());
  run.species = {"a"};
  EXPECT_THROW((void)distances(run, reference, {72, 95}), core::FileError);
}

}  // namespace
}  // namespace polybed::measures
