#include "core/case/file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "core/case/keys.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::core {
namespace {

using testing::HasSubstr;

const std::vector<Role> roles{
    {"drag", "tfm", "Exchange", "", "", {{"cello", ""}, {"vbk", ""}}},
    {"solids_stress", "tfm", "Stress", "", "", {{"frictional", ""}}},
    {"species_exchange", "tfm", "Exchange", "", "", {{"syamlal", ""}}},
    {"contact", "dem", "Pair", "", "", {{"hertz_mindlin", ""}}},
};

std::string shipped() {
  std::ifstream file(POLYBED_SOURCE_DIR "/cases/matsuura-akehata/case.toml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A whole case in 22 lines; the tests change one of them.
const std::string good = R"(title = "bed"
[column]
size = ["60 mm", "600 mm"]
cells = [12, 120]
[fluid]
name = "water"
temperature = "15 degC"
[[species]]
name = "fine"
diameter = "0.8 mm"
density = "1395 kg/m3"
[bed]
volume_share = [1.0]
static_height = "60 mm"
solids_fraction = 0.6
[inlet]
superficial_velocity = "30 mm/s"
[effects]
drag = "cello"
solids_stress = "frictional"
[run]
until = "2 s"
)";

std::string with(const std::string& line, const std::string& changed) {
  std::string text = good;
  const auto at = text.find(line);
  if (at == std::string::npos) throw std::logic_error("no line " + line);
  return text.replace(at, line.size(), changed);
}

std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)parse_case(text, "case.toml", overrides, roles);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(CaseFile, ReadsTheExample) {
  const Scene scene = parse_case(good, "case.toml", {}, roles);
  EXPECT_EQ(scene.column.size[0], 0.06);
  EXPECT_EQ(scene.column.cells[1], 120);
  EXPECT_EQ(scene.species.at(0).diameter, 0.8e-3);
  EXPECT_EQ(scene.fluid.temperature, 288.15);
  EXPECT_EQ(scene.inlet.superficial_velocity.at(0).second, 0.03);
  EXPECT_EQ(scene.effects.at("drag"), "cello");
}

struct Wrong {
  std::string line, changed, message;
  friend void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.message.substr(0, 40); }
};

class WrongCase : public testing::TestWithParam<Wrong> {};

TEST_P(WrongCase, IsToldWithPlaceRangeAndSuggestion) {
  const auto& [line, changed, message] = GetParam();
  EXPECT_THAT(message_of(with(line, changed)), HasSubstr(message));
}

