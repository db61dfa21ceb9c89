// The open parts of a grid's equal cells: where the wall of a round column or walls inside cut them, or where they lie
// around an axis; and the sides of cells where these are graded.
//
// The open volume of a cell is theta V and the open area of a face alpha A, with V and A of a whole cell and face:
//
//   theta_c h dphi/dt = -sum alpha_f phi_f U_f,   sum alpha_f J_f = 0.
//
// A face's momentum has the mean volume of its two cells, so that its convection telescopes. Around an axis alpha and
// theta grow with the radius; a box as wide as the radius and pi times as deep has the column's area.
//
// A graded layer is a times as high as the lowest: theta and the alpha of its upright faces are multiplied by a, which
// makes every sum of fluxes exact. Differences along the height between centres are divided by the mean of both a.
// The same holds across a flat box that is graded towards its walls.
//
// The pressure at a wall is that in its cell. It acts on the closed area of the cell's faces and leaves theta grad p:
// an even pressure pushes nothing, and a bed rests in a cone as it does in a box.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "core/case/choices.hpp"
#include "core/numerics/field.hpp"

namespace polybed::core {

/// Height and diameter of a column, m: core::Column::profile.
using Taper = std::vector<std::pair<double, double>>;

/// The whole column, in one layer of cells; x runs fastest.
struct CrossSection {
  int width = 0, depth = 0;    ///< cells along x and z
  std::vector<double> volume;  ///< theta; 0: closed
  std::vector<double> open_y;  ///< alpha of the low faces along y
  std::vector<double> open_x;  ///< alpha of the low faces along x, width + 1 a row
  std::vector<double> open_z;  ///< and along z, depth + 1 rows; empty in two dimensions
  std::vector<double> wall;    ///< for curved walls: area over distance and open volume, 1/m2
  std::vector<double> radius;  ///< of the low faces along x, m; empty unless the cells lie around an axis
  std::array<std::vector<double>, 3> wall_along{};  ///< as wall, of walls inside, for each velocity; empty without

  [[nodiscard]] double& volume_of(int i, int k) { return volume[at(i, k)]; }
  [[nodiscard]] double& x_face(int i, int k) { return open_x[std::size_t(i + (width + 1) * k)]; }
  [[nodiscard]] double& z_face(int i, int k) { return open_z[std::size_t(i + width * k)]; }
  /// alpha of the low face of a cell along an axis.
  [[nodiscard]] double face(int axis, int i, int k) const {
    if (axis == 1) return open_y[at(i, k)];
    return axis == 0 ? open_x[std::size_t(i + (width + 1) * k)] : open_z[at(i, k)];
  }
  [[nodiscard]] std::size_t at(int i, int k) const { return std::size_t(i) + std::size_t(width) * std::size_t(k); }
};

/// A horizontal duct through which a port in the side of a cylinder meets the curved wall. The cells that it covers, at
/// least in part, are open from the side of the box to the inside.
struct Duct {
  int axis = 0, side = 0;
  std::array<double, 2> from{}, to{};  ///< across it along the other horizontal axis, and upward, m
  bool operator==(const Duct&) const = default;
};
using Ducts = std::vector<Duct>;

struct InnerWall;
/// Walls inside a column; null without.
using InsideWalls = std::shared_ptr<const std::vector<InnerWall>>;

struct Metric {
  ColumnShape shape = ColumnShape::box;
  InsideWalls walls;
  std::vector<CrossSection> layers;  ///< from the bottom; one entry: all alike; else one more for the top
  Taper taper;
  Ducts ducts;                               ///< of a cylinder
  Field volume;                              ///< theta
  Field per_volume;                          ///< 1/theta; 0 where closed
  FaceField open;                            ///< alpha; 0 where closed
  FaceField per_volume_on;                   ///< 1 over the volume of a face's momentum
  FaceField wall;                            ///< no-slip at a curved wall: damping over the kinematic viscosity, 1/m2
  Field per_radius;                          ///< 1/r of cells, 1/m; 0 in a box and a cylinder
  Field per_radius_on;                       ///< and of faces along x
  FaceField per_length;                      ///< 1/a of the cell's layer along each axis; 1 unless graded
  FaceField per_distance;                    ///< of the centres across a face, in least cells: 2/(a + a)
  bool around_axis = false;                  ///< the low end along x is an axis, without a wall
  std::array<std::vector<Index>, 3> closed;  ///< faces of the padded box without an open part
  /// Owned faces closed by walls that cut the grid into steps: by walls inside, and by these or a taper.
  std::array<std::vector<Index>, 3> steps_inside, steps;

