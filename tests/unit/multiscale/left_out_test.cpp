// What a run's record says of the effects that its model does without.
#include "multiscale/effects/left_out.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "closures/relevance.hpp"
#include "core/case/file.hpp"
#include "multiscale/roles.hpp"
#include "tests/unit/multiscale/beads_case.hpp"

namespace polybed::multiscale {
namespace {

const std::string beads = test::beads_case("solids_stress = \"frictional\"\ncontact = \"hertz_mindlin\"\n",
                                           "density = 1000, viscosity = 1e-3");

core::Scene scene_of(const std::vector<std::string>& overrides = {}) {
  return core::parse_case(beads, "case.toml", overrides, all_roles(), size_classes);
}

const LeftOutEffect* find(const LeftOut& all, const std::string& effect) {
  for (const LeftOutEffect& one : all.effects)
    if (one.row.effect == effect) return &one;
  return nullptr;
}

// The pull of two asperities of 200 nm, A R*/(6 z^2) with R* half of that and z the gap of contact
// (docs/reference/effects.md), over the weight.
TEST(LeftOut, BoundsAForceThatTheCaseHasOff) {
  const LeftOut all = left_out(scene_of({"dem.roughness=2e-7", "dem.hamaker_constant=3e-20"}), "dem");
  const LeftOutEffect* cohesion = find(all, "cohesion");
  ASSERT_TRUE(cohesion != nullptr && cohesion->bound);
  const double weight = std::acos(-1.0) / 6 * 1e-9 * 1500 * 9.81;
  EXPECT_NEAR(*cohesion->bound / (3e-20 * 1e-7 / (6 * std::pow(closures::relevance_contact_gap, 2)) / weight), 1,
              1e-12);  // rounding
  EXPECT_EQ(cohesion->why, "off in the case");
}

TEST(LeftOut, AShareAboveTheWeightHasNoNumber) {
  EXPECT_EQ(share_of_weight(0.064), "6.4 %");
  EXPECT_EQ(share_of_weight(1), "100 %");
  EXPECT_EQ(share_of_weight(4.1), "over 100 %");
}

// The certain part takes the lower end of each band: of lift and of the Magnus force nothing, of the rest its bound.
TEST(LeftOut, CountsTheLowerEndsOfBandsAsCertain) {
  const LeftOut all = left_out(scene_of(), "tfm");
  double certain = 0, greatest = 0;
  for (const LeftOutEffect& one : all.effects) {
    if (!one.row.summed && !one.row.share_off) continue;
    const double bound = one.bound.value_or(0);
    greatest += bound;
    certain += one.row.band ? std::min(bound, one.row.band->least) : bound;
  }
  EXPECT_NEAR(all.sum, greatest, 1e-15);
  EXPECT_NEAR(all.least, certain, 1e-15);
  EXPECT_LT(all.least, all.sum);
}

TEST(LeftOut, IsOfTheModelThatRuns) {
  const core::Scene scene = scene_of({"effects.magnus=rubinow_keller"});
  const LeftOut two_fluid = left_out(scene, "tfm"), particles = left_out(scene, "dem");
  const LeftOutEffect* magnus = find(two_fluid, "magnus");
  ASSERT_TRUE(magnus != nullptr && magnus->bound);
  EXPECT_GT(*magnus->bound, 0);
  EXPECT_EQ(magnus->why, "no law of it in this model");
  EXPECT_EQ(find(particles, "magnus"), nullptr);
  EXPECT_NEAR(two_fluid.sum - particles.sum, *magnus->bound, 1e-15);
  // The same bound as where the case has it off.
  EXPECT_EQ(*find(left_out(scene_of(), "dem"), "magnus")->bound, *magnus->bound);
  // Lift acts in both.
  const core::Scene both = scene_of({"effects.lift=saffman_mei"});
  for (const char* model : {"tfm", "dem"}) {
    EXPECT_EQ(find(left_out(both, model), "lift"), nullptr);
    EXPECT_GT(*find(left_out(scene_of(), model), "lift")->bound, 0);
  }
  // What the other model is made of is not left out of this one.
  EXPECT_EQ(find(two_fluid, "contact"), nullptr);
  EXPECT_EQ(find(particles, "solids_stress"), nullptr);
}

TEST(LeftOut, SumsTheBoundsOfForces) {
  const LeftOut all = left_out(scene_of({"chooser.purpose=transient"}), "dem");
  double sum = 0;
  for (const LeftOutEffect& one : all.effects)
    if (one.row.summed || one.row.share_off) sum += one.bound.value_or(0);
  EXPECT_DOUBLE_EQ(all.sum, sum);
  EXPECT_GT(*find(all, "added_mass")->bound, 0.02);  // of s = 0.4: C_m s/(1 + C_m s) with C_m of 0.5 at least
  EXPECT_EQ(*find(left_out(scene_of(), "dem"), "added_mass")->bound, 0);
  EXPECT_GE(all.up_to, all.sum);
}

// Stress of the fluid over min(20 mm/10, 10 x 1 mm) = 2 mm, 2 sqrt(mu/beta)/(2 mm): a share that counts, whatever its
// kind; and a scene that calls for it is said to.
TEST(LeftOut, CountsStressAndWarnsOfWhatTheSceneCallsFor) {
  const LeftOut off = left_out(scene_of(), "tfm"), on = left_out(scene_of({"effects.fluid_stress=newtonian"}), "tfm");
  const LeftOutEffect* stress = find(off, "fluid_stress");
  ASSERT_TRUE(stress != nullptr && stress->bound);
  EXPECT_GT(*stress->bound, 0.02);
  EXPECT_NEAR(off.sum - on.sum, *stress->bound, 1e-15);
  EXPECT_NE(called_for_line(off).find("fluid_stress"), std::string::npos);
  EXPECT_EQ(called_for_line(on).find("fluid_stress"), std::string::npos);
  EXPECT_EQ(called_for_line(off).find("lubrication"), std::string::npos);  // of particles alone
  EXPECT_NE(called_for_line(left_out(scene_of(), "dem")).find("lubrication"), std::string::npos);
}

// Without drag nothing carries the bed: its whole weight. What a second species gives by contact counts in the model of
// averaged solids alone.
TEST(LeftOut, CountsDragAndExchange) {
  const core::Scene with = scene_of({"effects.drag=richardson_zaki"});  // by which forces are weighed without a drag
  EXPECT_NEAR(left_out(scene_of({"effects.drag=none"}), "tfm").sum - left_out(with, "tfm").sum, 1, 1e-12);
  std::string two = beads;
  two.replace(two.find("volume_share = [1]"), 18, "volume_share = [0.5, 0.5]");
  two.insert(two.find("[effects]"), "[[species]]\nname = \"large\"\ndiameter = \"2 mm\"\ndensity = 2500\n");
  const core::Scene scene = core::parse_case(two, "case.toml", {}, all_roles(), size_classes);
  const LeftOut continuum = left_out(scene, "tfm");
  const LeftOutEffect* exchange = find(continuum, "species_exchange");
  ASSERT_TRUE(exchange != nullptr && exchange->bound);
  EXPECT_GT(*exchange->bound, 0);
  EXPECT_NEAR(continuum.sum - left_out(scene, "dem").sum, *exchange->bound, 1e-15);
}

// What the sum consists of is named with what can be done about it, or why nothing can.
TEST(LeftOut, SaysWhatCanBeDoneAboutTheSum) {
  const auto told = [](const std::vector<std::string>& settings, const char* model) {
    std::string all;
    for (const std::string& line : remedies(left_out(scene_of(settings), model))) all += line + "\n";
    return all;
  };
  EXPECT_EQ(told({"chooser.tolerance=1"}, "tfm"), "");
  EXPECT_NE(told({}, "tfm").find("switch on fluid_stress"), std::string::npos);
  const std::string on = "effects.fluid_stress=newtonian", strong = "dem.hamaker_constant=1e-16";
  EXPECT_NE(told({on, strong}, "tfm").find("no law in the two-fluid model, but in polybed dem: cohesion"),
            std::string::npos);
  EXPECT_NE(told({on, strong}, "dem").find("switch on cohesion"), std::string::npos);
  // Re_p above 1: no more than a range is known of the history force.
  const std::string open = told({on, "chooser.purpose=transient", "effects.added_mass=zuber"}, "dem");
  EXPECT_TRUE(open.find("history") != std::string::npos) << open;
}

// Stokes' law knows no neighbours: by hand, 18 mu u/d^2 = (rho_p - rho_f) g eps gives 1e-6/18e-3 1500 9.81 0.4 m/s =
// 327 mm/s, where a particle falls at 150 mm/s.
TEST(LeftOut, WarnsOfADragLawThatIgnoresNeighbours) {
  const std::string told = called_for_line(left_out(scene_of({"effects.drag=stokes"}), "tfm"));
  EXPECT_NE(told.find("drag: stokes is made for one sphere"), std::string::npos) << told;
  EXPECT_NE(told.find("lifted at 327 mm/s, though a particle falls at 1"), std::string::npos) << told;
  for (const char* law : {"effects.drag=cello", "effects.drag=richardson_zaki"})
    EXPECT_EQ(called_for_line(left_out(scene_of({law}), "tfm")).find("drag:"), std::string::npos);
}

// The advice of docs/guide/choose-a-drag-law.md.
TEST(Drag, IsAdvisedByWhatIsDragged) {
  const auto advised = [](const std::vector<std::string>& settings) {
    const relevance::Choice choice = choose(scene_of(settings));
    const relevance::EffectRow* row = relevance::find_row(choice.rows, "drag");
    return row->model;
  };
  EXPECT_EQ(advised({}), "richardson_zaki");  // cello expands a liquid bed too far
  EXPECT_EQ(advised({"effects.drag=wen_yu"}), "wen_yu");
  EXPECT_EQ(advised({"effects.drag=auto"}), "richardson_zaki");
  EXPECT_EQ(advised({"effects.drag=ergun"}), "richardson_zaki");
  const std::string slow = "inlet.superficial_velocity=\"0.1 mm/s\"";
  EXPECT_EQ(advised({"effects.drag=ergun", slow}), "ergun");
  EXPECT_EQ(advised({"effects.drag=wen_yu", slow}), "brinkman_oseen");
  const std::vector<std::string> air{"fluid.density=1.2", "fluid.viscosity=1.8e-5", "inlet.superficial_velocity=1"};
  const auto in_air = [&](const std::string& law) {
    std::vector<std::string> settings = air;
    settings.push_back("effects.drag=" + law);
    return advised(settings);
  };
  EXPECT_EQ(in_air("vbk"), "vbk");
  EXPECT_EQ(in_air("stokes"), "gidaspow");
  EXPECT_EQ(in_air("auto"), "gidaspow");
}

TEST(LeftOut, SaysWhatWasChosen) {
  core::Scene scene = scene_of();
  EXPECT_EQ(chosen_line(scene), "");
  scene.chooser.chosen = {"drag", "lift"};
  EXPECT_EQ(chosen_line(scene),
            "effects that the case does not name: drag = cello; 1 of 2 off, chosen by polybed effects");
}

// Water at 0.2 m/s in 20 mm: Re = 998 0.2 0.02/1e-3 = 4000.
TEST(LeftOut, SaysWhatIsNotKnown) {
  EXPECT_EQ(find(left_out(scene_of(), "dem"), "turbulence"), nullptr);
  const LeftOut fast = left_out(scene_of({"inlet.superficial_velocity=0.2"}), "dem");
  ASSERT_NE(find(fast, "turbulence"), nullptr);
  EXPECT_FALSE(find(fast, "turbulence")->bound);
  EXPECT_TRUE(left_out_lines(fast).back().starts_with("bounds unknown: "));
  EXPECT_NE(left_out_lines(fast).back().find("turbulence"), std::string::npos) << left_out_lines(fast).back();
}

TEST(LeftOut, SaysWhereTheSumIsMoreThanPromised) {
  const LeftOut more = left_out(scene_of({"chooser.tolerance=1e-4"}), "tfm");
  const LeftOut less = left_out(scene_of({"chooser.tolerance=0.9"}), "tfm");
  ASSERT_TRUE(more.sum > more.promise && less.sum < less.promise);
  EXPECT_NE(left_out_lines(more)[0].find("more than promised"), std::string::npos);
  EXPECT_EQ(left_out_lines(less)[0].find("more than promised"), std::string::npos);
}

TEST(LeftOut, IsThereForEveryCaseThatIsShipped) {
  int cases = 0;
  for (const auto& folder : std::filesystem::directory_iterator(POLYBED_SOURCE_DIR "/cases")) {
    if (!std::filesystem::exists(folder.path() / "case.toml")) continue;
    ++cases;
    const core::Scene scene = core::read_case(folder.path() / "case.toml", {}, all_roles(), size_classes);
    for (const char* model : {"tfm", "dem"}) {
      const LeftOut all = left_out(scene, model);
      EXPECT_TRUE(std::isfinite(all.sum)) << folder.path();
      EXPECT_FALSE(all.effects.empty()) << folder.path();
      EXPECT_LE(left_out_lines(all).size(), 3U) << folder.path();
      core::Json json;
      write_left_out(json, all);
      EXPECT_NO_THROW((void)core::json_text(json)) << folder.path();  // all numbers are finite
    }
  }
  EXPECT_GE(cases, 15);
}

}  // namespace
}  // namespace polybed::multiscale
