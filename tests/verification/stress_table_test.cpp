// The pressure of a fluidised bed from a table: read, refused, in balance with the weight above.
#include <gtest/gtest.h>

#include "../unit/core/scratch.hpp"
#include "core/error.hpp"
#include "core/output/file.hpp"
#include "scenes/record.hpp"
#include "tfm/effects/solids_stress_table.hpp"

namespace polybed::scenes {
namespace {

/// Writes a table of p_bed in units of (rho_p - rho_f) g D; returns its name.
std::string written(const test::Scratch& scratch, const std::vector<double>& phi, const std::vector<double>& p_bed,
                    const std::string& regime = "bed") {
  core::OutputFile file(core::FileKind{"polybed solids table", 1});
  file.set_attribute("/", "regime", regime);
  file.write("phi", {phi.size()}, phi);
  file.write("p_bed", {p_bed.size()}, p_bed);
  const auto path = scratch.path() / "table.h5";
  file.save(path);
  return path.string();
}

/// 1.2 mm, 2700 kg/m3 in water at 20 degC.
core::Scene column(const std::string& file) {
  core::Scene scene = uniform_bed(1.2e-3, 2700, 998.207, 1.00157e-3, 0.6, 20, 0.2);
  scene.column.closed = true;
  scene.effects["solids_stress"] = "table:" + file;
  scene.bed.start = {core::StartKind::settled};
  scene.bed.static_height = 0.1;
  return scene;
}

// (2700 - 998.207) 9.81 1.2e-3 = 20.033507 Pa is the unit, by hand; p_f is 0 up to 0.5.
TEST(StressTable, AddsItsPressureAndHoldsABedLooserThanFrictionDoes) {
  const test::Scratch scratch;
  const std::string file = written(scratch, {0.2, 0.4, 0.5, 0.6}, {0.1, 1.0, 3.0, 9.0});
  core::Timers timers;
  core::Scene scene = column(file);
  tfm::Model model(scene, timers);
  const tfm::StressEffect& stress = *model.effects().solids_stress;
  EXPECT_EQ(stress.pressure_at(0), 0);
  EXPECT_NEAR(stress.pressure_at(0.2), 0.1 * 20.033507, 1e-6);
  EXPECT_NEAR(stress.pressure_at(0.5), 3 * 20.033507, 1e-5);
  EXPECT_NEAR(stress.solids_fraction_at(20.033507), 0.4, 1e-7);
  const tfm::Fields& fields = model.fields();
  model.show(0);
  const auto at = [&](int j) { return std::size_t(model.constants().grid.index(0, j)); };
  int top = 0;
  while (top < 19 && fields.solids_fraction[at(top + 1)] > 0) ++top;
  EXPECT_LT(fields.solids_fraction[at(top - 1)], 0.5) << "friction alone holds no layer looser than its onset";
  double weight = 0;  // above the centre of the lowest cell
  for (int j = 1; j < 20; ++j) weight += fields.solids_fraction[at(j)] * (2700 - 998.207) * 9.81 * 0.01;
  weight += 0.5 * fields.solids_fraction[at(0)] * (2700 - 998.207) * 9.81 * 0.01;
  EXPECT_NEAR(fields.stress.pressure[at(0)], weight, 1e-9 * weight);  // bisections of the start, round-off
  const core::Field before = fields.solids_fraction;
  advance(model, 1.0);
  for (int j = 0; j < 20; ++j) EXPECT_NEAR(fields.solids_fraction[at(j)], before[at(j)], 1e-3);  // ten times rtol
  ASSERT_TRUE(stress.use());
  EXPECT_GT(stress.use()->evaluations, 0u);
}

TEST(StressTable, CountsWhatLiesBeyondIt) {
  const test::Scratch scratch;
  core::Timers timers;
  core::Scene scene = column(written(scratch, {0.2, 0.4}, {0.1, 1.0}));
  tfm::Model model(scene, timers);
  model.show(0);
  EXPECT_GT(model.effects().solids_stress->use()->guarded, 0u);
  EXPECT_NEAR(model.effects().solids_stress->pressure_at(0.5), 20.033507, 1e-6);  // held
}

TEST(StressTable, WrongFilesAreRefused) {
  const test::Scratch scratch;
  EXPECT_THROW((void)tfm::read_bed_pressure(written(scratch, {0.2, 0.4, 0.5}, {0.1, 1.0, 0.9})), core::CaseError);
  EXPECT_THROW((void)tfm::read_bed_pressure(written(scratch, {0.4, 0.4}, {0.1, 1.0})), core::CaseError);
  EXPECT_THROW((void)tfm::read_bed_pressure(written(scratch, {0.2, 0.4}, {0.1, 1.0}, "dry")), core::CaseError);
  EXPECT_THROW((void)tfm::read_bed_pressure((scratch.path() / "none.h5").string()), core::FileError);
  EXPECT_EQ(tfm::read_bed_pressure(written(scratch, {0.2, 0.4}, {0.1, 1.0})).first(), 0);
}

}  // namespace
}  // namespace polybed::scenes