INSTANTIATE_TEST_SUITE_P(
    CaseFile, WrongCase,
    testing::Values(
        Wrong{"diameter = \"0.8 mm\"", "diametre = \"0.8 mm\"",
              "case.toml:10:1: unknown key 'diametre' in [[species]]; did you mean 'diameter'?"},
        Wrong{"diameter = \"0.8 mm\"", "diametre = \"0.8 mm\"", "case.toml:8:1: species.diameter is missing"},
        Wrong{"diameter = \"0.8 mm\"", "diameter = \"-1 mm\"",
              "case.toml:10:12: species.diameter = '-1 mm' is out of range: at least 1e-08, at most 1 m"},
        Wrong{"diameter = \"0.8 mm\"", "diameter = 0.8",
              "case.toml:10:12: species.diameter = 0.8 m is larger than any particle here: did you mean "
              "\"0.8 mm\"?"},
        Wrong{"diameter = \"0.8 mm\"", "diameter = \"0.8 s\"",
              "case.toml:10:12: species.diameter = '0.8 s': expected a value in m, this one is in s"},
        Wrong{"diameter = \"0.8 mm\"", "diameter = \"0.8 millimetre\"",
              "expected a number with a unit such as \"1 m\""},
        Wrong{"diameter = \"0.8 mm\"", "diameter = nan", "case.toml:10:12: species.diameter = nan is out of range"},
        Wrong{"diameter = \"0.8 mm\"", "diameter = inf", "out of range"},
        Wrong{"diameter = \"0.8 mm\"", "diameter = -0.95", "species.diameter = -0.95 is out of range"},
        Wrong{"cells = [12, 120]", "cells = [12, 120.5]",
              "case.toml:4:14: column.cells = 120.5: expected a whole number"},
        Wrong{"cells = [12, 120]", "cells = [12]", "column.cells has 1 numbers, column.size 2"},
        Wrong{"cells = [12, 120]", "cells = [0, 120]", "case.toml:4:10: column.cells = 0 is out of range: at least 1"},
        Wrong{"drag = \"cello\"", "drag = \"celo\"",
              "case.toml:19:8: effects.drag = 'celo': allowed are none | auto | cello | vbk; did you mean \"cello\"?"},
        Wrong{"drag = \"cello\"", "darg = \"cello\"",
              "case.toml:19:1: unknown key 'darg' in [effects]; did you mean 'drag'?"},
        Wrong{"volume_share = [1.0]", "volume_share = [0.9]", "bed.volume_share sums to 0.9, not to 1"},
        Wrong{"volume_share = [1.0]", "volume_share = [0.5, 0.5]",
              "bed.volume_share has 2 numbers, there are 1 species"},
        Wrong{"static_height = \"60 mm\"", "", "bed.static_height is missing (or give bed.particles, or [[layer]])"},
        Wrong{"static_height = \"60 mm\"", "static_height = \"700 mm\"", "enlarge column.size"},
        Wrong{"static_height = \"60 mm\"", "static_height = \"60 mm\"\nparticles = [100]", "give one"},
        Wrong{"solids_fraction = 0.6", "solids_fraction = 0.6\nstart = \"mxed\"", "did you mean \"mixed\"?"},
        Wrong{"[[species]]", "[species]", "species is an array of tables: write [[species]]"},
        Wrong{"name = \"water\"", "name = \"water\"\nequation_of_state = \"ideal_gas\"",
              "water is a liquid; \"tait\" is the law of a compressible liquid"},
        Wrong{"name = \"water\"", "name = \"air\"\nequation_of_state = \"tait\"",
              "air is a gas; \"ideal_gas\" is its law"},
        Wrong{"name = \"water\"", "name = \"water\"\nequation_of_state = \"tate\"", "did you mean \"tait\"?"},
        Wrong{"name = \"water\"", "name = \"water\"\noutlet_pressure = 0", "outlet_pressure = 0 is out of range"},
        Wrong{"[column]", "[colum]", "unknown key 'colum'; did you mean 'column'?"},
        Wrong{"[run]\nuntil = \"2 s\"", "", "[run] is missing"},
        Wrong{"until = \"2 s\"", "until = \"2 s", "case.toml:22:"},
        Wrong{"superficial_velocity = \"30 mm/s\"", "superficial_velocity = [[0, 0.03], [-1, 0.04]]", "out of range"},
        Wrong{"superficial_velocity = \"30 mm/s\"", "superficial_velocity = [[2, 0.03], [1, 0.04]]",
              "times must not fall"},
        Wrong{"[effects]", "[[jet]]\nfrom = [0.01]\nto = [0.07]\nsuperficial_velocity = 0.1\n[effects]",
              "a jet from 0.01 to 0.07 m does not lie on the bottom, 0 to 0.06 m"},
        Wrong{"[effects]", "[[jet]]\nat = \"left\"\nfrom = [0.5]\nto = [0.7]\nsuperficial_velocity = 0.1\n[effects]",
              "case.toml:20:8: a jet from 0.5 to 0.7 m does not lie on the left side, 0 to 0.6 m"},
        Wrong{"[effects]", "[[jet]]\nfrom = [0.01, 0]\nto = [0.02]\nsuperficial_velocity = 0.1\n[effects]",
              "jet.from and jet.to have 2 and 1 numbers: 1 here"},
        Wrong{"[effects]",
              "[[jet]]\nfrom = [0.01]\nto = [0.03]\nsuperficial_velocity = 0.1\n"
              "[[jet]]\nfrom = [0.02]\nto = [0.04]\nsuperficial_velocity = 0.1\n[effects]",
              "two jets overlap: [[jet]] number 1 and 2"},
        Wrong{"superficial_velocity = \"30 mm/s\"", "",
              "superficial_velocity is missing (or give inlet.flow_rate, or set column.closed = true)"}));

