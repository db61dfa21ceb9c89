// What a particle in a round column gives to cells and faces that the wall cuts, and sees of them.
#include "dem/coupling/round_weights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "cloud.hpp"
#include "core/numerics/metric.hpp"
#include "dem/coupling/gather.hpp"
#include "dem/coupling/scatter.hpp"
#include "fluid/convection.hpp"

namespace polybed::dem::test {
namespace {

constexpr double diameter = 12e-3, height = 10e-3;  ///< of the column, m
constexpr double round_off = 1e-14;

/// \param across, deep  cells along x and z
core::Scene round_scene(int across, int deep) {
  core::Scene scene = cloud_scene(3, false);
  scene.column.shape = core::ColumnShape::cylinder;
  scene.column.size = {diameter, height, diameter};
  scene.column.cells = {across, 5, deep};
  return scene;
}

constexpr std::array<std::array<int, 2>, 5> all_cells{{{3, 3}, {6, 6}, {9, 9}, {16, 16}, {7, 10}}};

/// A cone that widens into a tube, and a tube between steps; with an even number of cells across and an odd one.
core::Scene tapered_scene(bool steps, int across) {
  core::Scene scene = round_scene(across, across);
  scene.column.cells[1] = 12;
  scene.column.profile = steps
                             ? core::Taper{{0, diameter},           {0.25 * height, diameter},  {0.25 * height, 0.007},
                                           {2 * height / 3, 0.007}, {2 * height / 3, diameter}, {height, diameter}}
                             : core::Taper{{0, 0.006}, {0.7 * height, diameter}, {height, diameter}};
  return scene;
}

std::vector<core::Scene> all_scenes() {
  std::vector<core::Scene> scenes{tapered_scene(false, 10), tapered_scene(false, 13), tapered_scene(true, 10)};
  for (const auto& cells : all_cells) scenes.push_back(round_scene(cells[0], cells[1]));
  return scenes;
}

double diameter_at(const core::Column& column, double y) {
  return column.is_tapered() ? column.diameter_at(y) : diameter;
}

/// Places in the column, alike on any platform.
std::vector<Vector> places(std::size_t number, const core::Column& column = {}) {
  std::mt19937_64 random(11);
  const auto one = [&] { return double(random() >> 11) * 0x1p-53; };
  std::vector<Vector> found;
  while (found.size() < number) {
    const Vector x{diameter * one(), height * one(), diameter * one()};
    if (std::hypot(x[0] - 0.5 * diameter, x[2] - 0.5 * diameter) < 0.5 * diameter_at(column, x[1])) found.push_back(x);
  }
  return found;
}

/// Open volume of the momentum of a face, in cells.
double volume_on(const core::Grid& grid, std::size_t axis, std::size_t at) {
  const double per_volume = grid.metric->per_volume_on[axis][at];
  return per_volume > 0 ? 1 / per_volume : 0;
}

TEST(RoundWeights, AddUpToOneOnOpenEntriesAlone) {
  for (const core::Scene& scene : all_scenes()) {
    const core::Grid grid = core::grid_of(scene.column, nullptr);
    const RoundWeights weights(grid);
    for (const Vector& x : places(2000, scene.column)) {
      const RoundShares shares = weights(x);
      double sum = 0;
      for_each_cell(3, shares, [&](std::size_t at, double w) {
        sum += w;
        EXPECT_GE(w, 0);
        EXPECT_TRUE(w == 0 || grid.metric->volume[at] > 0);
      });
      EXPECT_NEAR(sum, 1, round_off);
      for (int axis = 0; axis < 3; ++axis) {
        sum = 0;
        for_each_face(3, shares, axis, [&](std::size_t at, double w) {
          sum += w;
          EXPECT_TRUE(w == 0 || volume_on(grid, std::size_t(axis), at) > 0);
        });
        EXPECT_NEAR(sum, 1, round_off);
      }
    }
  }
}

TEST(RoundWeights, AreThoseOfABoxFarFromTheWall) {
  const core::Grid grid = core::grid_of(round_scene(16, 16).column, nullptr);
  const RoundWeights round(grid);
  const Weights box(grid);
  int compared = 0;
  for (const Vector& x : places(2000)) {
    const double away = std::hypot(x[0] - 0.5 * diameter, x[2] - 0.5 * diameter);
    if (away > 0.5 * diameter - 5 * grid.spacing[0]) continue;
    ++compared;
    std::map<std::size_t, double> difference;
    for_each_cell(3, round(x), [&](std::size_t at, double w) { difference[at] += w; });
    for_each_cell(3, box(x), [&](std::size_t at, double w) { difference[at] -= w; });
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t other = std::size_t(axis + 1) << 32;  // not to be taken for cells
      for_each_face(3, round(x), axis, [&](std::size_t at, double w) { difference[other + at] += w; });
      for_each_face(3, box(x), axis, [&](std::size_t at, double w) { difference[other + at] -= w; });
    }
    for (const auto& [at, by] : difference) EXPECT_NEAR(by, 0, round_off) << at;
  }
  EXPECT_GT(compared, 100);
}

TEST(RoundWeights, OfMirrorImagesAreMirrorImages) {
  const core::Grid grid = core::grid_of(round_scene(9, 9).column, nullptr);
  const RoundWeights weights(grid);
  const auto cells = [&](const Vector& x, bool mirrored) {
    std::map<std::size_t, double> shares;
    const core::Index row = grid.extent(0);
    for_each_cell(3, weights(x), [&](std::size_t at, double w) {
      const core::Index i = core::Index(at) % row;
      shares[mirrored ? std::size_t(core::Index(at) - i + row - 1 - i) : at] += w;
    });
    return shares;
  };
  for (const Vector& x : places(500)) {
    const auto there = cells({diameter - x[0], x[1], x[2]}, true);
    for (const auto& [at, share] : cells(x, false)) {
      const auto found = there.find(at);
      EXPECT_NEAR(found == there.end() ? 0 : found->second, share, 1e-12) << at;
    }
  }
}

// The factors are fitted at 16 x 16 places in a cell, and 20 rounds leave some per cent, most in the faces of cells
// that are not square. The lattice here is twice as fine.
TEST(RoundWeights, OfParticlesThatLieEvenlyFillOpenVolumesEvenly) {
  for (const auto& cells : all_cells) {
    SCOPED_TRACE(testing::Message() << cells[0] << " x " << cells[1] << " cells");
    const core::Grid grid = core::grid_of(round_scene(cells[0], cells[1]).column, nullptr);
    const RoundWeights weights(grid);
    constexpr int points = 32;
    core::Field in_cells = core::make_field(grid);
    core::FaceField on_faces = core::make_face_field(grid);
    const double step_x = grid.spacing[0] / points, step_z = grid.spacing[2] / points;
    const double middle = 2.5 * grid.spacing[1];  // of the third layer, so that faces along y get halves
    for (int k = 0; k < cells[1] * points; ++k)
      for (int i = 0; i < cells[0] * points; ++i) {
        const Vector x{(i + 0.5) * step_x, middle, (k + 0.5) * step_z};
        if (std::hypot(x[0] - 0.5 * diameter, x[2] - 0.5 * diameter) > 0.5 * diameter) continue;
        const RoundShares shares = weights(x);
        for_each_cell(3, shares, [&](std::size_t at, double w) { in_cells[at] += w / (points * points); });
        for (int axis = 0; axis < 3; ++axis)
          for_each_face(3, shares, axis, [&](std::size_t at, double w) {
            on_faces[std::size_t(axis)][at] += (axis == 1 ? 2 : 1) * w / (points * points);
          });
      }
    for (int k = 0; k <= cells[1]; ++k)
      for (int i = 0; i <= cells[0]; ++i) {
        const auto at = std::size_t(grid.index(i, 2, k));
        EXPECT_NEAR(in_cells[at], grid.metric->volume[at], 0.03 * grid.metric->volume[at]) << i << ", " << k;
        for (std::size_t a = 0; a < 3; ++a) {
          const double volume = volume_on(grid, a, at);
          EXPECT_NEAR(on_faces[a][at], volume, 0.06 * volume) << "face of " << a << " at " << i << ", " << k;
        }
      }
  }
}

// Layers that the wall cuts unlike each other, and cells that a step closes. The lattice is finer than that of the fit,
// whose 10 rounds leave some per cent.
TEST(RoundWeights, OfParticlesThatLieEvenlyFillATaperedColumnEvenly) {
  for (const core::Scene& scene : {tapered_scene(false, 10), tapered_scene(false, 13), tapered_scene(true, 10)}) {
    const core::Grid grid = core::grid_of(scene.column, nullptr);
    const RoundWeights weights(grid);
    constexpr int points = 12;
    core::Field in_cells = core::make_field(grid);
    core::FaceField on_faces = core::make_face_field(grid);
    const auto each = [&](int axis) { return grid.cells[std::size_t(axis)] * points; };
    for (int k = 0; k < each(2); ++k)
      for (int j = 0; j < each(1); ++j)
        for (int i = 0; i < each(0); ++i) {
          const Vector x{(i + 0.5) * grid.spacing[0] / points, (j + 0.5) * grid.spacing[1] / points,
                         (k + 0.5) * grid.spacing[2] / points};
          if (std::hypot(x[0] - 0.5 * diameter, x[2] - 0.5 * diameter) > 0.5 * scene.column.diameter_at(x[1])) continue;
          const RoundShares shares = weights(x);
          constexpr double part = 1.0 / (points * points * points);
          for_each_cell(3, shares, [&](std::size_t at, double w) { in_cells[at] += w * part; });
          for (int axis = 0; axis < 3; ++axis)
            for_each_face(3, shares, axis,
                          [&](std::size_t at, double w) { on_faces[std::size_t(axis)][at] += w * part; });
        }
    double off_cells = 0, off_faces = 0;
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 0; i < grid.cells[0]; ++i) {
          const auto at = std::size_t(grid.index(i, j, k));
          if (grid.metric->volume[at] > 0)
            off_cells = std::max(off_cells, std::abs(in_cells[at] / grid.metric->volume[at] - 1));
          for (std::size_t a = 0; a < 3; ++a)
            if (const double volume = volume_on(grid, a, at); volume > 0)
              off_faces = std::max(off_faces, std::abs(on_faces[a][at] / volume * (a == 1 && j == 0 ? 2 : 1) - 1));
        }

    EXPECT_LT(off_cells, 0.06);
    EXPECT_LT(off_faces, 0.1);
  }
}

