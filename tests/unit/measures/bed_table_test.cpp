#include "measures/bed_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "core/output/history.hpp"
#include "measures/bed.hpp"
#include "scenes/scratch.hpp"

namespace polybed::measures {
namespace {

using testing::ElementsAre;

const std::vector<std::string> species{"fine", "coarse"};

/// A lower layer of "fine" and an upper one of "coarse", two slabs of 0.1 m each, under a fifth that is empty.
Bed two_layers() {
  Bed bed{.profile = {0.1, {{0.5, 0.5, 0, 0, 0}, {0, 0, 0.4, 0.4, 0}}, {45, 35, 25, 15, 5}}, .time = 2, .step = 0.5};
  bed.buoyant_weight = 40;
  bed.mass = {3, 4};
  return bed;
}

template <class Source>
std::vector<std::string> columns_of(const Table<Source>& table) {
  std::vector<std::string> found;
  for (const Single<Source>& measure : singles(table, species)) found.push_back(measure.column());
  return found;
}

TEST(BedTable, HistoryHasTheseColumnsInThisOrder) {
  EXPECT_THAT(columns_of(read_by(&Readers::history, bed_table())),
              ElementsAre("time_s", "dt_s", "bed_height_m", "pressure_drop_Pa", "buoyant_weight_Pa", "centre_fine_m",
                          "mass_fine_kg", "centre_coarse_m", "mass_coarse_kg", "interface_m", "mixing"));
}

TEST(BedTable, TheDriftIsToldOfHeightsTheBedsFirst) {
  EXPECT_THAT(columns_of(read_by(&Readers::drift, bed_table())),
              ElementsAre("bed_height_m", "centre_fine_m", "centre_coarse_m"));
}

TEST(BedTable, EveryRowHasANameThatAColumnCanHaveAUnitAndADefinition) {
  std::set<std::string> columns;
  for (const Measure<Bed>& row : bed_table()) {
    EXPECT_FALSE(row.name.empty() || row.unit.empty() || row.help.empty()) << row.name;
    EXPECT_TRUE(std::all_of(row.name.begin(), row.name.end(), [](char c) {
      return c == '_' || std::islower(static_cast<unsigned char>(c)) != 0;
    })) << row.name;
    EXPECT_TRUE(columns.insert(row.name).second) << row.name << " stands twice";
    EXPECT_TRUE(!(row.readers.drift || row.readers.picture) || row.unit == "m") << row.name;
  }
}

TEST(BedTable, OfTwoLayersByHand) {
  const Bed bed = two_layers();
  const auto measured = [&](const std::string& column) -> Value {
    for (const Single<Bed>& measure : singles(bed_table(), species))
      if (measure.column() == column) return measure.of(bed);
    return std::nullopt;
  };
  EXPECT_EQ(measured("time_s"), 2);
  EXPECT_EQ(measured("dt_s"), 0.5);
  EXPECT_EQ(measured("mass_coarse_kg"), 4);
  EXPECT_EQ(measured("buoyant_weight_Pa"), 40);
  EXPECT_NEAR(*measured("centre_fine_m"), 0.1, 1e-15);
  EXPECT_NEAR(*measured("centre_coarse_m"), 0.3, 1e-15);
  EXPECT_NEAR(*measured("bed_height_m"), 0.4, 1e-15);
  EXPECT_NEAR(*measured("centre_difference"), 0.5, 1e-14);  // (0.3 - 0.1)/0.4
  EXPECT_NEAR(*measured("pressure_drop_Pa"), 50, 1e-12);
}

TEST(BedTable, WhatAModelKnowsBetterStandsInPlaceOfTheProfiles) {
  Bed bed = two_layers();
  bed.pressure_drop = 48;
  bed.centre = {0.12, std::nullopt};
  const std::vector<Value> row = values(singles(read_by(&Readers::history, bed_table()), species), bed);
  EXPECT_EQ(row[3], 48);
  EXPECT_EQ(row[5], 0.12);
  EXPECT_EQ(row[7], std::nullopt);
}

TEST(BedTable, AProfileWithoutPressureHasNoDropAndOneSpeciesNoDifference) {
  Bed bed = two_layers();
  bed.profile.pressure.clear();
  bed.profile.fraction.pop_back();
  for (const Single<Bed>& measure : singles(bed_table(), {"fine"}))
    if (measure.name == "pressure_drop" || measure.name == "centre_difference") {
      EXPECT_FALSE(measure.of(bed)) << measure.name;
    }
}

TEST(DistanceTable, OfTwoBedsByHand) {
  const Bed bed = two_layers();
  Profile turned = bed.profile;
  std::swap(turned.fraction[0], turned.fraction[1]);
  const auto found = values(singles(distance_table(), species), {bed.profile, turned});
  EXPECT_NEAR(*found[0], (49 + 5.0 / 9) / 50, 1e-12);  // slice 28 of 50 is 7/9 of the lower species in either bed
  EXPECT_NEAR(*found[1], 0.5 * (1.8 / 0.8 + 1.8 / 1), 1e-14);
  turned.fraction[0].assign(5, 0.0);                                // a species that the reference lacks does not count
  EXPECT_NEAR(*profile_distance(bed.profile, turned), 1.8, 1e-14);  // (0.5 + 0.5 + 0.4 + 0.4)/(0.5 + 0.5)
}

/// What one model alone knows.
struct Own {
  double noise = 0;
};

/// A measure that is new: one row. It is in the history, in what is asked of profiles, and its drift is told.
TEST(BedTable, ARowIsAllThatANewMeasureTakes) {
  Table<Bed> table = bed_table();
  table.push_back({"top_slab",
                   "m",
                   "centre of the highest slab with solids",
                   [](const Bed& bed) {
                     Value top;
                     for (std::size_t k = 0; k < bed.profile.slabs(); ++k)
                       if (bed.profile.solids_fraction(k) > 0) top = bed.profile.centre(k);
                     return top;
                   },
                   {.profile = true, .drift = true}});
  const History<Own> history(table, {{"noise", "Pa", "of the bed", [](const Own& own) { return own.noise; }}}, species);
  const scenes::Scratch scratch;
  core::HistoryWriter writer(scratch.path(), history.columns());
  writer.write_row(history.row(two_layers(), {7}));
  const core::History read = core::read_history(scratch.path());
  EXPECT_EQ(read.of("top_slab_m").at(0), 0.1 * 3.5);
  EXPECT_EQ(read.columns.back(), "noise_Pa");
  EXPECT_EQ(read.values.back().at(0), 7);
  EXPECT_THAT(columns_of(read_by(&Readers::profile, table)), testing::Contains("top_slab_m"));
  EXPECT_THAT(columns_of(read_by(&Readers::drift, table)), testing::Contains("top_slab_m"));
}

}  // namespace
}  // namespace polybed::measures