/// The good case with another line for the diameter.
Wrong sizes(const std::string& lines, const std::string& message) { return {"diameter = \"0.8 mm\"", lines, message}; }

INSTANTIATE_TEST_SUITE_P(
    SizeDistribution, WrongCase,
    testing::Values(sizes("distribution = \"lognormal\"\nmedian = \"0.8 mm\"",
                          "case.toml:10:16: species.distribution = \"lognormal\" needs species.deviation"),
                    sizes("distribution = \"lognormal\"\ndeviation = 0.3",
                          "case.toml:10:16: species.distribution = \"lognormal\" needs either"),
                    sizes("distribution = \"lognormal\"\ndeviation = 3",
                          "case.toml:11:13: species.deviation = 3 is out of range: above 0, at most 1"),
                    sizes("distribution = \"lognormal\"\nmedian = 0.8\ndeviation = 0.3",
                          "case.toml:11:10: species.median = 0.8 m is larger"),
                    sizes("distribution = \"lognormel\"", "did you mean \"lognormal\"?"),
                    sizes("diameter = \"0.8 mm\"\ndistribution = \"sieves\"",
                          "case.toml:10:12: species.diameter and species.distribution both"),
                    sizes("diameter = \"0.8 mm\"\nclasses = 2",
                          "case.toml:11:11: species.classes says nothing without species.distribution"),
                    sizes("distribution = \"sieves\"",
                          "case.toml:10:16: species.distribution = \"sieves\" needs species.sieves"),
                    sizes("distribution = \"sieves\"\nsieves = 3",
                          "case.toml:11:10: species.sieves = 3: expected a table of pairs"),
                    sizes("distribution = \"sieves\"\nsieves = [[\"1 mm\", 0.4], [\"1 mm\", 0.6], [\"2 mm\", 0]]",
                          "case.toml:11:26: species.sieves: openings must rise"),
                    sizes("distribution = \"sieves\"\nsieves = [[\"1 mm\", 0.4], [\"2 mm\", 0.6]]",
                          "case.toml:11:10: species.sieves: at least two"),
                    sizes("distribution = \"sieves\"\nsieves = [[\"1 mm\", 0.4], [\"2 mm\", 0.5], [\"3 mm\", 0]]",
                          "the shares sum to 0.9, not to 1"),
                    sizes("distribution = \"sieves\"\nsieves = [[\"1 s\", 1], [\"2 mm\", 0]]",
                          "expected a value in m, this one is in s"),
                    sizes("distribution = \"lognormal\"\nmedian = \"1 mm\"\ndeviation = 0.3\nclasses = 11",
                          "case.toml:13:11: species.classes = 11 is out of range: at least 1, at most 10")));

/// The good case with a feed, or an outlet, added.
Wrong fed(const std::string& lines, const std::string& message) {
  return {"[effects]", lines + "\n[effects]", message};
}