/// A plate across most of a box of 12 by 12 cells, as thin as it may be: level, or rising by a tenth or as much as
/// wide.
struct Plate {
  core::Column column;
  core::InsideWalls walls;
  double rise;

  explicit Plate(double slope) : rise(slope) {
    column.dimensions = 2;
    column.size = {12, 12, 1};
    column.cells = {12, 12, 1};
    const double thickness = (1 + slope) / std::hypot(1, slope), low = 5.5 - 4 * slope;
    walls = std::make_shared<const std::vector<core::InnerWall>>(
        1, core::InnerWall{{2, low}, {10, low + 8 * slope}, core::WallShape::flat, thickness});
  }
  [[nodiscard]] double above(const Vector& x) const { return x[1] - 5.5 - rise * (x[0] - 6); }
};

// Cells on the other side of a plate get nothing from a particle, nor do faces without an open cell on its side.
TEST(RoundWeights, EndAtAThinPlate) {
  for (const double slope : {0.0, 0.1, 1.0}) {
    SCOPED_TRACE(slope);
    const Plate plate(slope);
    const core::Grid grid = core::grid_of(plate.column, nullptr, plate.walls);
    const core::InnerWalls walls(*plate.walls, plate.column.size, false);
    const RoundWeights weights(grid);
    std::vector<Vector> centre(grid.padded_size());
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i) centre[std::size_t(grid.index(i, j))] = {i + 0.5, j + 0.5, 0.5};
    int near = 0;
    for (int n = 0; n < 4000; ++n) {
      const Vector x{5 + 0.01 * (n * 37 % 200), 12 * double(n) / 4000, 0.5};
      const double distance = walls.nearest(x).distance;
      if (!(distance > 0)) continue;
      near += distance < 0.5 ? 1 : 0;
      const bool above = plate.above(x) > 0;
      const RoundShares shares = weights(x);
      double sum = 0;
      for_each_cell(2, shares, [&](std::size_t at, double w) {
        sum += w;
        EXPECT_TRUE(w < 1e-12 || (plate.above(centre[at]) > 0) == above) << x[0] << ' ' << x[1];
      });
      EXPECT_NEAR(sum, 1, round_off);
      for (const int axis : {0, 1})
        for_each_face(2, shares, axis, [&](std::size_t at, double w) {
          const std::size_t low = at - std::size_t(grid.stride(axis));
          const auto is_here = [&](std::size_t c) {
            return grid.metric->volume[c] > 0 && (plate.above(centre[c]) > 0) == above;
          };
          EXPECT_TRUE(w < 1e-12 || is_here(at) || is_here(low)) << axis << ' ' << x[0] << ' ' << x[1];
        });
    }
    EXPECT_GT(near, 100);
  }
}

