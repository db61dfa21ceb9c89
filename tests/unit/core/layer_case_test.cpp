// [[layer]]: what of the bed follows from it, where the layers lie, and what is refused with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/case/file.hpp"
#include "core/case/layers.hpp"

namespace polybed::core {
namespace {

using testing::HasSubstr;

/// A case of two species; the bed starts in line 17. \param of_sand  the diameter of the first
std::string bed_of(const std::string& bed, const std::string& of_sand = "diameter = \"0.8 mm\"") {
  return R"([column]
size = ["60 mm", "200 mm"]
cells = [6, 20]
closed = true
[fluid]
density = 1000
viscosity = 1e-3
[[species]]
name = "sand"
density = 2650
)" + of_sand +
         R"(
[[species]]
name = "anthracite"
diameter = "1.6 mm"
density = 1450
[run]
until = "1 s"
)" + bed;
}

/// 20 mm of sand at 0.6, and on its left half 30 mm of three parts of anthracite to one of sand at 0.5.
const std::string two_layers = R"([bed]
solids_fraction = 0.6
[[layer]]
species = "sand"
height = "20 mm"
[[layer]]
volume_share = [0.25, 0.75]
height = "30 mm"
solids_fraction = 0.5
from = [0]
to = ["30 mm"]
)";

Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_case(text, "case.toml", overrides, {});
}

