// Beds in round columns: at rest, rising, fed and emptied, and turned by a quarter.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/numerics/metric.hpp"
#include "core/numerics/operators.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using core::ColumnShape;

constexpr double radius = 0.015;

/// A tube of 30 mm by 120 mm, eight cells across, with both species of the binary bed; a box of the same area.
core::Scene tube(ColumnShape shape) {
  core::Scene scene = binary_bed(4, 32, radius, 0.12);
  scene.column.shape = shape;
  scene.tfm.pressure_tolerance = 1e-10;
  scene.tfm.bulk_viscosity = 0.5;  // in any number of directions
  if (shape != ColumnShape::cylinder) {
    scene.column.size[2] = std::numbers::pi * radius;
    return scene;
  }
  scene.column.dimensions = 3;
  scene.column.size = {2 * radius, 0.12, 2 * radius};
  scene.column.cells = {8, 32, 8};
  return scene;
}

struct Finished {
  core::Timers timers;
  tfm::Model model;
  Finished(const core::Scene& scene, double until) : model(scene, timers) { advance(model, until); }
  [[nodiscard]] const core::Grid& grid() const { return model.constants().grid; }
  [[nodiscard]] const core::Field& phi(std::size_t j) const { return model.fields().solids.fraction[j]; }
};

/// A box of one row of cells with the tube's cross-section.
core::Scene box_of(core::Scene scene) {
  scene.column.shape = ColumnShape::box;
  scene.column.dimensions = 2;
  scene.column.cells = {1, 32, 1};
  scene.column.size = {radius, 0.12, std::numbers::pi * radius};
  return scene;
}

/// Greatest difference of the fine's fraction in a tube and a box of one row.
double difference(const Finished& in_tube, const Finished& in_box) {
  double apart = 0;
  for (int k = 0; k < in_tube.grid().cells[2]; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < in_tube.grid().cells[0]; ++i) {
        const auto c = std::size_t(in_tube.grid().index(i, j, k));
        if (in_tube.grid().metric->volume[c] > 0)
          apart = std::max(apart, std::abs(in_tube.phi(0)[c] - in_box.phi(0)[std::size_t(in_box.grid().index(0, j))]));
      }
  return apart;
}

/// Greatest flux of solids on any face, m/s: what is thin falls, and carries nothing.
double greatest_flux(const Finished& run) {
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

struct Case {
  ColumnShape shape;
  const char* integrator;
};
void PrintTo(const Case& one, std::ostream* out) { *out << core::name_of(one.shape) << ", " << one.integrator; }

class RoundBed : public testing::TestWithParam<Case> {
 protected:
  static core::Scene scene() {
    core::Scene scene = tube(GetParam().shape);
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam().integrator);
    return scene;
  }
};
INSTANTIATE_TEST_SUITE_P(Shapes, RoundBed,
                         testing::Values(Case{ColumnShape::axisymmetric, "explicit"},
                                         Case{ColumnShape::axisymmetric, "imex"},
                                         Case{ColumnShape::axisymmetric, "implicit"},
                                         Case{ColumnShape::cylinder, "explicit"}, Case{ColumnShape::cylinder, "imex"},
                                         Case{ColumnShape::cylinder, "implicit"}));

// A millionth of the velocity at which the fine fall, 23 mm/s.
TEST_P(RoundBed, RestsWhereItHasSettled) {
  core::Scene scene = RoundBed::scene();
  scene.column.closed = true;
  scene.inlet = {};
  scene.species.resize(1);  // two would change places
  scene.effects.erase("species_exchange");
  scene.bed.volume_share = {1.0};
  scene.bed.start.kind = core::StartKind::settled;
  const Finished run(scene, 0.2);
  record("greatest flux of solids, m/s", greatest_flux(run));
  EXPECT_LT(greatest_flux(run), 2.3e-8);
}

// Where no wall rubs an even bed stays even, and rises as it does in a box: to what the pressure's solver, 1e-10 of its
// source, leaves over 100 steps of one length, and to the tolerance of the others.
TEST_P(RoundBed, RisesEvenlyAsInABox) {
  core::Scene round = scene();
  if (round.tfm.integrator != core::TfmIntegrator::implicit_steps) round.tfm.fixed_step = 1e-3;
  const Finished in_tube(round, 0.1), in_box(box_of(round), 0.1);
  const double apart = difference(in_tube, in_box);
  record("greatest difference of the fine's fraction", apart);
  EXPECT_LT(apart, round.tfm.fixed_step ? 1e-8 : 10 * round.tfm.rtol);
}

// The same in water with its sound: of the water, too, what has come in and not left is there, within the tolerance.
TEST(RoundBedInCompressibleWater, RisesEvenlyAsInABox) {
  for (const ColumnShape shape : {ColumnShape::axisymmetric, ColumnShape::cylinder}) {
    core::Scene round = tube(shape);
    round.fluid.equation_of_state = core::Compressibility::tait;
    round.tfm.integrator = core::TfmIntegrator::implicit_steps;
    const Finished in_tube(round, 0.1), in_box(box_of(round), 0.1);
    const double apart = difference(in_tube, in_box);
    const double lost =
        in_tube.model.fluid_account(0.1)->error(fluid::fluid_mass(in_tube.grid(), in_tube.model.fields().fluid));
    record("greatest difference of the fine's fraction", apart);
    record("water not accounted for", lost);
    EXPECT_LT(apart, 10 * round.tfm.rtol);
    EXPECT_LT(lost, round.tfm.rtol);
  }
}

