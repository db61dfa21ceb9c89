// Roles of [effects] that a case does not name: off, or left to the chooser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/case/file.hpp"

namespace polybed::core {
namespace {

const std::vector<Role> menu{{"drag", "tfm", "Exchange", "", "", {{"cello", ""}}},
                             {"solids_stress", "tfm", "Stress", "", "", {{"frictional", ""}}},
                             {"contact", "dem", "Pair", "", "", {{"hertz_mindlin", ""}}}};

const std::string named = R"(title = "bed"
column = { size = ["60 mm", "600 mm"], cells = [12, 120] }
fluid = { name = "water", temperature = "15 degC" }
bed = { volume_share = [1.0], static_height = "60 mm", solids_fraction = 0.6 }
inlet = { superficial_velocity = "30 mm/s" }
run = { until = "2 s" }
[[species]]
name = "fine"
diameter = "0.8 mm"
density = "1395 kg/m3"
)";

using Effects = std::map<std::string, std::string>;

Effects effects_of(const std::string& text, OtherRoles others, const std::vector<std::string>& set = {}) {
  return parse_case(text, "case.toml", set, menu, {}, {}, others).effects;
}

const std::string with_drag = named + "[effects]\ndrag = \"cello\"\n";

TEST(OtherRoles, AreOffOrLeftToTheChooser) {
  EXPECT_EQ(effects_of(with_drag, OtherRoles::off), (Effects{{"drag", "cello"}}));
  const Effects chosen{{"drag", "cello"}, {"solids_stress", "auto"}, {"contact", "auto"}};
  EXPECT_EQ(effects_of(with_drag, OtherRoles::chosen), chosen);
  EXPECT_EQ(effects_of(named, OtherRoles::chosen).at("drag"), automatic);  // without [effects] none is named
}

TEST(OtherRoles, WhatTheCaseSaysGoesBefore) {
  EXPECT_FALSE(effects_of(with_drag, OtherRoles::chosen, {"effects.contact=none"}).contains("contact"));
  EXPECT_EQ(effects_of(with_drag, OtherRoles::chosen, {"effects.others=none"}).size(), 1u);
  EXPECT_EQ(effects_of(with_drag, OtherRoles::off, {"effects.others=auto"}).size(), 3u);
  try {
    effects_of(with_drag, OtherRoles::chosen, {"effects.others=some"});
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("allowed are auto | none"));
  }
}

TEST(OtherRoles, AResolvedCaseHasDecidedThem) {
  const std::string resolved = resolved_case(parse_case(with_drag, "case.toml", {}, menu));
  EXPECT_EQ(effects_of(resolved, OtherRoles::chosen), (Effects{{"drag", "cello"}}));
}

}  // namespace
}  // namespace polybed::core