INSTANTIATE_TEST_SUITE_P(
    Feed, WrongCase,
    testing::Values(
        fed("[[feed]]\nspecies = \"fine\"\nvelocity = 1", "case.toml:18:1: feed.superficial_velocity is missing"),
        fed("[[feed]]\nspecies = \"fin\"\nvelocity = 1\nsuperficial_velocity = 0.1",
            "feed.species = \"fin\": no such species"),
        fed("[[feed]]\nspecies = \"fine\"\nat = \"side\"\nvelocity = 1\nsuperficial_velocity = 0.1",
            "case.toml:20:6: feed.at = \"side\": allowed are bottom | top"),
        fed("[[feed]]\nspecies = \"fine\"\nvelocity = 1\nsuperficial_velocity = -0.1",
            "case.toml:21:24: feed.superficial_velocity = -0.1 is out of range: at least 0"),
        fed("[[feed]]\nspecies = \"fine\"\nvelocity = 0.1\nsuperficial_velocity = 0.1",
            "raise feed.velocity above 0.1667 m/s"),
        fed("[[feed]]\nspecies = \"fine\"\nvelocity = 1\nsuperficial_velocity = 0.1\nfrom = [0.02]",
            "feed.from and feed.to have 1 and 0 numbers: 1 here"),
        fed("[[feed]]\nspecies = \"fine\"\nvelocity = 1\nsuperficial_velocity = 0.1\n[[feed]]\nspecies = \"fine\"\n"
            "velocity = 1\nsuperficial_velocity = 0.1\nfrom = [0.02]\nto = [0.03]",
            "two feeds of fine overlap: [[feed]] number 1 and 2"),
        Wrong{"cells = [12, 120]", "cells = [12, 120]\noutlet = \"closed\"",
              "case.toml:5:10: column.outlet = \"closed\": allowed are screen | open"}));

INSTANTIATE_TEST_SUITE_P(
    Removed, WrongCase,
    testing::Values(Wrong{
        "[effects]", "[tfm]\nmomentum = \"upwind\"\n[effects]",
        "tfm.momentum = \"upwind\": allowed are auto | conservative | conservative_limited; (U.grad)U was "
        "removed, take \"conservative\", of the same order"}));

/// Two classes at half and twice the median: the reader does not know the rule.
std::vector<std::pair<double, double>> half_and_twice(const SizeDistribution& given) {
  return {{*given.median / 2, 0.25}, {*given.median * 2, 0.75}};
}

TEST(SizeDistribution, GivesWayToItsClasses) {
  std::string text =
      with("diameter = \"0.8 mm\"", "distribution = \"lognormal\"\nmedian = \"0.8 mm\"\ndeviation = 0.3");
  text.replace(text.find("[bed]"), 5, "[[species]]\nname = \"coarse\"\ndiameter = \"2 mm\"\ndensity = 1170\n[bed]");
  text.replace(text.find("volume_share = [1.0]"), 20, "volume_share = [0.4, 0.6]");
  text +=
      "[[contact_pair]]\nbetween = [\"fine\", \"wall\"]\nfriction = 0.1\n[[contact_pair]]\nbetween = [\"fine\", "
      "\"fine\"]\n";
  const Scene scene = parse_case(text, "case.toml", {}, roles, half_and_twice);
  ASSERT_EQ(scene.species.size(), 3U);
  EXPECT_EQ(scene.species[0].name, "fine.1");
  EXPECT_EQ(scene.species[1].name, "fine.2");
  EXPECT_EQ(scene.species[2].name, "coarse");
  EXPECT_EQ(scene.species[1].diameter, 1.6e-3);
  EXPECT_EQ(scene.species[1].density, 1395);
  EXPECT_THAT(scene.bed.volume_share, testing::ElementsAre(0.4 * 0.25, 0.4 * 0.75, 0.6));
  EXPECT_EQ(scene.contact_pairs.size(), 2U + 3U);
  EXPECT_EQ(scene.size_classes.at(0).species, "fine");
  const std::string resolved = resolved_case(scene);
  EXPECT_THAT(resolved, Not(HasSubstr("\ndistribution")));
  EXPECT_EQ(resolved_case(parse_case(resolved, "again.toml", {}, roles)), resolved);
  EXPECT_THAT(scene.bed.layer, testing::IsEmpty());
  const std::vector<std::string> layered{"bed.start=layered"};
  const Scene layers = parse_case(text, "case.toml", layered, roles, half_and_twice);
  EXPECT_THAT(layers.bed.layer, testing::ElementsAre(1, 1, 2));
  const std::string of_layers = resolved_case(layers);
  EXPECT_EQ(resolved_case(parse_case(of_layers, "again.toml", {}, roles)), of_layers);
  const std::vector<std::string> set{"species.fine.median=1 mm"};
  EXPECT_EQ(parse_case(text, "case.toml", set, roles, half_and_twice).species[0].diameter, 0.5e-3);
}