  [[nodiscard]] bool tapered() const { return layers.size() > 1; }
  /// Whether a wall cuts cells.
  [[nodiscard]] bool cut() const { return shape == ColumnShape::cylinder || tapered(); }
  /// The cross-section of a layer of the column, and the one on whose low faces a layer of faces lies. Beyond the ends
  /// the outermost one.
  [[nodiscard]] const CrossSection& layer(int y) const { return layers[clamped(y, 2)]; }
  [[nodiscard]] const CrossSection& level(int y) const { return layers[clamped(y, 1)]; }

 private:
  [[nodiscard]] std::size_t clamped(int y, int from_end) const {
    return std::size_t(std::clamp(y, 0, std::max(int(layers.size()) - from_end, 0)));
  }
};

/// Metric of a block or of the whole column, from the shape of its column; null for a box of even layers without walls
/// inside.
[[nodiscard]] std::shared_ptr<const Metric> metric_of(const Grid& grid, ColumnShape shape, const Taper& taper = {},
                                                      const InsideWalls& walls = nullptr, const Ducts& ducts = {});

/// Equal cells: the compiler removes it from a kernel.
struct UniformMetric {
  static constexpr bool radial = false;
  static constexpr double volume(Index) { return 1; }
  static constexpr double per_volume(Index) { return 1; }
  static constexpr double open(std::size_t, Index) { return 1; }
  static constexpr double per_volume_on(std::size_t, Index) { return 1; }
  static constexpr double per_length(std::size_t, Index) { return 1; }
  static constexpr double per_distance(std::size_t, Index) { return 1; }
};

/// Metric of a round or graded column, or of one with walls inside.
class GeneralMetric {
 public:
  static constexpr bool radial = true;  ///< there can be an axis; in a cylinder its terms are 0
  explicit GeneralMetric(const Metric& metric)
      : volume_(metric.volume.data()),
        per_volume_(metric.per_volume.data()),
        per_radius_(metric.per_radius.data()),
        per_radius_on_(metric.per_radius_on.data()) {
    for (std::size_t a = 0; a < 3; ++a) {
      open_[a] = metric.open[a].data();
      per_volume_on_[a] = metric.per_volume_on[a].data();
      per_length_[a] = metric.per_length[a].data();
      per_distance_[a] = metric.per_distance[a].data();
    }
  }
  [[nodiscard]] double volume(Index c) const { return volume_[c]; }
  [[nodiscard]] double per_volume(Index c) const { return per_volume_[c]; }
  [[nodiscard]] double open(std::size_t axis, Index f) const { return open_[axis][f]; }
  [[nodiscard]] double per_volume_on(std::size_t axis, Index f) const { return per_volume_on_[axis][f]; }
  /// 1 over the length of a cell along an axis, and over the distance of the centres across a face, in grid spacings.
  [[nodiscard]] double per_length(std::size_t axis, Index c) const { return per_length_[axis][c]; }
  [[nodiscard]] double per_distance(std::size_t axis, Index f) const { return per_distance_[axis][f]; }
  [[nodiscard]] double per_radius(Index c) const { return per_radius_[c]; }
  [[nodiscard]] double per_radius_on(Index f) const { return per_radius_on_[f]; }

 private:
  const double *volume_, *per_volume_, *per_radius_, *per_radius_on_;
  std::array<const double*, 3> open_{}, per_volume_on_{}, per_length_{}, per_distance_{};
};

/// Calls act(UniformMetric) or act(GeneralMetric), for loops that are compiled for each.
template <class Act>
void with_metric(const Grid& grid, Act&& act) {
  grid.metric ? act(GeneralMetric(*grid.metric)) : act(UniformMetric());
}

/// Calls body(begin, end) for the rows of a box without the closed cells at their ends. What no flux can reach keeps
/// its value.
template <class Body>
void for_each_open_row(const Grid& grid, const Box& box, Body&& body) {
  for_each_row(grid, box, [&](Index begin, Index end) {
    if (grid.metric) {
      const double* volume = grid.metric->volume.data();
      while (begin < end && volume[begin] == 0) ++begin;
      while (begin < end && volume[end - 1] == 0) --end;
    }
    if (begin < end) body(begin, end);
  });
}

/// Open volume of a layer of the column, in lowest cells, and open area of the faces below it, in whole faces.
[[nodiscard]] double open_cells_of_layer(const Grid& grid, int layer = 0);
[[nodiscard]] double open_faces_below(const Grid& grid, int layer);
/// Open areas of the layers of a column whose cross-section changes, by a taper or walls inside, m2; else empty.
[[nodiscard]] std::vector<double> areas_of_layers(const Grid& grid);

/// Multiplies face coefficients and a cell source by their open shares, over the distances of centres: the elliptic
/// solvers assume equal cells. Closed faces between cells keep a billionth, so that no cell is isolated.
void weigh_faces(const Grid& grid, FaceField& coefficient);
void weigh_cells(const Grid& grid, Field& source);

/// Sets a field on faces to 0 where a wall closes them.
void hold_closed(const Grid& grid, FaceField& faces);

}  // namespace polybed::core
