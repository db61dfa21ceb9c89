// Effects that nobody has, added by the public interface as docs/guide/add-a-force.md says: an entry, a maker and a
// place in the list. The reader takes them, the chooser weighs them, the models make them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/case/file.hpp"
#include "multiscale/roles.hpp"
#include "relevance/choice.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/supremum.hpp"
#include "scenes/dem_fluid_sides.hpp"
#include "scenes/record.hpp"
#include "tests/unit/multiscale/beads_case.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::multiscale {
namespace {

constexpr double push = 1e-7;  ///< N, along x

// A force on particles: entry, maker, list.

const relevance::Effect wind{
    .role = "wind",
    .help = "a push along x",
    .absent = "not in this version",
    .laws = {{"steady", "the same push on every particle"}},
    .rules = {relevance::needs_a_fluid("wind")},
    .number = "push over weight",
    .weigh = [](const relevance::Weighing& by, relevance::EffectRow row) -> std::optional<relevance::EffectRow> {
      row = relevance::as_force(row, by.scene);
      relevance::Supremum greatest;
      for (const relevance::Situation& s : by.survey.situations) greatest.add(s, push / s.reference());
      greatest.fill(row);
      return row;
    },
    .share = [](const relevance::Encountered& met) -> std::optional<double> { return push / met.weight; }};

class Wind final : public dem::SideForce {
 public:
  void add(const dem::SideView& view, dem::SideRows& rows) override {
    for (std::size_t i = 0; i < view.loads.size(); ++i) rows.of(i)[0] += push;
  }
};

const dem::Maker wind_maker{&wind, "Force",
                            dem::MakeForce([](const dem::ForceMaking&) -> std::unique_ptr<dem::SideForce> {
                              return std::make_unique<Wind>();
                            })};

std::vector<const dem::Maker*> with_wind() {
  std::vector<const dem::Maker*> list = dem::effects();
  list.push_back(&wind_maker);
  return list;
}

relevance::Menu menu_with_wind() {
  relevance::Menu all = menu();
  relevance::add(all, wind, "dem", wind_maker.slot);
  return all;
}

const std::string text = test::beads_case("wind = \"steady\"\n");

core::Scene read(const std::vector<std::string>& settings) {
  const relevance::Menu all = menu_with_wind();
  return core::parse_case(text, "case.toml", settings, relevance::roles_of(all), size_classes,
                          relevance::rules_of(all));
}

TEST(MadeUpForce, IsReadWithItsRules) {
  EXPECT_EQ(core::law_of(read({}), "wind"), "steady");
  EXPECT_THROW((void)read({"effects.wind=strong"}), core::CaseError);
  try {
    (void)read({"fluid.name=none"});
    FAIL() << "wind without a fluid";
  } catch (const core::CaseError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("case.toml:13:1: effects.wind = \"steady\" cannot act"));
  }
}

// By hand: a bead of 1 mm weighs pi/6 (2500 - 998.2) 9.81 1e-9 N = 7.714e-6 N in water.
TEST(MadeUpForce, IsWeighedAndChosen) {
  const relevance::Choice choice = relevance::choose(read({"chooser.tolerance=0.01"}), menu_with_wind());
  const relevance::EffectRow* row = relevance::find_row(choice.rows, "wind");
  ASSERT_NE(row, nullptr);
  EXPECT_NEAR(row->value.value(), push / 7.714e-6, 1e-5);
  EXPECT_EQ(row->state, relevance::EffectRow::State::on);
  EXPECT_EQ(row->models, "dem");
  core::Scene scene = read({"effects.wind=auto", "chooser.tolerance=0.01"});
  EXPECT_EQ(core::law_of(relevance::with_choice(scene, menu_with_wind()), "wind"), "steady");
}

TEST(MadeUpForce, ActsWhereACaseCallsForItAlone) {
  core::Scene scene = scenes::sphere_in_water(1e-3, 2500, {0.01, 0.01, 0.01}, {4, 4, 4});
  for (const bool on : {false, true}) {
    if (on) scene.effects["wind"] = "steady";
    scenes::HeldShear shear(scene, 0, 1e-4, 1, 0, with_wind());
    shear.add({5e-3, 5e-3, 5e-3}, {});
    shear.begin();
    EXPECT_EQ(shear.sides.present(), on);
    EXPECT_EQ(shear.motion.load[0].force[0], on ? push : 0);
    shear.step();
    EXPECT_EQ(shear.particles.motion[0].v[0] > 0, on);
  }
}

// A stress of the solids in place of the shipped ones: p = k phi, so that dp/dphi is k everywhere.

constexpr double stiffness = 12;  ///< Pa

class Foam final : public tfm::StressEffect {
 public:
  explicit Foam(const tfm::Making& m) {
    for (core::Field* field : {&m.fields.stress.pressure, &m.fields.stress.slope, &m.fields.stress.damping})
      *field = core::make_field(m.constants.grid);
  }
  void evaluate(tfm::Fields& fields) override {
    for (std::size_t c = 0; c < fields.solids_fraction.size(); ++c) {
      fields.stress.pressure[c] = stiffness * fields.solids_fraction[c];
      fields.stress.slope[c] = stiffness;
    }
  }
  [[nodiscard]] double max_packing() const override { return 0.9; }
  [[nodiscard]] double packing_of(std::span<const double>) const override { return 0.9; }
  [[nodiscard]] double packing_above(const tfm::Fields&) const override { return 0; }
  [[nodiscard]] double pressure_at(double solids_fraction) const override { return stiffness * solids_fraction; }
  [[nodiscard]] double solids_fraction_at(double pressure) const override { return pressure / stiffness; }
};

const relevance::Effect foam{
    .role = "foam",
    .help = "a spongy bed",
    .laws = {{"linear", "p = k phi"}},
    .rules = relevance::excludes("foam", "*", "solids_stress", "frictional", "one stress"),
    .number = "-",
    .weigh = [](const relevance::Weighing&, relevance::EffectRow row) { return std::optional(row); }};

const tfm::Maker foam_maker{&foam, "Stress",
                            [](const tfm::Making& m) { m.effects.solids_stress = std::make_unique<Foam>(m); }};

TEST(MadeUpStress, IsMadeAndEvaluated) {
  std::vector<const tfm::Maker*> list = tfm::effects();
  list.push_back(&foam_maker);
  core::Scene scene = scenes::uniform_bed(1e-3, 2500, 1000, 1e-3, 0.5, 8, 0.04);
  core::Timers timers;
  const tfm::Model bare(scene, timers);
  tfm::Fields fields = bare.fields();
  const fluid::Boundaries boundaries(bare.constants().grid, fluid::ends_of(scene));
  EXPECT_EQ(tfm::make_effects(scene, bare.constants(), boundaries, fields, list).solids_stress, nullptr);
  scene.effects["foam"] = "linear";
  const tfm::Effects made = tfm::make_effects(scene, bare.constants(), boundaries, fields, list);
  ASSERT_NE(made.solids_stress, nullptr);
  std::fill(fields.solids_fraction.begin(), fields.solids_fraction.end(), 0.25);
  made.solids_stress->evaluate(fields);
  EXPECT_EQ(fields.stress.pressure[0], 3);
  EXPECT_EQ(fields.stress.slope[0], stiffness);
  scene.effects["solids_stress"] = "frictional";
  EXPECT_THROW((void)tfm::make_effects(scene, bare.constants(), boundaries, fields, list), core::CaseError);
}

}  // namespace
}  // namespace polybed::multiscale