TEST(Feed, OfADistributionIsOneOfEachClass) {
  std::string text =
      with("diameter = \"0.8 mm\"", "distribution = \"lognormal\"\nmedian = \"0.8 mm\"\ndeviation = 0.3");
  text += "[[feed]]\nspecies = \"fine\"\nvelocity = 1\nsuperficial_velocity = [[0, 0], [1, 0.02]]\n";
  const Scene scene = parse_case(text, "case.toml", {}, roles, half_and_twice);
  ASSERT_EQ(scene.feeds.size(), 2U);
  EXPECT_EQ(scene.feeds[1].species, "fine.2");
  EXPECT_DOUBLE_EQ(scene.feeds[1].superficial_velocity.at(1).second, 0.75 * 0.02);
  const std::string resolved = resolved_case(scene);
  EXPECT_EQ(resolved_case(parse_case(resolved, "again.toml", {}, roles)), resolved);
}

TEST(SizeDistribution, WithoutARuleOrWithNumbersOfParticlesIsRefused) {
  const std::string text =
      with("diameter = \"0.8 mm\"", "distribution = \"lognormal\"\nmedian = \"0.8 mm\"\ndeviation = 0.3");
  EXPECT_THAT(message_of(text), HasSubstr("knows no classes"));
  std::string counted = text;
  counted.replace(counted.find("volume_share = [1.0]\nstatic_height = \"60 mm\""), 44, "particles = [100]");
  EXPECT_THAT([&] { (void)parse_case(counted, "case.toml", {}, roles, half_and_twice); },
              testing::ThrowsMessage<CaseError>(HasSubstr("bed.particles counts spheres of one size")));
}

TEST(CaseFile, TellsEverythingAtOnceInTheOrderOfTheFile) {
  std::string text = with("diameter = \"0.8 mm\"", "diametre = 1");
  text.replace(text.find("solids_fraction = 0.6"), 21, "solids_fraction = 1.6");
  text.replace(text.find("until = \"2 s\""), 13, "until = \"-2 s\"");
  const std::string message = message_of(text);
  const auto first = message.find("diametre"), second = message.find("solids_fraction = 1.6"),
             third = message.find("run.until");
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_NE(third, std::string::npos) << message;
}

TEST(CaseFile, OverridesTakeThePlaceOfTheFile) {
  const std::vector<std::string> set{"inlet.superficial_velocity=37 mm/s", "species.fine.diameter=\"1 mm\"",
                                     "column.cells=[6, 60]", "effects.drag=vbk"};
  const Scene scene = parse_case(good, "case.toml", set, roles);
  EXPECT_EQ(scene.inlet.superficial_velocity.at(0).second, 0.037);
  EXPECT_EQ(scene.species[0].diameter, 1e-3);
  EXPECT_EQ(scene.column.cells[0], 6);
  EXPECT_EQ(scene.effects.at("drag"), "vbk");
}

TEST(CaseFile, WrongOverridesAreToldByTheirKey) {
  EXPECT_THAT(message_of(good, {"tfm.rtoll=1"}), HasSubstr("--set tfm.rtoll: unknown key 'rtoll' in [tfm]"));
  EXPECT_THAT(message_of(good, {"species.coarse.diameter=1"}), HasSubstr("no 'coarse' in [[species]]"));
  EXPECT_THAT(message_of(good, {"nonsense"}), HasSubstr("expected KEY=VALUE"));
  EXPECT_THAT(message_of(good, {"run.until=\xff"}), HasSubstr("--set run.until: "));
}

TEST(CaseFile, TheResolvedCaseReadsBackToItself) {
  const Scene scene = parse_case(good, "case.toml", {}, roles);
  const std::string text = resolved_case(scene);
  EXPECT_EQ(resolved_case(parse_case(text, "again.toml", {}, roles)), text);
}

