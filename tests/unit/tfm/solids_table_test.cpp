// The file of a table of sheared particles: written, read, taken at a place.
#include "tfm/solids_table.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "../core/scratch.hpp"
#include "core/error.hpp"
#include "core/output/file.hpp"

namespace polybed::tfm {
namespace {

/// 3 x 2 x 2 x 1 x 1, p_ratio linear in e and growing with phi and stokes.
SolidsTable sample() {
  SolidsTable t;
  t.regime = core::BoxRegime::wet;
  t.reference = "viscous";
  t.phi = {0.1, 0.3, 0.5};
  t.stokes = {1, 10};
  t.restitution = {0.7, 0.9};
  t.friction = {0.3};
  t.share = {0};
  t.inertia = 0.125;
  t.residual = 0.01;
  t.case_hash = "abc";
  t.created = "2026-11-21T00:00:00Z";
  for (std::size_t n = 0; n < t.size(); ++n) {
    const double value = 1 + 0.1 * double(n);
    for (TableQuantity* q : {&t.pressure, &t.viscosity, &t.dissipation, &t.temperature}) {
      q->value.push_back(value);
      q->error.push_back(0.01 * value);
      q->seeds.push_back(3);
    }
    t.shear_number.push_back(double(n));
  }
  return t;
}

TEST(SolidsTable, RoundTripKeepsEveryBit) {
  const test::Scratch scratch;
  SolidsTable t = sample();
  t.bed.phi = {0.2, 0.5};
  t.bed.pressure = {0.1, 0.4};
  t.bed.error = {0.01, 0.02};
  t.exchange = t.pressure;
  t.exchange_drift = 0.4;
  const auto path = scratch.path() / "table.h5";
  write_solids_table(path, t);
  EXPECT_EQ(regime_of_table(path), core::BoxRegime::wet);
  const SolidsTable r = read_solids_table(path);
  EXPECT_EQ(r.phi, t.phi);
  EXPECT_EQ(r.stokes, t.stokes);
  EXPECT_EQ(r.pressure.value, t.pressure.value);
  EXPECT_EQ(r.viscosity.error, t.viscosity.error);
  EXPECT_EQ(r.temperature.seeds, t.temperature.seeds);
  EXPECT_EQ(r.shear_number, t.shear_number);
  EXPECT_EQ(r.bed.pressure, t.bed.pressure);
  EXPECT_EQ(r.exchange.value, t.exchange.value);
  EXPECT_EQ(r.exchange_drift, 0.4);
  EXPECT_EQ(r.inertia, t.inertia);
  EXPECT_EQ(r.case_hash, t.case_hash);
  EXPECT_FALSE(r.git_commit.empty());
}

// Index (phi, stokes, e): n = 4 p + 2 s + e. At phi 0.3, stokes 1: 1.4 at e 0.7, 1.5 at e 0.9; half way 1.45.
TEST(SolidsTable, IsLinearBetweenAndMovesByStandardErrors) {
  const SolidsTable t = sample();
  EXPECT_NEAR(ratios_at(t, {0.8, 0.3, 0, 0})(0.3, 1).pressure.pressure, 1.45, 1e-12);
  EXPECT_NEAR(ratios_at(t, {0.8, 0.3, 0, 1})(0.3, 1).pressure.pressure, 1.45 * 1.01, 1e-12);
  EXPECT_NEAR(ratios_at(t, {0.2, 0.3, 0, 0})(0.3, 1).pressure.pressure, 1.4, 1e-12);  // held
}

// At phi 0.3, e 0.7 and 0.9: half of 1.4 and 1.5, half way 0.725; beyond 0.5 its edge, half of 1.8 and 1.9.
TEST(SolidsTable, ExchangeIsReadAsTheRatiosAre) {
  SolidsTable t = sample();
  EXPECT_THROW((void)exchange_at(t, {0.8, 0.3, 0, 0}), std::invalid_argument);
  t.exchange = t.pressure;
  for (double& v : t.exchange.value) v *= 0.5;
  EXPECT_NEAR(exchange_at(t, {0.8, 0.3, 0, 0})(0.3).pressure, 0.725, 1e-12);
  EXPECT_NEAR(exchange_at(t, {0.8, 0.3, 0, 0})(0.6).pressure, 0.925, 1e-12);
}

TEST(SolidsTable, TellsWhereASceneLiesBeyondIt) {
  SolidsTable t = sample();
  EXPECT_TRUE(beyond(t, {0.2, 0.3, 0.4, 0, 2.5}).empty()) << "neither restitution nor sizes matter to wet mean spheres";
  EXPECT_TRUE(beyond(t, {0.8, 0.6 * 0.3 + 0.4 * 0.3, 0, 0}).empty()) << "the rounding of a mean is nothing";
  EXPECT_EQ(beyond(t, {0.8, 0.5, 0, 0}),
            std::vector<std::string>{"friction 0.5 lies outside the table's 0.3 to 0.3: its edge is held"});
  t.regime = core::BoxRegime::dry;
  EXPECT_EQ(beyond(t, {0.2, 0.3, 0, 0}).size(), 1U);
  t.share = {0.25, 0.75};
  t.size_ratio = 2;
  EXPECT_TRUE(beyond(t, {0.8, 0.3, 0.5, 0, 2}).empty());
  EXPECT_EQ(beyond(t, {0.8, 0.3, 0.8, 0, 2}).size(), 1U);
  EXPECT_EQ(beyond(t, {0.8, 0.3, 0.5, 0, 2.5}),
            std::vector<std::string>{"the sizes of the species are as 1 to 2.5, those of the table as 1 to 2"});
  EXPECT_EQ(beyond(t, {0.2, 0.5, 0.8, 0, 1}).size(), 4U);
}

// By hand: 3/4 of the bed's volume with friction 0.2 and the case's restitution 0.9, 1/4 with 0.6 and 0.5.
TEST(SolidsTable, PlaceOfASceneIsTheMeanByVolume) {
  core::Scene scene;
  scene.species.resize(2);
  core::set_restitution(scene, 0.9);
  core::set_friction(scene, 0.6);
  scene.species[0].diameter = 1e-3;
  scene.species[0].friction = 0.2;
  scene.species[1].diameter = 3e-3;
  scene.species[1].restitution = 0.5;
  scene.bed.volume_share = {0.75, 0.25};
  const TablePlace place = place_of(scene);
  EXPECT_NEAR(place.friction, 0.3, 1e-15);
  EXPECT_NEAR(place.restitution, 0.8, 1e-15);
  EXPECT_EQ(place.share, 0.25);
  EXPECT_NEAR(place.size_ratio, 3, 1e-15);
  // The first species cut in two says the same of both: a mean over species would say 0.333 and 0.767.
  scene.species.insert(scene.species.begin(), scene.species[0]);
  scene.bed.volume_share = {0.5, 0.25, 0.25};
  EXPECT_NEAR(place_of(scene).friction, 0.3, 1e-15);
  EXPECT_NEAR(place_of(scene).restitution, 0.8, 1e-15);
}

TEST(SolidsTable, OtherFilesAreRefused) {
  const test::Scratch scratch;
  core::OutputFile file(core::FileKind{"polybed solids table", 1});
  file.set_attribute("/", "regime", std::string("bed"));
  file.save(scratch.path() / "bed.h5");
  EXPECT_THROW((void)read_solids_table(scratch.path() / "bed.h5"), core::FileError);
  EXPECT_THROW((void)read_solids_table(scratch.path() / "none.h5"), core::FileError);
}

}  // namespace
}  // namespace polybed::tfm