// On the closed faces of a shallow plate particles see the flow along it, on either side its own.
TEST(RoundWeights, SeeTheFlowAlongAShallowPlate) {
  const Plate plate(0.1);
  const core::Grid grid = core::grid_of(plate.column, nullptr, plate.walls);
  const core::InnerWalls walls(*plate.walls, plate.column.size, false);
  core::Field along = core::make_field(grid);
  core::for_each_row(grid, core::interior_faces(grid, 0), [&](core::Index begin, core::Index end) {
    for (core::Index f = begin; f < end; ++f) {
      const auto row = double(f / grid.stride(1) - core::Grid::halo), column = double(f % grid.stride(1) - 2);
      along[std::size_t(f)] = plate.above({column, row + 0.5, 0.5}) > 0 ? 1 : -1;
    }
  });
  core::FaceField velocity{along, core::make_field(grid), {}};
  core::hold_closed(grid, velocity);
  const fluid::Boundaries boundaries(grid, fluid::Ends::walls);
  const core::Field seen = fluid::slipping(grid, boundaries, velocity[0], 0, grid.metric->steps_inside);
  const RoundWeights weights(grid);
  double slowest = 1;
  for (int n = 0; n < 4000; ++n) {
    const Vector x{4 + 0.01 * (n * 37 % 400), 4 + 3 * double(n) / 4000, 0.5};
    if (!(walls.nearest(x).distance > 0)) continue;
    double u = 0;
    for_each_face(2, weights(x), 0, [&](std::size_t at, double w) { u += w * seen[at]; });
    slowest = std::min(slowest, plate.above(x) > 0 ? u : -u);
  }
  EXPECT_NEAR(slowest, 1, 1e-12);
}