// Fed on a part of the bottom and of the top, whose areas are known, and open above: the ledger closes to round-off.
TEST_P(RoundBed, CountsWhatEntersAndLeaves) {
  core::Scene scene = RoundBed::scene();
  const bool rings = scene.column.around_axis();
  scene.column.outlet = core::Outlet::open;
  scene.tfm.rtol = 1e-3;
  scene.inlet.superficial_velocity = {{0.0, 0.06}};
  const std::vector<double> low = rings ? std::vector{0.004} : std::vector{0.0045, 0.0045},  // over cells that are cut
      high = rings ? std::vector{0.008} : std::vector{0.009, 0.01};
  scene.feeds.push_back({"fine", core::ColumnEnd::bottom, {{0.0, 0.004}}, 0.05, low, high});
  core::Timers timers;
  tfm::Model model(scene, timers);
  model.show(0);
  const std::vector<double> start = measures::species_volumes(model.constants().grid, model.fields().solids);
  // The bed is solids_fraction times its settled height over the circle, whatever the cells.
  EXPECT_NEAR(start[0] / (0.569 * 0.62 * 0.048 * std::numbers::pi * radius * radius), 1, 1e-12);
  advance(model, 0.2);
  const std::vector<double> now = measures::species_volumes(model.constants().grid, model.fields().solids);
  const std::vector<fluid::Passed> passed = model.passed();
  for (std::size_t j = 0; j < 2; ++j)
    EXPECT_LT(measures::ledger_error(start[j], passed[j].in, passed[j].out, now[j]), 1e-12);
  const double area = rings ? std::numbers::pi * (0.008 * 0.008 - 0.004 * 0.004) : 0.0045 * 0.0055;
  EXPECT_NEAR(passed[0].in / (area * 0.004 * 0.2), 1, 1e-12);
}

// The solids of a box, on the same grid, have no place in cells that the wall closes, nor any motion on its faces.
TEST(RoundColumnOfCutCells, TakesNothingBeyondItsWallFromABox) {
  core::Scene round = tube(ColumnShape::cylinder), box = round;
  box.column.shape = ColumnShape::box;
  Finished from(box, 0.05);
  from.model.restart();
  Finished to(round, 0);
  to.model.start_from(from.model.checkpoint());
  to.model.show(0);
  double most = 0, closed = 0;
  core::for_each_row(to.grid(), [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
      (to.grid().metric->volume[c] > 0 ? most : closed) += to.phi(0)[c];
  });
  EXPECT_GT(most, 1);
  EXPECT_EQ(closed, 0);
}

/// A jet beside the centre, along x or along z.
core::Scene with_jet(bool along_z) {
  core::Scene scene = tube(ColumnShape::cylinder);
  scene.tfm.fixed_step = 1e-3;
  scene.effects["fluid_stress"] = "newtonian";
  std::vector<double> low{0.013, 0.006}, high{0.017, 0.011};
  if (!along_z) {
    std::swap(low[0], low[1]);
    std::swap(high[0], high[1]);
  }
  scene.jets.push_back({low, high, {{0.0, 0.2}}});
  return scene;
}

/// The greatest difference of what passes a level from what flows in, over that.
double uneven_flow(const Finished& run, double velocity) {
  const core::Grid& grid = run.grid();
  double worst = 0;
  for (int level = 0; level <= grid.cells[1]; ++level) {
    double sum = 0;
    core::for_each_row(grid, core::Box{{0, level, 0}, {grid.cells[0], level + 1, grid.cells[2]}},
                       [&](core::Index begin, core::Index end) {
                         for (auto f = std::size_t(begin); f < std::size_t(end); ++f)
                           sum += grid.metric->open[1][f] * run.model.fields().fluid.flux[1][f];
                       });
    worst = std::max(worst, std::abs(sum / (core::open_faces_below(grid, level) * velocity) - 1));
  }
  return worst;
}

// As much through every level: to what the pressure's solver leaves, 1e-10 of its source, after some steps. 12 cells
// across, for which the implicit steps take multigrid; then a start from it with another inflow.
TEST(RoundColumnOfCutCells, LetsAsMuchThroughBetweenTwoDistributors) {
  for (const char* integrator : {"explicit", "imex", "implicit"}) {
    core::Scene scene = tube(ColumnShape::cylinder);
    scene.column.cells = {12, 20, 12};
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
    scene.inlet = {{{0.0, 0.02}}, {}, core::ColumnEnd::top};
    const Finished run(scene, 0.02);
    record(std::string("uneven flow, ") + integrator, uneven_flow(run, 0.02));
    EXPECT_LT(uneven_flow(run, 0.02), 1e-8);
    scene.inlet.superficial_velocity = {{0.0, 0.03}};
    Finished other(scene, 0);
    other.model.start_from(run.model.checkpoint());
    advance(other.model, 0.01);
    EXPECT_LT(uneven_flow(other, 0.03), 1e-8) << integrator;
  }
}

// The tube is the same turned by a quarter: round-off of sums in another order, amplified over 100 steps.
TEST(RoundColumnOfCutCells, KnowsNoDirection) {
  const Finished one(with_jet(false), 0.1), other(with_jet(true), 0.1);
  double apart = 0, uneven = 0;
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 8; ++i) {
        const double here = one.phi(0)[std::size_t(one.grid().index(i, j, k))];
        apart = std::max(apart, std::abs(here - other.phi(0)[std::size_t(other.grid().index(k, j, i))]));
        uneven = std::max(uneven, std::abs(here - one.phi(0)[std::size_t(one.grid().index(k, j, i))]));
      }
  record("greatest difference of the fine's fraction", apart);
  EXPECT_LT(apart, 1e-9);
  EXPECT_GT(uneven, 0.01);  // the jet does something
}

}  // namespace
}  // namespace polybed::scenes
