// Gravity may point anywhere in a closed column: one that lies on its side is an upright one, turned.
#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// An uneven suspension of two species in a closed box of 8 x 12 cells, or 12 x 8 and gravity to the left.
std::vector<core::Field> settled_for_a_while(bool on_its_side, core::Grid& grid) {
  core::Scene scene = binary_bed(8, 12, 24e-3, 36e-3);
  scene.column.closed = true;
  scene.inlet.superficial_velocity.clear();
  scene.effects["fluid_stress"] = "newtonian";
  scene.bed.solids_fraction = scene.bed.start_solids_fraction = 0.3;
  scene.tfm.max_packing = 0.62;
  scene.tfm.fixed_step = 1e-3;
  scene.tfm.pressure_tolerance = 1e-13;
  scene.bed.static_height = 36e-3;
  if (on_its_side) {
    std::swap(scene.column.size[0], scene.column.size[1]);
    std::swap(scene.column.cells[0], scene.column.cells[1]);
    scene.column.down = {-1, 0, 0};
    scene.bed.static_height = 24e-3;
  }
  core::Timers timers;
  tfm::Model model(scene, timers);
  make_uneven(model, [&](int i, int j, int) {
    const int along = on_its_side ? i : j, across = on_its_side ? j : i;
    return 1 + 0.2 * std::sin(0.7 * along) + 0.1 * std::cos(0.9 * across);
  });
  advance(model, 0.1);
  grid = model.constants().grid;
  return model.fields().solids.fraction;
}

// 100 steps of one length; 1e-12: the pressure's tolerance, whose multigrid sees other axes.
TEST(LeaningColumn, OnItsSideIsAnUprightOneTurned) {
  core::Grid upright, lying;
  const std::vector<core::Field> one = settled_for_a_while(false, upright), other = settled_for_a_while(true, lying);
  double apart = 0, moved = 0;
  for (std::size_t j = 0; j < one.size(); ++j)
    for (int k = 0; k < 12; ++k)
      for (int i = 0; i < 8; ++i) {
        const double phi = one[j][std::size_t(upright.index(i, k))];
        apart = std::max(apart, std::abs(phi - other[j][std::size_t(lying.index(k, i))]));
        moved = std::max(moved, std::abs(phi - one[j][std::size_t(upright.index(i, 0))]));
      }
  record("greatest difference of a fraction", apart);
  EXPECT_GT(moved, 0.1);  // the suspension has settled: there is something to compare
  EXPECT_LT(apart, 1e-12);
}

/// A bed of one species between two distributors after 0.2 s, from the bottom, or of the same turned over from the top.
std::vector<double> bed_of_one(bool turned_over) {
  core::Scene scene = binary_bed(8, 24, 24e-3, 72e-3);
  scene.species.resize(1);
  scene.bed.volume_share = {1};
  scene.effects.erase("partition");
  scene.effects.erase("species_exchange");
  scene.effects["drag"] = "di_felice";
  scene.bed.solids_fraction = scene.bed.start_solids_fraction = 0.3;
  scene.bed.static_height = 72e-3;
  scene.inlet.at = core::ColumnEnd::top;
  scene.inlet.superficial_velocity = {{0, 0.02}, {0.1, 0.02}, {0.1, 0.03}};
  scene.tfm.max_packing = 0.62;
  scene.tfm.fixed_step = 1e-3;
  scene.tfm.pressure_tolerance = 1e-13;
  if (turned_over) {
    scene.column.down = {0, 1, 0};
    for (auto& [time, velocity] : scene.inlet.superficial_velocity) velocity = -velocity;
  }
  core::Timers timers;
  tfm::Model model(scene, timers);
  const auto up = [&](int j) { return turned_over ? 23 - j : j; };
  make_uneven(model, [&](int i, int j, int) { return 1 + 0.2 * std::sin(0.4 * up(j)) + 0.1 * std::cos(0.9 * i); });
  advance(model, 0.2);
  std::vector<double> phi;
  for (int j = 0; j < 24; ++j)
    for (int i = 0; i < 8; ++i)
      phi.push_back(model.fields().solids.fraction[0][std::size_t(model.constants().grid.index(i, up(j)))]);
  return phi;
}

// 200 steps of one length, a jump of the inlet among them; 1e-12: as above.
TEST(LeaningColumn, BetweenTwoDistributorsABedAndItsMirrorImageAreOne) {
  const std::vector<double> one = bed_of_one(false), other = bed_of_one(true);
  double apart = 0;
  for (std::size_t c = 0; c < one.size(); ++c) apart = std::max(apart, std::abs(one[c] - other[c]));
  record("greatest difference of a fraction between two distributors", apart);
  EXPECT_LT(apart, 1e-12);
  EXPECT_GT(*std::max_element(one.begin(), one.end()) - *std::min_element(one.begin(), one.end()), 0.1);
}

}  // namespace
}  // namespace polybed::scenes
