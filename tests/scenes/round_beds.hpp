// Beds in round columns, even or with a profile, for tests over both grids and all integrators.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>

#include "core/numerics/metric.hpp"
#include "core/numerics/operators.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {

/// Radius and height of the columns, m.
constexpr double tube_radius = 0.015, tube_height = 0.12;

/// A tube of 30 mm by 120 mm, eight cells across, with both species of the binary bed; a box of the same area.
inline core::Scene tube(core::ColumnShape shape, const core::Taper& profile = {}) {
  core::Scene scene = binary_bed(4, 32, tube_radius, tube_height);
  scene.column.shape = shape;
  scene.column.profile = profile;
  scene.column.size[2] = std::numbers::pi * tube_radius;
  scene.tfm.pressure_tolerance = 1e-10;
  scene.tfm.bulk_viscosity = 0.5;  // in any number of directions
  if (shape == core::ColumnShape::cylinder) {
    scene.column.dimensions = 3;
    scene.column.size = {2 * tube_radius, tube_height, 2 * tube_radius};
    scene.column.cells = {8, 32, 8};
  }
  return scene;
}

/// Closed, with the fine alone, settled: two species would change places.
inline core::Scene settled_alone(core::Scene scene) {
  scene.column.closed = true;
  scene.inlet = {};
  scene.species.resize(1);
  scene.effects.erase("species_exchange");
  scene.bed.volume_share = {1.0};
  scene.bed.start.kind = core::StartKind::settled;
  return scene;
}

/// Greatest flux of solids on any face, m/s: what is thin falls, and carries nothing.
inline double greatest_flux(const Finished& run) {
  double greatest = 0;
  for (std::size_t j = 0; j < run.model.constants().species(); ++j)
    for (int axis = 0; axis < run.grid().dimensions; ++axis) {
      const core::Index s = run.grid().stride(axis);
      const double *u = run.model.fields().solids.velocity[j][std::size_t(axis)].data(), *phi = run.phi(j).data();
      core::for_each_row(run.grid(), core::interior_faces(run.grid(), axis), [&](core::Index begin, core::Index end) {
        for (core::Index f = begin; f < end; ++f)
          greatest = std::max(greatest, std::abs(core::face_mean(phi, f, s) * u[f]));
      });
    }
  return greatest;
}

/// Flow through a level of the column upwards, of a field on faces, m3/s.
inline double passing(const core::Grid& grid, const core::Field& upward, int level) {
  double sum = 0;
  core::for_each_row(grid, core::Box{{0, level, 0}, {grid.cells[0], level + 1, grid.cells[2]}},
                     [&](core::Index begin, core::Index end) {
                       for (auto f = std::size_t(begin); f < std::size_t(end); ++f)
                         sum += grid.metric->open[1][f] * upward[f];
                     });
  return sum * grid.spacing[0] * grid.spacing[2];
}

/// Greatest difference between the fluid's flow through a level and the flow in, m3/s, over the latter.
inline double uneven_flow(const Finished& run, double inflow) {
  double worst = 0;
  for (int level = 0; level <= run.grid().cells[1]; ++level)
    worst = std::max(worst, std::abs(passing(run.grid(), run.model.fields().fluid.flux[1], level) / inflow - 1));
  return worst;
}

/// Greatest difference of the fine's fraction in two columns; `other` may have one row of cells.
inline double difference(const Finished& one, const Finished& other) {
  double apart = 0;
  const auto& cells = one.grid().cells;
  const bool in_row = other.grid().cells[0] == 1;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        const auto here = std::size_t(one.grid().index(i, j, k)),
                   there = std::size_t(in_row ? other.grid().index(0, j) : other.grid().index(i, j, k));
        if (one.grid().metric->volume[here] > 0)
          apart = std::max(apart, std::abs(one.phi(0)[here] - other.phi(0)[there]));
      }
  return apart;
}

/// A bed starts from `volume` m3 of the first species, and is fed with `feed` m3 of it in 0.2 s: the ledger of both
/// species closes to round-off.
inline void expect_a_closed_ledger(const core::Scene& scene, double volume, double feed) {
  core::Timers timers;
  tfm::Model model(scene, timers);
  model.show(0);
  const auto volumes = [&] { return measures::species_volumes(model.constants().grid, model.fields().solids); };
  const std::vector<double> start = volumes();
  EXPECT_NEAR(start[0] / volume, 1, 1e-12);
  advance(model, 0.2);
  const std::vector<double> now = volumes();
  const std::vector<fluid::Passed> passed = model.passed();
  for (std::size_t j = 0; j < 2; ++j)
    EXPECT_LT(measures::ledger_error(start[j], passed[j].in, passed[j].out, now[j]), 1e-12);
  EXPECT_NEAR(passed[0].in / feed, 1, 1e-12);
}

/// Both round grids under every integrator.
struct RoundCase {
  core::ColumnShape shape;
  const char* integrator;
  [[nodiscard]] core::Scene scene(const core::Taper& profile = {}) const {
    core::Scene scene = tube(shape, profile);
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
    return scene;
  }
};
inline void PrintTo(const RoundCase& one, std::ostream* out) {
  *out << core::name_of(one.shape) << ", " << one.integrator;
}
inline const auto round_cases = [] {
  std::vector<RoundCase> cases;
  for (const core::ColumnShape shape : {core::ColumnShape::axisymmetric, core::ColumnShape::cylinder})
    for (const char* integrator : {"explicit", "imex", "implicit"}) cases.push_back({shape, integrator});
  return testing::ValuesIn(cases);
}();

}  // namespace polybed::scenes
