// Cases for the particle model: without a fluid, sheared, inclined, given particle by particle.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "core/case/file.hpp"
#include "core/case/keys.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::core {
namespace {

using testing::HasSubstr;

/// A whole case without a fluid; the tests add lines to its tables.
struct Lines {
  std::string column, fluid, species, bed, dem, more;
};

std::string dry_case(const Lines& lines, const std::string& start =
                                             "volume_share = [1.0]\nstatic_height = 0.06\n"
                                             "solids_fraction = 0.6\n") {
  return fmt::format(
      "[column]\nsize = [0.06, 0.6]\ncells = [12, 120]\n{}\n[fluid]\nname = \"none\"\n{}\n[[species]]\nname = "
      "\"fine\"\n"
      "diameter = 0.0008\ndensity = 1395\n{}\n[bed]\n{}{}\n[run]\nuntil = 2\n[dem]\n{}\n{}\n",
      lines.column, lines.fluid, lines.species, start, lines.bed, lines.dem, lines.more);
}

const std::string box = "sides = \"periodic\"\nends = \"periodic\"\ngravity = 0\n";

std::string refusal_of(const std::string& text) {
  try {
    (void)parse_case(text, "case.toml", {}, {});
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(ParticleCase, WithoutAFluidNeedsNoInlet) {
  const Scene scene = parse_case(dry_case({}), "case.toml", {}, {});
  EXPECT_EQ(scene.fluid.name, "none");
  EXPECT_TRUE(scene.inlet.superficial_velocity.empty());
  const std::string resolved = resolved_case(scene);
  EXPECT_EQ(resolved_case(parse_case(resolved, "again.toml", {}, {})), resolved);
}

TEST(ParticleCase, KeysOfDemReachTheScene) {
  Lines lines;
  lines.column = box;
  lines.dem =
      "tangential = \"mindlin\"\ntail = \"keep\"\nintegrator = \"synchronised\"\nnormal_stiffness = \"2 N/mm\"\n"
      "rolling_friction = 0.01\nrolling_damping = 0.3\nskin = \"0.1 mm\"\nmax_overlap = \"2 "
      "%\"\n"
      "fixed_step = \"1 us\"\ngreatest_speed = \"2 m/s\"\nstart_speed = \"1 cm/s\"\nshear_rate = \"3 1/s\"\n"
      "ledger = false\ncohesion_energy = \"50 mJ/m2\"\nhamaker_constant = 1e-19\ncohesion_gap = \"1 nm\"\n"
      "surface_tension = \"72 mN/m\"\ncontact_angle = 30\nliquid_fraction = \"1 %\"\n";
  const Scene scene = parse_case(dry_case(lines), "case.toml", {}, {});
  const Dem& dem = scene.dem;
  EXPECT_EQ(dem.tangential, Tangential::mindlin);
  EXPECT_EQ(dem.tail, Tail::keep);
  EXPECT_EQ(dem.integrator, DemIntegrator::synchronised);
  EXPECT_DOUBLE_EQ(dem.normal_stiffness.value(), 2000);
  EXPECT_EQ(dem.rolling_friction, 0.01);
  EXPECT_EQ(dem.rolling_damping, 0.3);
  EXPECT_EQ(dem.skin, 1e-4);
  EXPECT_EQ(dem.max_overlap, 0.02);
  EXPECT_EQ(dem.fixed_step, 1e-6);
  EXPECT_EQ(dem.greatest_speed, 2);
  EXPECT_EQ(dem.start_speed, 0.01);
  EXPECT_EQ(scene.column.shear_rate, 3);
  EXPECT_FALSE(dem.ledger);
  EXPECT_EQ(dem.cohesion_energy, 0.05);
  EXPECT_EQ(scene.material.hamaker_constant, 1e-19);
  EXPECT_EQ(dem.cohesion_gap, 1e-9);
  EXPECT_EQ(scene.material.surface_tension, 0.072);
  EXPECT_EQ(scene.material.contact_angle, 30);
  EXPECT_EQ(scene.material.liquid_fraction, 0.01);
  const std::string resolved = resolved_case(scene);
  EXPECT_EQ(resolved_case(parse_case(resolved, "again.toml", {}, {})), resolved);
}

/// What the table of keys calls the default is what a scene has, key by key of [dem].
TEST(ParticleCase, DefaultsOfDemAreThoseOfTheTable) {
  Lines lines;
  for (const Key& key : find_table("dem")->keys) {
    if (key.standard.empty()) continue;
    const bool bare = key.kind == Kind::truth || key.kind == Kind::count;
    lines.dem += fmt::format("{0} = {2}{1}{2}\n", key.name, key.standard, bare ? "" : "\"");
  }
  EXPECT_THAT(lines.dem, HasSubstr("cohesion_gap"));
  EXPECT_EQ(resolved_case(parse_case(dry_case(lines), "case.toml", {}, {})),
            resolved_case(parse_case(dry_case({}), "case.toml", {}, {})));
}

TEST(ParticleCase, DepthHoldsTwoParticlesAndTwoSkins) {
  Lines lines;
  // 2 d + 2 skin; without a skin, twice a tenth of d
  EXPECT_DOUBLE_EQ(parse_case(dry_case(lines), "case.toml", {}, {}).column.size[2], 1.76e-3);
  lines.dem = "skin = 0.0002\n";
  EXPECT_DOUBLE_EQ(parse_case(dry_case(lines), "case.toml", {}, {}).column.size[2], 2e-3);
}

TEST(ParticleCase, GravityPointsWhereItIsTold) {
  Lines lines;
  EXPECT_THAT(parse_case(dry_case(lines), "case.toml", {}, {}).column.down, testing::ElementsAre(0, -1, 0));
  lines.column = "gravity_direction = [3, -4]\n";
  EXPECT_THAT(parse_case(dry_case(lines), "case.toml", {}, {}).column.down, testing::ElementsAre(0.6, -0.8, 0));
  std::string solid = dry_case({});
  solid.replace(solid.find("size = [0.06, 0.6]\ncells = [12, 120]"), 37,
                "size = [0.06, 0.03, 0.6]\ncells = [12, 6, 120]\ngravity_direction = [0, 3, -4]");
  EXPECT_THAT(parse_case(solid, "case.toml", {}, {}).column.down, testing::ElementsAre(0, -0.8, 0.6));
}

struct WrongLines {
  Lines lines;
  std::string message;
  friend void PrintTo(const WrongLines& wrong, std::ostream* out) { *out << wrong.message.substr(0, 40); }
};

class WrongParticleCase : public testing::TestWithParam<WrongLines> {};

TEST_P(WrongParticleCase, IsToldByItsKey) {
  EXPECT_THAT(refusal_of(dry_case(GetParam().lines)), HasSubstr(GetParam().message));
}

WrongLines column(const std::string& lines, const std::string& message) {
  return {{lines, {}, {}, {}, {}, {}}, message};
}
WrongLines fluid(const std::string& lines, const std::string& message) {
  return {{{}, lines, {}, {}, {}, {}}, message};
}
WrongLines bed(const std::string& lines, const std::string& message) { return {{{}, {}, {}, lines, {}, {}}, message}; }
WrongLines dem(const std::string& lines, const std::string& message) { return {{{}, {}, {}, {}, lines, {}}, message}; }
WrongLines more(const std::string& lines, const std::string& message) { return {{{}, {}, {}, {}, {}, lines}, message}; }

INSTANTIATE_TEST_SUITE_P(
    Column, WrongParticleCase,
    testing::Values(
        column("ends = \"open\"", "case.toml:4:8: column.ends = \"open\": allowed are wall | periodic"),
        column("ends = \"periodic\"\nclosed = true",
               "column.ends = \"periodic\" and column.closed = true contradict each other"),
        column("ends = \"periodic\"\noutlet = \"open\"",
               "column.ends = \"periodic\" and column.outlet = \"open\" contradict each other"),
        column("gravity_direction = [0, 0, -1]", "column.gravity_direction has 3 numbers, column.size 2"),
        column("gravity_direction = [0, 0]", "column.gravity_direction has no direction: all its numbers are 0"),
        column("gravity_direction = [0, nan]", "case.toml:4:25: column.gravity_direction = nan is out of range"),
        column("gravity_direction = [\"1 m\", 0]", "expected a value in 1, this one is in m")));

INSTANTIATE_TEST_SUITE_P(
    NoFluid, WrongParticleCase,
    testing::Values(fluid("temperature = 300", "fluid.temperature cannot act: fluid.name = \"none\""),
                    fluid("density = 1000", "fluid.density cannot act"),
                    fluid("viscosity = 1e-3", "fluid.viscosity cannot act"),
                    fluid("equation_of_state = \"tait\"", "fluid.equation_of_state cannot act"),
                    more("[inlet]\nsuperficial_velocity = 0.1", "inlet.superficial_velocity cannot act"),
                    more("[[jet]]\nfrom = [0.01]\nto = [0.02]\nsuperficial_velocity = 0.1", "[[jet]] cannot act")));

INSTANTIATE_TEST_SUITE_P(
    Dem, WrongParticleCase,
    testing::Values(dem("tangential = \"mindlim\"",
                        "dem.tangential = \"mindlim\": allowed are hdd | mindlin | mindlin_deresiewicz | linear; did "
                        "you mean \"mindlin\"?"),
                    dem("tail = \"cut\"", "dem.tail = \"cut\": allowed are clip | keep"),
                    dem("integrator = \"thesys\"",
                        "allowed are auto | thesis | synchronised; did you mean \"thesis\"?"),
                    dem("normal_stiffness = 0", "dem.normal_stiffness = 0 is out of range: above 0, at most 1e+12 N/m"),
                    dem("normal_stiffness = \"1 N\"", "expected a value in N/m, this one is in kg m/s2"),
                    dem("tangential_ratio = 0.3", "unknown key 'tangential_ratio' in [dem]; it is 2/7 now"),
                    dem("rolling_friction = -0.1", "is out of range: at least 0, at most 10"),
                    dem("rolling_damping = -0.1", "is out of range: at least 0, at most 10"),
                    dem("skin = 0", "dem.skin = 0 is out of range: above 0, at most 1 m"),
                    dem("max_overlap = 0", "dem.max_overlap = 0 is out of range: above 0, at most 1"),
                    dem("fixed_step = 0", "dem.fixed_step = 0 is out of range: above 0, at most 1000 s"),
                    dem("greatest_speed = 0", "dem.greatest_speed = 0 is out of range: above 0, at most 100000 m/s"),
                    dem("start_speed = -1", "dem.start_speed = -1 is out of range: at least 0, at most 100000 m/s"),
                    dem("shear_rate = \"1 s\"", "expected a value in 1/s, this one is in s"),
                    dem("opening = 0", "dem.opening = 0 is out of range: above 0, at most 100 m"),
                    dem("opening = 0.06", "dem.opening = 0.06 m: it must be narrower than the bottom, which is 0.06 m"),
                    dem("opening = 0.0007", "dem.opening = 0.0007 m: the largest particle, of 0.0008 m, must fit"),
                    dem("ledger = 1", "dem.ledger = 1: expected true or false"),
                    dem("cohesion_energy = -1", "dem.cohesion_energy = -1 is out of range: at least 0"),
                    dem("hamaker_constant = \"1 N\"", "expected a value in J, this one is in"),
                    dem("cohesion_gap = 0", "dem.cohesion_gap = 0 is out of range: above 0, at most 1 m"),
                    dem("surface_tension = 0", "dem.surface_tension = 0 is out of range: above 0, at most 10 N/m"),
                    dem("contact_angle = 91", "dem.contact_angle = 91 is out of range: at least 0, at most 90"),
                    dem("liquid_fraction = 2", "dem.liquid_fraction = 2 is out of range: at least 0, at most 0.1"),
                    dem("shear_rate = 2", "dem.shear_rate = 2 1/s needs column.sides = \"periodic\""),
                    dem("shear_rate = 2", "dem.shear_rate = 2 1/s needs column.ends = \"periodic\""),
                    dem("shear_rate = 2", "dem.shear_rate = 2 1/s needs column.gravity = 0, it is 9.81 m/s2")));

INSTANTIATE_TEST_SUITE_P(
    Bed, WrongParticleCase,
    testing::Values(bed("start = \"randon\"", "did you mean \"random\"?"),
                    bed("start = \"random\"\nstart_solids_fraction = 0.2",
                        "bed.start_solids_fraction cannot act: bed.start = \"random\""),
                    bed("start = \"list:none.csv\"",
                        "bed.start = \"list:none.csv\": no such file in the working directory or beside the case file"),
                    bed("start = \"list:none.csv\"", "bed.volume_share cannot act: bed.start = \"list:none.csv\""),
                    bed("start = \"list:none.csv\"", "bed.static_height cannot act: bed.start = \"list:none.csv\""),
                    bed("start = \"list:none.csv\"\nstart_solids_fraction = 0.2",
                        "bed.start_solids_fraction cannot act")));

INSTANTIATE_TEST_SUITE_P(ContactPair, WrongParticleCase,
                         testing::Values(more("[[contact_pair]]\nbetween = [\"fine\", \"fluid\"]",
                                              "contact_pair.between: no species 'fluid'"),
                                         more("[[contact_pair]]\nbetween = [\"wall\", \"wall\"]",
                                              "a wall touches no wall"),
                                         more("[[contact_pair]]\nbetween = [\"fine\", \"wall\"]\n[[contact_pair]]\n"
                                              "between = [\"wall\", \"fine\"]",
                                              "two [[contact_pair]] of fine and wall: write one")));

TEST(ParticleCase, TheFluidOfAShearedBoxIsItsFlow) {
  Lines sheared{"ends = \"periodic\"\nsides = \"periodic\"\ngravity = 0", {}, {}, {}, {}, {}};
  sheared.dem = "shear_rate = 2";
  std::string text = dry_case(sheared);
  text.replace(text.find("\"none\""), 6, "\"water\"\ntemperature = \"20 degC\"");
  EXPECT_EQ(refusal_of(text), "") << "no inlet is asked for";
  EXPECT_THAT(refusal_of(text + "\n[inlet]\nsuperficial_velocity = 0.1\n"),
              HasSubstr("inlet.superficial_velocity cannot act in a sheared box"));
}

TEST(ParticleCase, JoinedEndsTakeNoInletAndNoFeed) {
  const auto wet = [](const std::string& column, const std::string& more) {
    std::string text = dry_case({"ends = \"periodic\"" + column, {}, {}, {}, {}, more});
    return text.replace(text.find("\"none\""), 6, "\"water\"\ntemperature = \"20 degC\"");
  };
  EXPECT_EQ(refusal_of(wet("", "")), "");
  EXPECT_THAT(refusal_of(wet("", "[inlet]\nsuperficial_velocity = 0.1")),
              HasSubstr("inlet.superficial_velocity cannot act between joined ends"));
  EXPECT_THAT(refusal_of(wet("\npressure_gradient = \"10 Pa\"", "")), HasSubstr("expected a value in Pa/m"));
  EXPECT_THAT(refusal_of(wet("\npressure_gradient = \"weigth\"", "")), HasSubstr("did you mean \"weight\"?"));
  const Scene scene = parse_case(wet("\npressure_gradient = \"-2 kPa/m\"", ""), "case.toml", {}, {});
  EXPECT_EQ(std::get<double>(scene.column.pressure_gradient), -2000);
  EXPECT_THAT(resolved_case(scene), HasSubstr("pressure_gradient = -2000"));
  Lines feed;
  feed.column = "ends = \"periodic\"";
  feed.more = "[[feed]]\nspecies = \"fine\"\nvelocity = 1\nsuperficial_velocity = 0.1";
  EXPECT_THAT(refusal_of(dry_case(feed)), HasSubstr("column.ends = \"periodic\" and [[feed]] contradict"));
}

TEST(ParticleCase, AnOpeningNeedsABottomAndNoFluid) {
  Lines lines;
  lines.dem = "opening = 0.01\n";
  EXPECT_EQ(parse_case(dry_case(lines), "case.toml", {}, {}).dem.opening, 0.01);
  std::string wet = dry_case(lines) + "\n[inlet]\nsuperficial_velocity = 0.1\n";
  wet.replace(wet.find("\"none\""), 6, "\"water\"\ntemperature = \"20 degC\"");
  EXPECT_THAT(refusal_of(wet),
              HasSubstr("dem.opening = 0.01 m: a fluid enters there, and particles leave through the top alone"));
  lines.column = "ends = \"periodic\"";
  EXPECT_THAT(refusal_of(dry_case(lines)), HasSubstr("leaves no bottom to open"));
  std::string solid = dry_case(lines);
  solid.replace(solid.find("size = [0.06, 0.6]\ncells = [12, 120]"), 37,
                "size = [0.06, 0.01, 0.6]\ncells = [12, 6, 120]\n");
  EXPECT_THAT(refusal_of(solid), HasSubstr("narrower than the bottom, which is 0.01 m deep"));
}

const std::string closed = "closed = true\n";

/// The same particles in a fluid, with roles that act there.
std::string message_in_fluid(const std::string& column, const std::string& dem, const std::string& more,
                             const std::string& fluid = "water") {
  std::string text = dry_case({column, "temperature = 288", {}, {}, dem, more});
  text.replace(text.find("\"none\""), 6, "\"" + fluid + "\"");
  try {
    (void)parse_case(text, "case.toml", {}, {});
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(ParticleCaseInAFluid, IsHeldOnlyInAFluid) {
  EXPECT_EQ(message_in_fluid(closed, "held = true", ""), "");
  EXPECT_THAT(refusal_of(dry_case({{}, {}, {}, {}, "held = true", {}})),
              HasSubstr("dem.held = true is a fixed bed for a fluid"));
}

TEST(ParticleCaseInAFluid, IsTiltedOnlyWhereNothingFlowsInAndDensityIsConstant) {
  const std::string tilted = "gravity_direction = [1, -1]\n", inlet = "[inlet]\nsuperficial_velocity = 0.1";
  EXPECT_EQ(message_in_fluid(tilted + "closed = true", "", ""), "");
  EXPECT_EQ(message_in_fluid("gravity_direction = [0, -2]", "", inlet), "");
  EXPECT_THAT(message_in_fluid(tilted, "", inlet), HasSubstr("column.gravity_direction other than down needs a fluid"));
  std::string gas =
      dry_case({tilted + "closed = true", "temperature = 300\nequation_of_state = \"ideal_gas\"", {}, {}, {}, {}});
  gas.replace(gas.find("\"none\""), 6, "\"air\"");
  EXPECT_THAT(refusal_of(gas), HasSubstr("column.gravity_direction other than down and a compressible fluid"));
}

TEST(ParticleCaseInAFluid, HasATemperatureOnlyWithOne) {
  EXPECT_EQ(message_in_fluid(closed, "", ""), "");
  EXPECT_THAT(message_in_fluid(closed, "", "", "none"),
              HasSubstr("fluid.temperature cannot act: fluid.name = \"none\""));
}

/// A list of particles in a folder of its own, with the case beside it.
class CaseWithAList : public testing::Test {
 protected:
  CaseWithAList() { std::ofstream(scratch_.path() / "beads.csv") << "species,x,y,z\nfine,0.01,0.02,0.001\n"; }
  [[nodiscard]] std::string case_name() const { return (scratch_.path() / "case.toml").string(); }
  test::Scratch scratch_;
};

TEST_F(CaseWithAList, FindsItBesideTheCaseAndNeedsNothingElseOfTheBed) {
  const std::string text = dry_case({}, "start = \"list:beads.csv\"\n");
  const Scene scene = parse_case(text, case_name(), {}, {});
  EXPECT_EQ(text_of(scene.bed.start), "list:" + (scratch_.path() / "beads.csv").string());
  const std::string resolved = resolved_case(scene);
  EXPECT_THAT(resolved, Not(HasSubstr("solids_fraction")));
  EXPECT_EQ(resolved_case(parse_case(resolved, "elsewhere/again.toml", {}, {})), resolved);
}

TEST_F(CaseWithAList, TakesTheOneOfTheWorkingDirectoryFirst) {
  const std::filesystem::path before = std::filesystem::current_path();
  const test::Scratch here;
  std::ofstream(here.path() / "beads.csv") << "species,x,y,z\n";
  std::filesystem::current_path(here.path());
  const Scene scene = parse_case(dry_case({}, "start = \"list:beads.csv\"\n"), case_name(), {}, {});
  std::filesystem::current_path(before);
  EXPECT_EQ(text_of(scene.bed.start), "list:beads.csv");
}

TEST_F(CaseWithAList, ThatIsFedNeedsThePackingOfTheFeed) {
  Lines lines;
  lines.more = "[[feed]]\nspecies = \"fine\"\nvelocity = 1\nsuperficial_velocity = 0.1";
  EXPECT_THAT(refusal_of(dry_case(lines, "start = \"list:beads.csv\"\n")), HasSubstr("bed.solids_fraction is missing"));
}

TEST_F(CaseWithAList, MayCountItsParticlesOfClassesOfSize) {
  std::string text = dry_case({}, "start = \"list:beads.csv\"\n");
  text.replace(text.find("diameter = 0.0008"), 17, "distribution = \"lognormal\"\nmedian = 0.0008\ndeviation = 0.3");
  const ClassRule two = [](const SizeDistribution& given) {
    return std::vector<std::pair<double, double>>{{*given.median / 2, 0.25}, {*given.median * 2, 0.75}};
  };
  const Scene scene = parse_case(text, case_name(), {}, {}, two);
  ASSERT_EQ(scene.species.size(), 2U);
  EXPECT_EQ(scene.species[1].name, "fine.2");
}

}  // namespace
}  // namespace polybed::core