/// Particles in a round column, with random velocities and impulses.
Cloud round_cloud(const core::Scene& scene) {
  Cloud cloud(scene);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> speed(-0.1, 0.1);
  for (const Vector& x : places(300, scene.column)) {
    cloud.add(0, x, {speed(random), speed(random), speed(random)});
    for (double& i : cloud.loads.back().impulse) i = 1e-7 * speed(random);
  }
  return cloud;
}

struct Phase {
  fluid::ParticlePhase phase;
  std::vector<core::Field> fraction;
};

Phase give(const Cloud& cloud) {
  Scatter scatter(cloud.grid, cloud.grid, cloud.materials, false, cloud.volume, 0.2);
  Phase given{fluid::ParticlePhase(cloud.grid, false), {core::make_field(cloud.grid), core::make_field(cloud.grid)}};
  scatter.collect(cloud.particles, cloud.loads, 1e-3);
  scatter.give(nullptr, nullptr, false, given.phase, given.fraction);
  return given;
}

TEST(RoundWeights, GiveAllOfTheParticlesVolume) {
  for (const core::Scene& scene : all_scenes()) {
    const Cloud cloud = round_cloud(scene);
    const Phase given = give(cloud);
    double volume = 0;
    for (std::size_t c = 0; c < given.fraction[0].size(); ++c) {
      volume += cloud.grid.metric->volume[c] * given.fraction[0][c];
      EXPECT_TRUE(cloud.grid.metric->volume[c] > 0 || given.phase.voidage[c] == 1);
    }
    EXPECT_NEAR(volume * cloud.grid.cell_volume(), cloud.volume, 1e-12 * cloud.volume);
    for (std::size_t a = 0; a < 3; ++a)
      for (const core::Index f : cloud.grid.metric->closed[a]) {
        EXPECT_EQ(given.phase.voidage_on[a][std::size_t(f)], 1);
        EXPECT_EQ(given.phase.impulse[a][std::size_t(f)], 0);
      }
  }
}

// What the fluid loses to the particles, times any velocity that is at rest on closed faces, is what they get of it.
TEST(RoundWeights, TakeWhatTheyGive) {
  for (const core::Scene& scene : all_scenes()) {
    const Cloud cloud = round_cloud(scene);
    const Phase given = give(cloud);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> value(-1, 1);
    core::FaceField field = core::make_face_field(cloud.grid);
    for (core::Field& component : field)
      for (double& x : component) x = value(random);
    core::hold_closed(cloud.grid, field);
    const Gather gather(cloud.grid, {0.5e-3, 1.1e-3});
    for (std::size_t a = 0; a < 3; ++a) {
      double lost = 0, got = 0, size = 0;
      for (std::size_t f = 0; f < field[a].size(); ++f)
        lost += volume_on(cloud.grid, a, f) * given.phase.impulse[a][f] * field[a][f] * cloud.grid.cell_volume();
      for (std::size_t i = 0; i < cloud.particles.owned; ++i) {
        const double work =
            cloud.loads[i].impulse[a] * gather.vector(gather.shares<true>(cloud.particles.place[i].x), field)[a];
        got += work;
        size += std::abs(work);
      }
      // Units of the sums: 2^-61 of the momentum of all at 64 times 0.2 m/s, one for each particle and face.
      EXPECT_NEAR(lost, got, 1e-10 * size) << a;
    }
  }
}

}  // namespace
}  // namespace polybed::dem::test
