#include "multiscale/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "multiscale/case_differences.hpp"
#include "multiscale/comparison_text.hpp"

namespace polybed::multiscale {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::size_t slabs = 50;
constexpr double slab = 2e-3;

/// A run of 100 s at rest: fine below `level`, coarse from there to `surface`, both at a solids fraction of 0.5; a row
/// of the history every 0.1 s, a profile every second. The bed height swings by `swing`, one row up and the next down.
Measured at_rest(double level, double surface, bool coarse_on_top = true, double swing = 0) {
  Measured run;
  run.history.columns = {"time_s",          "bed_height_m", "pressure_drop_Pa", "buoyant_weight_Pa", "centre_fine_m",
                         "centre_coarse_m", "mixing"};
  run.history.values.resize(run.history.columns.size());
  const double low = level / 2, high = (level + surface) / 2;
  for (int n = 0; n <= 1000; ++n) {
    const std::vector<double> row{0.1 * n,
                                  surface + (n % 2 == 0 ? swing : -swing),
                                  98,
                                  100,
                                  coarse_on_top ? low : high,
                                  coarse_on_top ? high : low,
                                  0.25};
    for (std::size_t c = 0; c < row.size(); ++c) run.history.values[c].push_back(row[c]);
  }
  for (std::size_t k = 0; k < slabs; ++k) run.profiles.height.push_back((double(k) + 0.5) * slab);
  run.profiles.names = {"phi_coarse", "phi_fine"};
  run.profiles.values.resize(2);
  for (int n = 0; n <= 100; ++n) {
    run.profiles.time.push_back(n);
    for (const double z : run.profiles.height) {
      const bool below = z<level, above = z> level && z < surface;
      run.profiles.values[coarse_on_top ? 0 : 1].values.push_back(above ? 0.5 : 0);
      run.profiles.values[coarse_on_top ? 1 : 0].values.push_back(below ? 0.5 : 0);
    }
  }
  return run;
}

const ComparedMeasure& measure(const Comparison& comparison, const std::string& name) {
  for (const ComparedMeasure& m : comparison.measures)
    if (m.name == name) return m;
  throw std::invalid_argument("no measure " + name);
}

const Score& score(const Comparison& comparison, const std::string& name) {
  for (const Score& s : comparison.scores)
    if (s.name == name) return s;
  throw std::invalid_argument("no score " + name);
}

// Of 26 profiles in the window the first two have 0.13 more fine in the lowest slab: 0.26/26 in the mean. Ten groups of
// 2 3 2 3 3 2 3 2 3 3 are left out in turn: 0 without the first, 0.26/24 without another of 2, 0.26/23 without one
// of 3. Their squares about their mean, 0.01003261, are 1.122807e-4, times 9/10; 2.262 of 9 degrees of freedom times
// its root is 0.0227387. The rows themselves are spread by 0.0346.
TEST(Compare, MeanProfilesHaveTheIntervalOfTheirMeanNotTheSpreadInTime) {
  Measured swings = at_rest(0.03, 0.06);
  for (const std::size_t t : {75, 76}) swings.profiles.values[1].values[t * slabs] += 0.13;
  const Comparison c = compare(swings, at_rest(0.03, 0.06));
  ASSERT_EQ(c.species, (std::vector<std::string>{"fine", "coarse"}));
  ASSERT_EQ(c.height.size(), slabs);
  EXPECT_NEAR(c.tfm_means[0][0].mean, 0.51, 1e-14);
  EXPECT_NEAR(*c.tfm_means[0][0].error, 0.0227387, 1e-7);
  EXPECT_EQ(c.tfm_means[0][1].mean, 0.5);
  EXPECT_EQ(*c.tfm_means[0][1].error, 0);
  EXPECT_EQ(*c.dem_means[0][0].error, 0);
  EXPECT_EQ(c.dem_means[1][0].mean, 0) << "coarse on top";
  EXPECT_EQ(c.dem_means[1][15].mean, 0.5) << "centre at 31 mm";
}

TEST(Compare, ARunWithItself) {
  const Measured run = at_rest(0.03, 0.06);
  const Comparison c = compare(run, run);
  EXPECT_EQ(c.window.begin, 75);
  EXPECT_EQ(c.window.end, 100);
  EXPECT_FALSE(c.window.shortened);
  EXPECT_EQ(c.tfm_profiles, 26U);  // 75 to 100 s
  for (const ComparedMeasure& m : c.measures) {
    ASSERT_TRUE(m.tfm) << m.name;
    EXPECT_EQ(*m.difference(), 0) << m.name;
  }
  for (const Score& s : c.scores) EXPECT_EQ(*s.value, 0) << s.name;
  EXPECT_EQ(c.tfm_top->species, "coarse");
  EXPECT_TRUE(c.tfm_top->certain);
  EXPECT_TRUE(c.warnings.empty()) << c.warnings.front();
}

// By hand: fine 0 to 30 mm in both; coarse 30 to 60 mm and 30 to 66 mm.
TEST(Compare, AHigherBed) {
  const Comparison c = compare(at_rest(0.03, 0.066), at_rest(0.03, 0.06));
  EXPECT_NEAR(measure(c, "bed_height_m").tfm->mean, 0.066, 1e-15);
  EXPECT_NEAR(*measure(c, "bed_height_m").difference(), 0.006, 1e-15);
  EXPECT_NEAR(measure(c, "pressure_drop_over_weight").dem->mean, 0.98, 1e-15);
  EXPECT_NEAR(*measure(c, "centre_fine_m").difference(), 0, 1e-15);
  EXPECT_NEAR(*measure(c, "centre_coarse_m").difference(), 0.003, 1e-15);
  EXPECT_NEAR(*score(c, "e_H").value, 0.1, 1e-12);
  EXPECT_FALSE(*score(c, "e_H").reached());
  EXPECT_NEAR(*score(c, "e_b").value, (0.048 - 0.015) / 0.066 - 0.5, 1e-12);  // exactly 0
  EXPECT_TRUE(*score(c, "e_b").reached());
  EXPECT_NEAR(*score(c, "profile_coarse").value, 0.2, 1e-12);  // 6 of 30 mm more
  EXPECT_NEAR(*score(c, "profile_fine").value, 0, 1e-12);
  // The fine species has 5/11 and 1/2 of the volume: they differ over 1/22 of it, but for the slice that both cut.
  EXPECT_NEAR(*score(c, "D1").value, 1.0 / 22, 1.0 / 50);
  // The lower layer is pure: the thesis' interface is its top, within a slice of 1/50 of the bed and the tolerance.
  EXPECT_NEAR(measure(c, "interface_m").dem->mean, 0.03, 0.06 * (0.05 + 1.0 / 50));
}

TEST(Compare, AnInvertedBed) {
  const Comparison c = compare(at_rest(0.03, 0.06, true), at_rest(0.03, 0.06, false));
  EXPECT_EQ(c.tfm_top->species, "coarse");
  EXPECT_EQ(c.dem_top->species, "fine");
  EXPECT_NEAR(*score(c, "e_b").value, 1, 1e-12);
  EXPECT_NEAR(*score(c, "D1").value, 1, 1e-12);
  EXPECT_NEAR(*score(c, "profile_fine").value, 2, 1e-12);
  EXPECT_FALSE(*score(c, "D1").reached());
}

// Rows that alternate by +-a about the mean have the variance a^2; batches of 12 rows have no mean but the mean. 251
// rows in the window, so the last one is left over: a/251.
TEST(Compare, FluctuationsAreInTheInterval) {
  const double swing = 1e-3;
  const Comparison c = compare(at_rest(0.03, 0.06, true, swing), at_rest(0.03, 0.06));
  const ComparedMeasure& height = measure(c, "bed_height_m");
  EXPECT_NEAR(height.tfm->mean, 0.06, swing / 200);
  EXPECT_NEAR(*height.tfm->error, 2.093 * swing / std::sqrt(251.0), 0.05 * swing / std::sqrt(251.0));
  EXPECT_EQ(*height.dem->error, 0);
  EXPECT_EQ(*height.difference_error(), *height.tfm->error);
  EXPECT_NEAR(*score(c, "e_H").error, *height.tfm->error / 0.06, 1e-12);
}

TEST(Compare, OnlyTheTimeThatBothHaveIsCompared) {
  Measured shorter = at_rest(0.03, 0.06);
  for (auto& column : shorter.history.values) column.resize(401);  // to 40 s
  Measured longer = at_rest(0.03, 0.06);
  for (std::size_t n = 401; n < 1001; ++n) longer.history.values[1][n] = 0.09;
  const Comparison c = compare(shorter, longer);
  EXPECT_DOUBLE_EQ(c.window.begin, 30);
  EXPECT_DOUBLE_EQ(c.window.end, 40);
  EXPECT_DOUBLE_EQ(measure(c, "bed_height_m").dem->mean, 0.06);
}

TEST(Compare, ABedThatStillRisesIsToldAndTheWindowShortened) {
  Measured rising = at_rest(0.03, 0.06);
  for (std::size_t n = 0; n < 1001; ++n) rising.history.values[1][n] = 0.05 + 1e-5 * double(n);
  const Comparison c = compare(rising, at_rest(0.03, 0.06));
  EXPECT_TRUE(c.window.shortened);
  EXPECT_NEAR(c.window.begin, 87.5, 0.1);  // at most half of the window is dropped
  EXPECT_THAT(c.warnings, ::testing::Contains(HasSubstr("tfm: not steady: drift of bed_height 0.1 mm/s")));
  EXPECT_THAT(c.warnings, ::testing::Contains(HasSubstr("tfm: window too short for bed_height_m")));
}

TEST(Compare, WhatARunDoesNotHaveStaysEmpty) {
  Measured few = at_rest(0.03, 0.06);
  few.profiles.time.assign(few.profiles.time.size(), 0.0);  // none in the window
  few.history.values[3].assign(1001, 0.0);                  // no buoyant weight
  const Comparison c = compare(few, at_rest(0.03, 0.06));
  EXPECT_FALSE(score(c, "D1").value);
  EXPECT_FALSE(score(c, "D1").reached());
  EXPECT_FALSE(measure(c, "interface_m").tfm);
  EXPECT_FALSE(measure(c, "pressure_drop_over_weight").difference());
  EXPECT_THAT(c.warnings, ::testing::Contains(HasSubstr("output.every")));
}

TEST(Compare, RefusesWhatCannotBeCompared) {
  const Measured run = at_rest(0.03, 0.06);
  Measured other = run;
  other.history.columns[4] = "centre_sand_m";
  EXPECT_THROW((void)compare(run, other), core::FileError);
  other = run;
  other.profiles.height.pop_back();
  EXPECT_THROW((void)compare(run, other), core::FileError);
  other = run;
  for (double& t : other.history.values[0]) t += 1000;
  EXPECT_THROW((void)compare(run, other), core::FileError);
  for (auto& column : other.history.values) column.clear();
  EXPECT_THROW((void)compare(run, other), core::FileError);
}

TEST(Compare, KeysThatDiffer) {
  const std::vector<core::Role> roles{{"drag", "tfm, dem", "", "", "", {}},
                                      {"solids_stress", "tfm", "", "", "", {}},
                                      {"contact", "dem", "", "", "", {}}};
  const std::string first =
      "title = \"a\"\n\n[column]\ncells = [3, 18]\n\n[[species]]\nname = \"fine\"\ndensity = 1.0\n\n[[species]]\n"
      "name = \"coarse\"\ndensity = 2.0\n\n[effects]\ndrag = \"cello\"\nsolids_stress = \"none\"\n\n[run]\nuntil = "
      "1.0\n"
      "\n[tfm]\nrtol = 0.1\n";
  const std::string second =
      "title = \"b\"\n\n[column]\ncells = [6, 18]\ndepth = 0.1\n\n[[species]]\nname = \"fine\"\ndensity = 1.0\n\n"
      "[[species]]\nname = \"coarse\"\ndensity = 3.0\n\n[effects]\ncontact = \"linear\"\ndrag = \"fand\"\n\n[run]\n"
      "until = 2.0\n\n[tfm]\nrtol = 0.2\n\n[dem]\nfriction = 0.1\n\n[output]\nevery = 1.0\n";
  std::vector<std::string> keys;
  for (const Difference& d : case_differences(first, second, roles))
    keys.push_back(d.key + ": " + d.first + ", " + d.second);
  EXPECT_THAT(keys, ElementsAre("column.cells: [3, 18], [6, 18]", "column.depth: -, 0.1",
                                "effects.drag: \"cello\", \"fand\"", "species.2.density: 2.0, 3.0"));
  EXPECT_TRUE(case_differences(first, first, roles).empty());
}

TEST(Compare, TheFileHasTheContractsForm) {
  const std::string record =
      R"({"work": {"steps": 3}, "cpu_s": 1.5, "time_s": 100, "ranks": 1, "state": "done", "case_hash": "1", "git_commit": "2"})";
  const ComparedRun run{"here", core::parse_json(record)};
  const Comparison c = compare(at_rest(0.03, 0.066), at_rest(0.03, 0.06));
  const core::JsonValue json = core::parse_json(comparison_json(c, run, run, {"case.toml", {"bed.seed=2"}, "out"}));
  const core::JsonValue& height = json.of("measures").of("bed_height_m");
  EXPECT_EQ(height.of("tfm").number(), c.measures[0].tfm->mean);
  EXPECT_EQ(height.of("tfm_error").number(), *c.measures[0].tfm->error);
  EXPECT_EQ(height.of("difference").number(), *c.measures[0].difference());
  EXPECT_FALSE(json.of("scores").of("e_H").of("reached").truth());
  EXPECT_EQ(json.of("scores").of("order").of("tfm").of("species").text(), "coarse");
  EXPECT_EQ(json.of("models").of("dem").of("work").of("steps").number(), 3);
  EXPECT_EQ(json.of("models").of("dem").of("cpu_s").number(), 1.5);
  EXPECT_TRUE(json.of("models").of("dem").of("wall_s").is_null());  // of a record of before it was kept
  EXPECT_EQ(json.of("overrides").array().at(0).text(), "bed.seed=2");
  EXPECT_THAT(comparison_table(c, run, run), HasSubstr("goal 0.05: missed"));
}

TEST(Compare, NearAnInversionTheLayersHaveMoreRoom) {
  const FoundInversion found{"scan/inversion.json", {0.03, 0.01, 0.05}, 0.0309, 0.030};
  // 5 % of 30.9 mm/s and of 30.0 mm/s reach from 28.5 to 32.4 mm/s
  for (const auto& [velocity, goal] : {std::pair(0.0284, 0.05), {0.0286, 0.1}, {0.0324, 0.1}, {0.0326, 0.05}}) {
    Comparison comparison = compare(at_rest(0.04, 0.08), at_rest(0.04, 0.08));
    take_up(comparison, found, velocity);
    EXPECT_EQ(score(comparison, "D1").goal, goal) << velocity;
    EXPECT_EQ(score(comparison, "u_inv").value, 0.03);
    EXPECT_EQ(score(comparison, "u_inv").reached(), true);
    EXPECT_EQ(comparison.inversion_file, "scan/inversion.json");
  }
}

}  // namespace
}  // namespace polybed::multiscale