std::string message_of_bed(const std::string& bed) {
  try {
    (void)read(bed_of(bed));
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

// Sand fills 20 mm at 0.6 and its part of half of 30 mm at 0.5: (12 + 1.875)/(20 + 3.75); all 19.5 mm of 35.
TEST(Layer, EachSpeciesSettlesAsInItsLayers) {
  const SettledFractions settled = settled_fractions(read(bed_of(two_layers)));
  EXPECT_DOUBLE_EQ(settled.of_species[0], 13.875 / 23.75);
  EXPECT_DOUBLE_EQ(settled.of_species[1], 0.5);
  EXPECT_DOUBLE_EQ(settled.of_bed, 19.5 / 35);
}

TEST(Layer, SomeLayersAreABed) {
  std::string layers = two_layers.substr(two_layers.find("[[layer]]"));
  layers.insert(layers.find("height"), "solids_fraction = 0.6\n");
  EXPECT_EQ(read(bed_of(layers)).bed.static_height, read(bed_of(two_layers)).bed.static_height);
  EXPECT_THAT(message_of_bed(""), HasSubstr("[bed] is missing: what lies in the column at the start"));
}

// Over the cross-section: 12 mm of sand below, 7.5 mm of solids above, a quarter of them sand.
TEST(Layers, AmountAndSharesOfTheBedFollow) {
  const Scene scene = read(bed_of(two_layers));
  EXPECT_EQ(scene.bed.start.kind, StartKind::layered);
  EXPECT_EQ(scene.bed.solids_fraction, 0.6);
  EXPECT_NEAR(scene.bed.static_height, 0.0195 / 0.6, 1e-16);
  ASSERT_EQ(scene.bed.volume_share.size(), 2U);
  EXPECT_NEAR(scene.bed.volume_share[0], (0.012 + 0.25 * 0.0075) / 0.0195, 1e-15);
  EXPECT_NEAR(scene.bed.volume_share[1], 0.75 * 0.0075 / 0.0195, 1e-15);
  EXPECT_THAT(scene.layers[0].volume_share, testing::ElementsAre(1, 0));
}

TEST(Layers, WithoutASolidsFractionOfTheBedItIsThatOfTheDensest) {
  const Scene scene =
      read(bed_of("[bed]\n[[layer]]\nspecies = \"sand\"\nheight = 0.02\nsolids_fraction = 0.55\n"
                  "[[layer]]\nspecies = \"sand\"\nheight = 0.01\nsolids_fraction = 0.5\n"));
  EXPECT_EQ(scene.bed.solids_fraction, 0.55);
  EXPECT_NEAR(scene.bed.static_height, (0.02 * 0.55 + 0.01 * 0.5) / 0.55, 1e-16);
}

TEST(Layers, TheResolvedCaseReadsBackToItself) {
  for (const std::string& bed :
       std::vector<std::string>{two_layers,
                                "[bed]\n[[layer]]\nspecies = \"anthracite\"\nheight = \"33.3 mm\"\n"
                                "solids_fraction = 0.51\n[[layer]]\nspecies = \"sand\"\nheight = "
                                "\"7 mm\"\nsolids_fraction = 0.57\nfrom = [0.011]\nto = [0.047]\n"}) {
    const std::string resolved = resolved_case(read(bed_of(bed)));
    EXPECT_EQ(resolved_case(read(resolved)), resolved);
  }
}

TEST(Layers, SizeClassesOfASpeciesAreMixedInItsLayers) {
  const ClassRule classes = [](const SizeDistribution& given) {
    return std::vector<std::pair<double, double>>{{*given.median / 2, 0.25}, {*given.median * 2, 0.75}};
  };
  const std::string text = bed_of(two_layers, "distribution = \"lognormal\"\nmedian = \"0.8 mm\"\ndeviation = 0.3");
  const Scene scene = parse_case(text, "case.toml", {}, {}, classes);
  ASSERT_EQ(scene.species.size(), 3U);
  EXPECT_THAT(scene.layers[0].volume_share, testing::ElementsAre(0.25, 0.75, 0));
  EXPECT_THAT(scene.layers[1].volume_share, testing::ElementsAre(0.25 * 0.25, 0.25 * 0.75, 0.75));
  EXPECT_THAT(scene.bed.layer, testing::IsEmpty());
  const std::string resolved = resolved_case(scene);
  EXPECT_EQ(resolved_case(read(resolved)), resolved);
}

TEST(Layers, LieOnWhatIsBelowThem) {
  const Scene scene = read(bed_of(R"([bed]
solids_fraction = 0.6
[[layer]]
species = "sand"
height = "20 mm"
from = [0]
to = ["20 mm"]
[[layer]]
species = "anthracite"
height = "40 mm"
from = ["40 mm"]
to = ["60 mm"]
[[layer]]
species = "anthracite"
height = "10 mm"
from = ["5 mm"]
to = ["15 mm"]
)"));
  const std::vector<BedPart> parts = start_parts(scene);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_NEAR(parts[1].area(), 1.0 / 3, 1e-15);
  EXPECT_NEAR(parts[1].solids[1], 0.6 * 0.04, 1e-16);
  const std::vector<Extent> extents = stacked(parts, scene.column);
  EXPECT_EQ(extents[0].low, 0);
  EXPECT_EQ(extents[1].low, 0);
  EXPECT_NEAR(extents[1].high, 0.04, 1e-16);
  EXPECT_EQ(extents[2].low, extents[0].high);
  EXPECT_NEAR(top_of(extents), 0.04, 1e-16);
}

// 0.1 + 0.2 is not 0.3.
TEST(Layers, ThatTouchUpToRoundOffLieSideBySide) {
  std::vector<BedPart> parts(2);
  parts[0].to[0] = 0.1 + 0.2;
  parts[1].from[0] = 0.3;
  EXPECT_EQ(stacked(parts, {0.02, 0.03})[1].low, 0);
}

// The mass of a layer is that of the settled one; none starts denser than it settles.
TEST(Layers, ALooserStartIsHigher) {
  const Scene scene = read(bed_of(two_layers), {"bed.start_solids_fraction=0.55"});
  const std::vector<BedPart> parts = start_parts(scene);
  EXPECT_EQ(parts[0].solids_fraction, 0.55);
  EXPECT_EQ(parts[1].solids_fraction, 0.5);
  const std::vector<Extent> extents = stacked(parts, scene.column);
  EXPECT_NEAR(extents[0].high, 0.02 * 0.6 / 0.55, 1e-16);
  EXPECT_NEAR(extents[1].high, 0.02 * 0.6 / 0.55 + 0.03, 1e-16);
}

TEST(Layers, ABedWithoutThemIsOnePartOrOneForEachNumber) {
  Scene scene = read(bed_of("[bed]\nvolume_share = [0.4, 0.6]\nstatic_height = 0.05\nsolids_fraction = 0.6\n"));
  ASSERT_EQ(start_parts(scene).size(), 1U);
  EXPECT_NEAR(start_parts(scene)[0].solids[1], 0.6 * 0.05 * 0.6, 1e-16);
  scene.bed.start.kind = StartKind::layered;
  ASSERT_EQ(start_parts(scene).size(), 2U);
  EXPECT_EQ(start_parts(scene)[0].solids[1], 0);
  scene.bed.layer = {2, 1};
  EXPECT_EQ(start_parts(scene)[0].solids[0], 0);
}

TEST(Layers, OverridesAreByNumber) {
  EXPECT_EQ(read(bed_of(two_layers), {"layer.1.height=\"10 mm\""}).layers[1].height, 0.01);
}

TEST(Layers, WhatIsWrongIsToldWithPlaceAndSuggestion) {
  const std::string head = "[bed]\nsolids_fraction = 0.6\n", sand = "[[layer]]\nspecies = \"sand\"\nheight = 0.02\n";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {head + "[[layer]]\nspecies = \"snad\"\nheight = 0.02\n",
       "case.toml:21:11: layer.species = \"snad\": no such species; did you mean 'sand'?"},
      {head + "[[layer]]\nspecies = \"x\"\nheight = 0.02\n", "no such species; there are sand, anthracite"},
      {head + sand + "[[layer]]\nheight = 0.02\n",
       "case.toml:23:1: [[layer]] number 2 has neither of layer.species and layer.volume_share"},
      {head + sand + "volume_share = [1, 0]\n", "[[layer]] number 1 has both of layer.species and layer.volume_share"},
      {head + "[[layer]]\nvolume_share = [1]\nheight = 0.02\n",
       "case.toml:21:16: layer.volume_share has 1 numbers, there are 2 species"},
      {head + "[[layer]]\nvolume_share = [0.5, 0.4]\nheight = 0.02\n", "layer.volume_share sums to 0.9, not to 1"},
      {head + "[[layer]]\nspecies = \"sand\"\n", "case.toml:20:1: layer.height is missing: of the settled layer"},
      {head + "[[layer]]\nspecies = \"sand\"\nheight = \"20 s\"\n", "expected a value in m, this one is in s"},
      {head + "[[layer]]\nspecies = \"sand\"\nhight = 0.02\n",
       "unknown key 'hight' in [[layer]]; did you mean 'height'?"},
      {head + sand + "solids_fraction = 1.2\n", "case.toml:23:19: layer.solids_fraction = 1.2 is out of range"},
      {head + sand + "from = [0.01]\n", "layer.from and layer.to have 1 and 0 numbers: 1 here"},
      {head + sand + "from = [0.03]\nto = [0.02]\n",
       "a layer from 0.03 to 0.02 m ends before it starts: \"from\" must be below \"to\""},
      {head + sand + "from = [0.03]\nto = [0.07]\n",
       "a layer from 0.03 to 0.07 m does not lie in the column, 0 to 0.06 m"},
      {head + sand + "from = [0]\nto = [0.02]\n" + sand,
       "[[layer]] number 2 does not lie level: only 33.3 % of it lies on layers up to 0.02 m high"},
      {head + "[[layer]]\nspecies = \"sand\"\nheight = 0.3\n", "the bed at its start is 0.3 m high, the column 0.2 m"},
      {head + "start = \"settled\"\n" + sand,
       "case.toml:20:9: bed.start = \"settled\" and [[layer]] both say where the bed starts: leave bed.start out"},
      {head + "layer = [1, 2]\n" + sand, "bed.layer and [[layer]] both say what the layers are"},
      {head + "particles = [1, 2]\n" + sand, "bed.particles and [[layer]] both say how much there is"},
      {head + "static_height = 0.03\n" + sand,
       "case.toml:20:17: bed.static_height differs from the amount in [[layer]]"},
      {head + "volume_share = [0.5, 0.5]\n" + sand, "bed.volume_share differs from the shares in [[layer]]"},
      {"[bed]\nstart = \"layered\"\n" + sand, "bed.solids_fraction is missing"}};
  for (const auto& [bed, message] : wrong) EXPECT_THAT(message_of_bed(bed), HasSubstr(message));
}

TEST(Layers, AllThatIsWrongIsToldAtOnceAndOnce) {
  const std::string message = message_of_bed(R"([bed]
solids_fraction = 0.6
[[layer]]
species = "snad"
height = "20 mm"
[[layer]]
volume_share = [0.5, 0.4]
height = "-1 mm"
[[layer]]
height = "20 mm"
from = [0.01]
)");
  for (const char* part : {"case.toml:21:11: layer.species", "case.toml:24:16: layer.volume_share sums to",
                           "case.toml:25:10: layer.height", "layer.from and layer.to have", "number 3 has neither"})
    EXPECT_THAT(message, HasSubstr(part));
  EXPECT_THAT(message, Not(HasSubstr("bed.volume_share")));
  EXPECT_THAT(message, Not(HasSubstr("bed.static_height")));
  EXPECT_THAT(message_of_bed("[bed]\nsolids_fraction = 0.6\n[layer]\nheight = 1\n"),
              HasSubstr("layer is an array of tables: write [[layer]]"));
}

}  // namespace
}  // namespace polybed::core
