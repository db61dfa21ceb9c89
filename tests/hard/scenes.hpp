// Scenes that several hard cases start from.
#pragma once

#include <algorithm>
#include <cmath>

#include "hard/hard_case.hpp"
#include "measures/bed.hpp"
#include "measures/invariants.hpp"
#include "scenes/beds.hpp"

namespace polybed::hard {

using scenes::uniform_bed;

/// A column of one row of cells with sizes and densities of two species in water, walls above and below if `closed`.
inline core::Scene two_species(int cells, double height, bool closed) {
  core::Scene scene = uniform_bed(0.807e-3, 1395, 998.207, 1.00157e-3, 0.62, cells, height);
  scene.species.push_back(scene.species[0]);
  scene.species[0].name = "fine";
  scene.species[1].name = "coarse";
  scene.species[1].diameter = 2.01e-3;
  scene.species[1].density = 1170;
  scene.bed.volume_share = {0.569, 0.431};
  scene.column.closed = closed;
  scene.effects = {{"drag", "cello"}, {"solids_stress", "frictional"}, {"species_exchange", "syamlal"}};
  return scene;
}

/// A scene of one row of cells with so many of them side by side, between walls.
[[nodiscard]] inline core::Scene between_walls(core::Scene scene, int cells) {
  scene.column.cells[0] = cells;
  scene.column.size[0] *= cells;
  scene.column.sides = core::Boundary::wall;
  return scene;
}

/// Greatest difference of a field from the mirror image of another, left and right exchanged.
[[nodiscard]] inline double asymmetry(const core::Grid& grid, const core::Field& left, const core::Field& right) {
  double most = 0;
  for (int k = 0; k < grid.cells[1]; ++k)
    for (int i = 0; i < grid.cells[0]; ++i)
      most = std::max(most, std::abs(left[std::size_t(grid.index(i, k))] -
                                     right[std::size_t(grid.index(grid.cells[0] - 1 - i, k))]));
  return most;
}

/// V11: after some time at steps of one length two runs, begin(left) of either side, are mirror images. Explicit steps
/// alone are measured; implicit ones have no such length and an algebraic multigrid that knows left from right.
template <class Begin>
void see_mirror_images(Trial& trial, double until, Begin&& begin) {
  const std::unique_ptr<Run> left = begin(true);  // a trial watches one run after the other
  trial.advance(*left, until, {.steps = false});
  const std::unique_ptr<Run> right = begin(false);
  trial.advance(*right, until, {.steps = false});
  const double apart =
      asymmetry(left->model().constants().grid, left->fields().solids.fraction[0], right->fields().solids.fraction[0]);
  if (trial.treatment().integrator == "explicit")
    trial.measure("V11 mirror symmetry", apart, 1e-12);
  else
    trial.report("mirror asymmetry", apart);
}

/// Sets the fractions at the start: change(j, k, phi) of species j in layer k of a column of one row of cells.
template <class Change>
void set_fractions(tfm::Model& model, Change&& change) {
  core::Checkpoint start = model.checkpoint();
  double* phi = start.arrays.at("state").data();
  const int layers = model.constants().grid.cells[1];
  for (std::size_t j = 0; j < model.constants().species(); ++j)
    for (int k = 0; k < layers; ++k, ++phi) *phi = change(j, k, *phi);
  model.start_from(start);
}

/// Vertical profile of a run's fields.
inline measures::Profile profile_of(Run& run) {
  measures::Profile profile;
  const tfm::Fields& fields = run.fields();
  const core::Grid& grid = run.model().constants().grid;
  profile.slab = grid.spacing[1];
  for (const core::Field& phi : fields.solids.fraction) profile.fraction.push_back(measures::lateral_mean(grid, phi));
  profile.pressure = measures::lateral_mean(grid, fields.fluid.pressure);
  return profile;
}

}  // namespace polybed::hard
