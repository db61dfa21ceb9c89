// The two-fluid model refuses what only the particle model can run, naming the key.
#include "tfm/rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/error.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using testing::HasSubstr;

std::string refusal(const std::function<void(core::Scene&)>& change) {
  core::Scene scene = uniform_bed(1e-3, 2500, 1000, 1e-3, 0.5, 8, 0.04);
  change(scene);
  core::Timers timers;
  try {
    const tfm::Model model(scene, timers);
  } catch (const core::CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(ParticleScene, IsRefusedByTheTwoFluidModel) {
  EXPECT_EQ(refusal([](core::Scene&) {}), "");
  EXPECT_THAT(refusal([](core::Scene& s) { s.fluid.name = "none"; }), HasSubstr("fluid.name = \"none\""));
  EXPECT_EQ(refusal([](core::Scene& s) { s.column.ends = core::Boundary::periodic; }), "");
  EXPECT_THAT(refusal([](core::Scene& s) { s.column.down = {0.6, -0.8, 0}; }), HasSubstr("column.gravity_direction"));
  EXPECT_THAT(refusal([](core::Scene& s) { s.column.down = {0, 1, 0}; }), HasSubstr("column.gravity_direction"));
  EXPECT_THAT(refusal([](core::Scene& s) { s.column.shear_rate = -1; }), HasSubstr("dem.shear_rate"));
  EXPECT_THAT(refusal([](core::Scene& s) { s.bed.start = {core::StartKind::random}; }),
              HasSubstr("bed.start = \"random\""));
  EXPECT_THAT(refusal([](core::Scene& s) {
                s.bed.start = {core::StartKind::list, "a.csv"};
              }),
              HasSubstr("bed.start = \"list:a.csv\""));
}

// A column that leans needs walls to lean on and a start that does not ask where down is.
TEST(ParticleScene, MayLeanWhereItIsClosed) {
  const auto leans = [](core::Scene& s) {
    s.column.down = {0.6, -0.8, 0};
    s.column.sides = core::Boundary::wall;
    s.column.closed = true;
  };
  EXPECT_EQ(refusal(leans), "");
  EXPECT_THAT(refusal([&](core::Scene& s) { leans(s), s.column.closed = false; }), HasSubstr("without column.closed"));
  EXPECT_THAT(refusal([&](core::Scene& s) { leans(s), s.column.sides = core::Boundary::periodic; }),
              HasSubstr("column.sides"));
  EXPECT_THAT(refusal([&](core::Scene& s) { leans(s), s.bed.start = {core::StartKind::settled}; }),
              HasSubstr("bed.start"));
}

TEST(ParticleScene, IsToldWithAllItsKeysAtOnce) {
  const std::string message = refusal([](core::Scene& s) {
    s.fluid.name = "none";
    s.bed.start = {core::StartKind::random};
  });
  EXPECT_THAT(message, HasSubstr("fluid.name"));
  EXPECT_THAT(message, HasSubstr("bed.start"));
}

}  // namespace
}  // namespace polybed::scenes