TEST(CaseFile, EveryChoiceIsWrittenAsItWasRead) {
  for (const Key& key : keys()) {
    Scene scene;
    if (const Table& table = *find_table(key.table); table.array) table.resize(scene, 1);
    if (key.kind != Kind::text && key.kind != Kind::word_or_number) continue;
    for (const std::string_view word : key.words) {
      const std::string text =
          word.ends_with("FILE") ? std::string(word.substr(0, word.size() - 4)) + "a.h5" : std::string(word);
      key.set(scene, 0, text);
      EXPECT_EQ(std::get<std::string>(key.get(scene, 0)), text) << key.path();
    }
  }
}

TEST(CaseFile, AMaximumPackingIsARuleOrANumber) {
  const auto packing = [](const std::string& given) {
    const Scene scene = parse_case(good, "case.toml", std::vector{"tfm.max_packing=" + given}, roles);
    EXPECT_THAT(resolved_case(scene), HasSubstr("\nmax_packing = " + given + "\n"));
    return scene.tfm.max_packing;
  };
  EXPECT_EQ(packing("0.61"), MaxPacking(0.61));
  EXPECT_EQ(packing("\"yu_standish\""), MaxPacking(PackingRule::yu_standish));
}

TEST(CaseFile, EveryKeyHasHelpAndAReadableDefault) {
  for (const Key& key : keys()) {
    EXPECT_FALSE(key.help.empty()) << key.path();
    if (key.standard.empty() || key.words.empty()) continue;
    EXPECT_TRUE(is_word(key, key.standard)) << key.path() << " = " << key.standard;
  }
}

TEST(CaseFile, AFileThatCannotBeReadSaysWhy) {
  const test::Scratch scratch;
  EXPECT_THROW((void)read_case(scratch.path() / "none.toml", {}, roles), FileError);
  EXPECT_THROW((void)read_case(scratch.path(), {}, roles), FileError);
}

/// One random change of a text: a byte, a line, a number, a cut.
std::string mutated(std::string text, std::mt19937& random) {
  const auto at = [&](std::size_t size) { return std::uniform_int_distribution<std::size_t>(0, size - 1)(random); };
  const auto any = [&] { return char(std::uniform_int_distribution<int>(0, 255)(random)); };
  static const std::vector<std::string> odd{
      "nan",  "-inf", "1e308",      "[]", "{}",   "''",  "-1",           "9223372036854775808",
      "[[[[", "\"\"", "1979-05-27", "0x", "true", "= =", "[[species]]\n"};
  for (int changes = 1 + int(at(3)); changes > 0 && !text.empty(); --changes) switch (at(5)) {
      case 0:
        text[at(text.size())] = any();
        break;
      case 1:
        text.insert(at(text.size()), 1, any());
        break;
      case 2:
        text.erase(at(text.size()), 1 + at(20));
        break;
      case 3:
        text.insert(at(text.size()), odd[at(odd.size())]);
        break;
      default: {
        const std::size_t from = at(text.size()), to = at(text.size());
        text.insert(to, text.substr(from, at(30)));
      }
    }
  return text;
}

// Whatever is in the file, reading ends with a scene or with problems in words; nothing else is thrown. 10
// 000 of them take two seconds; the count has no other reason.
TEST(CaseFile, MutationsNeverCrash) {
  std::mt19937 random(7);
  int scenes = 0, refused = 0;
  const std::string original = shipped();
  for (int n = 0; n < 10'000; ++n) {
    try {
      const Scene scene = parse_case(mutated(original, random), "case.toml", {}, roles);
      EXPECT_GT(scene.column.size[0], 0);
      ++scenes;
    } catch (const CaseError& error) {
      EXPECT_STRNE(error.what(), "");
      ++refused;
    }
  }
  EXPECT_GT(scenes, 100);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace polybed::core
