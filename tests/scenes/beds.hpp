// Continuum scenes with known answers: hard cases and verification tests start from them.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "tfm/model.hpp"

namespace polybed::scenes {

constexpr double kelvin = 273.15;

/// System B of the thesis at 15 degC on a coarse grid, mixed start at 0.55: the smallest scene with all terms on.
inline core::Scene binary_bed(int nx, int ny, double width, double height) {
  core::Scene scene;
  scene.title = "binary bed";
  scene.column.size = {width, height, 4.2e-3};
  scene.column.cells = {nx, ny, 1};
  scene.fluid.name = "water";
  scene.fluid.temperature = 15 + kelvin;
  scene.species.resize(2);
  scene.species[0].name = "fine";
  scene.species[0].diameter = 0.807e-3;
  scene.species[0].density = 1395;
  scene.species[1].name = "coarse";
  scene.species[1].diameter = 2.010e-3;
  scene.species[1].density = 1170;
  scene.bed.volume_share = {0.569, 0.431};
  scene.bed.solids_fraction = 0.62;
  scene.bed.start_solids_fraction = 0.55;
  scene.bed.perturbation = 0;  // even, as what it is compared with
  scene.bed.static_height = 0.4 * height;
  scene.inlet.superficial_velocity = {{0.0, 0.03}};
  scene.effects = {{"drag", "cello"}, {"solids_stress", "frictional"}, {"species_exchange", "syamlal"}};
  scene.run.until = 1;
  scene.tfm.integrator = core::TfmIntegrator::explicit_steps;
  return scene;
}

/// Solids of one species in a fluid of given properties that fill a whole column evenly, sides periodic.
inline core::Scene uniform_bed(double diameter, double density, double fluid_density, double viscosity,
                               double solids_fraction, int cells, double height) {
  core::Scene scene;
  scene.title = "uniform bed";
  scene.column.size = {height / cells, height, height / cells};
  scene.column.cells = {1, cells, 1};
  scene.column.sides = core::Boundary::periodic;
  scene.fluid.name = "test fluid";
  scene.fluid.density = fluid_density;
  scene.fluid.viscosity = viscosity;
  scene.species.resize(1);
  scene.species[0].name = "solid";
  scene.species[0].diameter = diameter;
  scene.species[0].density = density;
  scene.bed.volume_share = {1.0};
  scene.bed.solids_fraction = scene.bed.start_solids_fraction = solids_fraction;
  scene.bed.static_height = height;
  scene.bed.perturbation = 0;  // even, as what it is compared with
  scene.effects = {{"drag", "cello"}};
  scene.tfm.integrator = core::TfmIntegrator::explicit_steps;
  return scene;
}

/// Solids of 2500 and 1500 kg/m3, the second twice as large, in a liquid of 1000 kg/m3 in a box of equal sides, with
/// every exchange and stress on. They press on each other from 0.1 on, so that the stress is smooth and acts
/// everywhere.
inline core::Scene two_species_box(int dimensions, int cells, double length, double diameter, double viscosity) {
  core::Scene scene = uniform_bed(diameter, 2500, 1000, viscosity, 0.32, cells, length);
  scene.column.dimensions = dimensions;
  scene.column.size = {length, length, length};
  scene.column.cells = {cells, cells, dimensions == 3 ? cells : 1};
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "second";
  scene.species[1].diameter = 2 * diameter;
  scene.species[1].density = 1500;
  scene.bed.volume_share = {1.0, 0.0};
  scene.effects = {{"drag", "cello"},
                   {"solids_stress", "frictional"},
                   {"species_exchange", "syamlal"},
                   {"fluid_stress", "newtonian"}};
  scene.tfm.frictional_onset = 0.1;
  scene.tfm.max_packing = 0.64;
  return scene;
}

/// With forces on single particles: lift, and the fluid that they drag along.
inline core::Scene with_particle_forces(core::Scene scene) {
  scene.effects["lift"] = "saffman_mei";
  scene.effects["added_mass"] = "zuber";
  return scene;
}

/// Advances to a time, step by step, and shows the state there.
inline void advance(tfm::Model& model, double until) {
  while (model.time() < until) model.step(until);
  model.show(until);
}

/// A model that has been advanced to a time, and its fields.
struct Finished {
  core::Timers timers;
  tfm::Model model;
  Finished(const core::Scene& scene, double until) : model(scene, timers) { advance(model, until); }
  [[nodiscard]] const core::Grid& grid() const { return model.constants().grid; }
  [[nodiscard]] const core::Field& phi(std::size_t j) const { return model.fields().solids.fraction[j]; }
};

/// The checkpoints at `end` of a run that went through and of one taken up again from that of `middle`.
struct TwoEnds {
  core::Checkpoint through, resumed;
  tfm::Work work_through, work_resumed;
};

inline TwoEnds through_and_resumed(const core::Scene& scene, double middle, double end) {
  core::Timers timers;
  const auto go_to = [](tfm::Model& model, double until) {
    while (model.time() < until) model.step(until);
    model.restart();
  };
  tfm::Model through(scene, timers), resumed(scene, timers);
  go_to(through, middle);
  resumed.resume(through.checkpoint());
  go_to(through, end);
  go_to(resumed, end);
  return {through.checkpoint(), resumed.checkpoint(), through.work(), resumed.work()};
}

/// Multiplies the fractions of the first species at the start by factor(i, j, k): an uneven bed, same for any test.
template <class Factor>
void make_uneven(tfm::Model& model, Factor&& factor) {
  core::Checkpoint start = model.checkpoint();
  double* phi = start.arrays.at("state").data();  // the first field of the state, cell by cell
  const auto& cells = model.constants().grid.cells;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) *phi++ *= factor(i, j, k);
  model.start_from(start);
}

/// Mean |a - b| over the owned cells.
inline double distance(const core::Grid& grid, const core::Field& a, const core::Field& b) {
  double sum = 0;
  core::for_each_row(grid, [&](core::Index begin, core::Index end) {
    for (core::Index c = begin; c < end; ++c) sum += std::abs(a[std::size_t(c)] - b[std::size_t(c)]);
  });
  return sum / double(grid.cell_count());
}

}  // namespace polybed::scenes
