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

Value named(const std::string& column, const Bed& bed, const std::vector<std::string>& names) {
  for (const Single<Bed>& measure : singles(bed_table(), names))
    if (measure.column() == column) return measure.of(bed);
  return std::nullopt;
}

TEST(BedTable, HistoryHasTheseColumnsInThisOrder) {
  EXPECT_THAT(columns_of(read_by(&Readers::history, bed_table())),
              ElementsAre("time_s", "dt_s", "bed_height_m", "dense_height_m", "pressure_drop_Pa", "buoyant_weight_Pa",
                          "centre_fine_m", "mass_fine_kg", "top_fine_m", "centre_coarse_m", "mass_coarse_kg",
                          "top_coarse_m", "interface_m", "mixing"));
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
  const auto measured = [&](const std::string& column) { return named(column, bed, species); };
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
  EXPECT_EQ(row[4], 48);
  EXPECT_EQ(row[6], 0.12);
  EXPECT_EQ(row[9], std::nullopt);
}

/// 1 in 3 of the solids is silt that is suspended in all ten slabs of 0.1 m, over sand of 0.5 in two of them. The bed's
/// height is that of the silt: z_0.80 lies in it. Half of the mean of the lower half, (0.5 + 0.05)/2, is between sand
/// and silt at 0.15 + 0.1 0.275/0.5.
TEST(BedTable, SandUnderSuspendedSiltHasAHeightOfItsOwn) {
  const Bed bed{.profile = {0.1, {{0.5, 0.5, 0, 0, 0, 0, 0, 0, 0, 0}, std::vector<double>(10, 0.05)}, {}}};
  const std::vector<std::string> names{"sand", "silt"};
  EXPECT_NEAR(*named("bed_height_m", bed, names), 1.0, 1e-14);
  EXPECT_NEAR(*named("dense_height_m", bed, names), 0.205, 1e-14);
  EXPECT_NEAR(*named("top_sand_m", bed, names), 0.2, 1e-14);
  EXPECT_NEAR(*named("top_silt_m", bed, names), 1.0, 1e-14);
}

TEST(BedTable, SizeClassesAreMeasuredAsOneSpeciesToo) {
  const std::vector<std::string> names{"fines", "sand.1", "sand.2", "d0.5", "d0.8"};
  std::vector<std::string> kinds, classes;
  for (const Kind& kind : kinds_of(names)) (kind.is_class ? classes : kinds).push_back(kind.name);
  EXPECT_THAT(kinds, ElementsAre("fines", "d0.5", "d0.8", "sand"));
  EXPECT_THAT(classes, ElementsAre("sand.1", "sand.2"));
  // 0.1 of class 1 in the lowest slab, 0.3 of class 2 in the next: centre (0.1 0.05 + 0.3 0.15)/0.4, half of their mean
  // above z_0.80, 0.3, at 0.15 + 0.1 0.15/0.3
  Bed bed{.profile = {0.1, {{0, 0, 0}, {0.1, 0, 0}, {0, 0.3, 0}, {0, 0, 0}, {0, 0, 0}}, {}}};
  bed.mass = {0, 1, 3, 0, 0};
  EXPECT_NEAR(*named("centre_sand_m", bed, names), 0.125, 1e-15);
  EXPECT_NEAR(*named("top_sand_m", bed, names), 0.2, 1e-15);
  EXPECT_EQ(*named("mass_sand_kg", bed, names), 4);
  bed.centre = {{}, 0.04, 0.16, {}, {}};  // as a run of particles knows them
  EXPECT_NEAR(*named("centre_sand_m", bed, names), (0.04 + 3 * 0.16) / 4, 1e-15);
}

// Both classes of sand below resin, sorted by size: the sand is one layer up to 0.2 m, the resin another.
TEST(BedTable, SizeClassesAreOneSpeciesInWhatIsMeasuredBetweenSpecies) {
  const std::vector<std::string> names{"sand.1", "sand.2", "resin"};
  const Bed bed{.profile = {0.1, {{0, 0.4, 0, 0}, {0.4, 0, 0, 0}, {0, 0, 0.5, 0.5}}, {}}};
  EXPECT_NEAR(*named("mixing", bed, names), 0, 1e-14);
  EXPECT_NEAR(*named("interface_m", bed, names), 0.2, 1e-14);
  EXPECT_NEAR(*named("centre_difference", bed, names), (0.3 - 0.1) / 0.4, 1e-14);
  const Bed alone{.profile = {0.1, {{0, 0.4}, {0.4, 0}}, {}}};
  EXPECT_FALSE(named("mixing", alone, {"sand.1", "sand.2"}));
  EXPECT_FALSE(named("interface_m", alone, {"sand.1", "sand.2"}));
}

TEST(BedTable, ASpeciesIsAClassOnlyOfWhatIsNoSpeciesItself) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"sand", "sand.1", "sand.2"}, {"sand.1"}, {"sand.2", "sand.3"}, {"sand", "sand.1"}}) {
    std::vector<std::string> found;
    for (const Kind& kind : kinds_of(names)) {
      found.push_back(kind.name);
      EXPECT_FALSE(kind.is_class) << kind.name;
    }
    EXPECT_EQ(found, names);
  }
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
