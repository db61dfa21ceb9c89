#include "tfm/initial.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/timers.hpp"
#include "scenes/beds.hpp"
#include "tfm/evenness.hpp"

namespace polybed::tfm {
namespace {

core::Scene uneven_bed(double perturbation, std::uint64_t seed = 1) {
  core::Scene scene = scenes::binary_bed(6, 20, 0.03, 0.1);
  scene.bed.perturbation = perturbation;
  scene.bed.seed = seed;
  return scene;
}

std::vector<double> fractions(const core::Scene& scene, double* difference = nullptr) {
  core::Timers timers;
  Model model(scene, timers);
  model.show(0);
  if (difference != nullptr) *difference = lateral_difference(model.constants().grid, model.fields());
  return model.fields().solids.fraction[0];
}

TEST(Initial, AMixedStartDiffersFromCellToCellByTheShareAskedFor) {
  double even = 1, uneven = 0;
  const std::vector<double> before = fractions(uneven_bed(0), &even), after = fractions(uneven_bed(1e-3), &uneven);
  EXPECT_LT(even, 1e-15);
  EXPECT_GT(uneven, 0.1e-3 * 0.55);
  EXPECT_LT(uneven, 4e-3 * 0.55);  // each side within the share and the mean taken off
  const core::Grid grid = core::grid_of(uneven_bed(0).column, nullptr);
  for (int y = 0; y < 20; ++y) {  // each layer keeps its solids
    double change = 0;
    for (int x = 0; x < 6; ++x) {
      const auto c = std::size_t(grid.index(x, y));
      change += after[c] - before[c];
      EXPECT_NEAR(after[c], before[c], 2e-3 * before[c]);
    }
    EXPECT_NEAR(change, 0, 1e-15);
  }
}

TEST(Initial, ThePerturbationFollowsFromTheSeed) {
  EXPECT_EQ(fractions(uneven_bed(1e-3)), fractions(uneven_bed(1e-3)));
  EXPECT_NE(fractions(uneven_bed(1e-3)), fractions(uneven_bed(1e-3, 2)));
}

// Two size classes of a species share the lower layer, 0.569 of the volume, in their proportion; the other lies above.
TEST(Initial, SizeClassesOfASpeciesAreOneLayer) {
  core::Scene scene = uneven_bed(0);
  scene.species.insert(scene.species.begin() + 1, scene.species[0]);
  scene.species[1].name = "fine.2";
  scene.bed.volume_share = {0.369, 0.2, 0.431};
  scene.bed.start = {core::StartKind::layered};
  scene.bed.layer = {1, 1, 2};
  scene.effects.erase("species_exchange");
  core::Timers timers;
  Model model(scene, timers);
  model.show(0);
  const auto& phi = model.fields().solids.fraction;
  const core::Grid& grid = model.constants().grid;
  std::array<double, 3> volume{};  // of a column of cells, over its area
  for (int y = 0; y < 20; ++y) {
    const auto c = std::size_t(grid.index(0, y));
    EXPECT_NEAR(phi[1][c] * 0.369, phi[0][c] * 0.2, 1e-15);
    if (y < 5) {
      EXPECT_EQ(phi[2][c], 0);
    }
    for (std::size_t j = 0; j < 3; ++j) volume[j] += phi[j][c] * grid.spacing[1];
  }
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_NEAR(volume[j], scene.bed.volume_share[j] * 0.04 * 0.62, 1e-15);  // of 0.4 of 0.1 m at 0.62
}

/// A bed whose layers are these.
core::Scene bed_of_layers(std::vector<core::Layer> layers) {
  core::Scene scene = uneven_bed(0);
  scene.layers = std::move(layers);
  scene.bed.start = {core::StartKind::layered};
  return scene;
}

/// Volume of each species, m3.
std::vector<double> volumes_of(const core::Grid& grid, const std::vector<core::Field>& phi) {
  std::vector<double> volume(phi.size(), 0.0);
  for (int z = 0; z < grid.cells[2]; ++z)
    for (int y = 0; y < grid.cells[1]; ++y)
      for (int x = 0; x < grid.cells[0]; ++x)
        for (std::size_t j = 0; j < phi.size(); ++j) volume[j] += phi[j][std::size_t(grid.index(x, y, z))];
  for (double& one : volume) one *= grid.spacing[0] * grid.spacing[1] * grid.spacing[2];
  return volume;
}

// A dam over 12.5 of 30 mm, in cells of 5 mm: 22 mm of the first species at 0.6, on it 13 mm of one part of the first
// to three of the second at 0.5.
TEST(Initial, CellsThatALayerCutsGetTheirShareByVolume) {
  core::Scene scene =
      bed_of_layers({{"", {1, 0}, 0.022, 0.6, {0}, {0.0125}}, {"", {0.25, 0.75}, 0.013, 0.5, {0}, {0.0125}}});
  scene.tfm.frictional_onset = 0.45;  // 0.9 of the looser layer, as the reader sets it
  core::Timers timers;
  Model model(scene, timers);
  model.show(0);
  const auto& phi = model.fields().solids.fraction;
  const core::Grid& grid = model.constants().grid;
  const auto at = [&](std::size_t j, int x, int y) { return phi[j][std::size_t(grid.index(x, y))]; };
  EXPECT_NEAR(at(0, 0, 0), 0.6, 1e-15);
  EXPECT_NEAR(at(0, 2, 0), 0.5 * 0.6, 1e-15);
  EXPECT_EQ(at(0, 3, 0), 0);
  EXPECT_NEAR(at(0, 1, 4), 0.4 * 0.6 + 0.6 * 0.5 * 0.25, 1e-14);  // round-off of the layer's edges in cells
  EXPECT_NEAR(at(1, 1, 4), 0.6 * 0.5 * 0.75, 1e-14);
  EXPECT_NEAR(at(1, 1, 7), 0, 1e-14);
  scene.bed.start_fraction = 0.45;
  Model looser(scene, timers);
  looser.show(0);
  const double wide = 0.0125 * grid.spacing[2], lower = 0.022 * 0.6 * wide, upper = 0.013 * 0.5 * wide;
  for (Model* one : {&model, &looser}) {
    const std::vector<double> volume = volumes_of(grid, one->fields().solids.fraction);
    EXPECT_NEAR(volume[0], lower + 0.25 * upper, 1e-14 * lower);  // round-off of 20 cells
    EXPECT_NEAR(volume[1], 0.75 * upper, 1e-14 * upper);
  }
  EXPECT_NEAR(looser.fields().solids.fraction[0][std::size_t(grid.index(0, 4))], 0.45, 1e-15);
}

TEST(Initial, LayersLieSideBySideInThreeDimensions) {
  core::Scene scene = bed_of_layers(
      {{"", {1, 0}, 0.02, 0.6, {0, 0}, {0.01, 0.02}}, {"", {0, 1}, 0.03, 0.55, {0.01, 0.005}, {0.03, 0.02}}});
  scene.column.dimensions = 3;
  scene.column.size[2] = 0.02;
  scene.column.cells[2] = 4;
  core::Timers timers;
  Model model(scene, timers);
  model.show(0);
  const auto& phi = model.fields().solids.fraction;
  const core::Grid& grid = model.constants().grid;
  const std::vector<double> volume = volumes_of(grid, phi);
  EXPECT_NEAR(volume[0], 0.6 * 0.02 * 0.01 * 0.02, 1e-14 * volume[0]);
  EXPECT_NEAR(volume[1], 0.55 * 0.03 * 0.02 * 0.015, 1e-14 * volume[1]);
  EXPECT_NEAR(phi[1][std::size_t(grid.index(2, 0, 1))], 0.55, 1e-15);
  EXPECT_NEAR(phi[1][std::size_t(grid.index(2, 0, 0))], 0, 1e-15);
}

TEST(Evenness, WarnsOfABedThatIsOneColumnOfCells) {
  core::Timers timers;
  Model even(uneven_bed(0), timers), uneven(uneven_bed(1e-3), timers);
  even.show(0);
  uneven.show(0);
  EXPECT_EQ(warning_of_an_even_bed(even.constants().grid, even.fields()).size(), 1u);
  EXPECT_TRUE(warning_of_an_even_bed(uneven.constants().grid, uneven.fields()).empty());
  core::Scene single = uneven_bed(0);
  single.column.cells[0] = 1;
  Model column(single, timers);
  column.show(0);
  EXPECT_TRUE(warning_of_an_even_bed(column.constants().grid, column.fields()).empty());
}

TEST(Evenness, WhileARunGoesOnIsSaidOnceTheFluidHasCrossedTheBedTenTimes) {
  core::Timers timers;
  Model even(uneven_bed(0), timers), uneven(uneven_bed(1e-3), timers);
  even.show(0);
  uneven.show(0);
  const core::Grid& grid = even.constants().grid;
  EXPECT_FALSE(EvennessWatch::of(grid, 0));
  auto watch = EvennessWatch::of(grid, 0.02), other = watch;
  EXPECT_TRUE(watch->look(49, 0.1, grid, even.fields()).empty());  // 0.1 m at 20 mm/s, ten times: 50 s
  EXPECT_EQ(watch->look(51, 0.1, grid, even.fields()).size(), 1u);
  EXPECT_TRUE(watch->look(52, 0.1, grid, even.fields()).empty());
  EXPECT_TRUE(other->look(51, 0.1, grid, uneven.fields()).empty());
  core::Scene single = uneven_bed(0);
  single.column.cells[0] = 1;
  EXPECT_FALSE(EvennessWatch::of(Model(single, timers).constants().grid, 0.02));
}

// Over the first step that the rates of an uneven start suggest, round-off of the fluxes alone exceeds the tolerance of
// the pressure: Newton would fail until steps are 2e-17 s.
TEST(Initial, AnUnevenStartFindsItsFirstImplicitStepAtATightTolerance) {
  core::Scene scene = uneven_bed(1e-3);
  scene.species.resize(1);
  scene.species[0].diameter = 0.3e-3;
  scene.species[0].density = 2500;
  scene.bed.volume_share = {1.0};
  scene.bed.start_solids_fraction = 0.45;
  scene.inlet.superficial_velocity = {{0.0, 0.01}};
  scene.effects.erase("species_exchange");
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  scene.tfm.rtol = 1e-9;
  core::Timers timers;
  Model model(scene, timers);
  for (int n = 0; n < 10; ++n) ASSERT_NO_THROW(model.step(1));
  EXPECT_GT(model.time(), 1e-9);
}

}  // namespace
}  // namespace polybed::tfm
