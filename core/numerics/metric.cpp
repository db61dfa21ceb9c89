#include "core/numerics/metric.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/numerics/blocks.hpp"

namespace polybed::core {

namespace {

/// Area of a disc about the origin where X <= x and Z <= z.
class Disc {
 public:
  explicit Disc(double radius) : radius_(radius) {}

  [[nodiscard]] double below(double x, double z) const {
    x = std::clamp(x, -radius_, radius_);
    z = std::clamp(z, -radius_, radius_);
    return z < 0 ? half(x) - capped(x, -z) : half(x) + capped(x, z);
  }
  /// Length of the chord at a distance from the centre that lies between two places on it.
  [[nodiscard]] double chord(double distance, double from, double to) const {
    const double reach = radius_ * radius_ - distance * distance;
    if (!(reach > 0)) return 0;
    const double most = std::sqrt(reach);
    return std::max(0.0, std::min(to, most) - std::max(from, -most));
  }

 private:
  /// Integral of sqrt(R^2 - t^2) from -R to x.
  [[nodiscard]] double half(double x) const {
    const double inside = std::max(radius_ * radius_ - x * x, 0.0);
    return 0.5 * (x * std::sqrt(inside) + radius_ * radius_ * (std::asin(x / radius_) + 0.5 * std::numbers::pi));
  }
  /// The same of min(h, sqrt(R^2 - t^2)).
  [[nodiscard]] double capped(double x, double h) const {
    const double w = std::sqrt(std::max(radius_ * radius_ - h * h, 0.0));
    if (x <= -w) return half(x);
    if (x <= w) return half(-w) + h * (x + w);
    return half(-w) + 2 * h * w + (half(x) - half(w));
  }

  double radius_;
};

/// A cell with less of its volume open becomes part of its neighbour: no small cell limits a step, and the centre of
/// what is left lies inside the wall.
constexpr double least_volume = 0.5;

/// Gives a small cell's volume to the neighbour across its largest face, or in equal parts across two alike, and closes
/// it.
void absorb(CrossSection& section, int i, int k) {
  struct Side {
    double* open;
    int i, k;
  };
  const std::array<Side, 4> sides{Side{&section.x_face(i, k), i - 1, k},
                                  {&section.x_face(i + 1, k), i + 1, k},
                                  {&section.z_face(i, k), i, k - 1},
                                  {&section.z_face(i, k + 1), i, k + 1}};
  double most = 0;
  for (const Side& side : sides) most = std::max(most, *side.open);
  const auto alike = [most](const Side& side) { return *side.open > 0 && *side.open > (1 - 1e-9) * most; };
  const auto takers = double(std::count_if(sides.begin(), sides.end(), alike));
  for (const Side& side : sides)
    if (alike(side)) section.volume_of(side.i, side.k) += section.volume_of(i, k) / takers;
  for (const Side& side : sides) *side.open = 0;
  section.volume_of(i, k) = 0;
}

/// From the outside in, so that what a small cell takes goes on with its own.
void absorb_small_cells(CrossSection& section) {
  std::vector<std::array<int, 3>> small;  // distance from the centre in half cells, squared; i; k
  for (int k = 0; k < section.depth; ++k)
    for (int i = 0; i < section.width; ++i) {
      const int x = 2 * i + 1 - section.width, z = 2 * k + 1 - section.depth;
      if (section.volume_of(i, k) < least_volume) small.push_back({-(x * x + z * z), i, k});
    }
  std::sort(small.begin(), small.end());
  for (const auto& [distance, i, k] : small)
    if (section.volume_of(i, k) < least_volume) absorb(section, i, k);
}

/// A disc as wide as the grid, cut out of its cells: areas and chords are exact.
CrossSection round_section(const Grid& column) {
  const int nx = column.cells[0], nz = column.cells[2];
  const double hx = column.spacing[0], hz = column.spacing[2], radius = 0.5 * nx * hx;
  const Disc disc(radius);
  const auto x = [&](int i) { return i * hx - radius; };
  const auto z = [&](int k) { return k * hz - radius; };
  CrossSection section{nx, nz, {}, {}, {}, {}, {}};
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i)
      section.volume.push_back(((disc.below(x(i + 1), z(k + 1)) - disc.below(x(i), z(k + 1))) -
                                (disc.below(x(i + 1), z(k)) - disc.below(x(i), z(k)))) /
                               (hx * hz));
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i <= nx; ++i) section.open_x.push_back(disc.chord(x(i), z(k), z(k + 1)) / hz);
  for (int k = 0; k <= nz; ++k)
    for (int i = 0; i < nx; ++i) section.open_z.push_back(disc.chord(z(k), x(i), x(i + 1)) / hx);
  absorb_small_cells(section);
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i) {
      const double theta = section.volume_of(i, k);
      const double to_x = section.x_face(i, k) - section.x_face(i + 1, k);
      const double to_z = section.z_face(i, k) - section.z_face(i, k + 1);
      const double area = std::hypot(to_x / hx, to_z / hz);  // over the whole cell's volume, 1/m
      if (!(theta > 0) || area * std::min(hx, hz) < 1e-9) {
        section.wall.push_back(0);
        continue;
      }
      const double to_centre = std::hypot(x(i) + 0.5 * hx, z(k) + 0.5 * hz);
      const double distance = std::max(radius - to_centre, 0.1 * std::min(hx, hz));  // or it would limit steps
      section.wall.push_back(area / (distance * theta));
    }
  return section;
}

/// Rings about the low end along x.
CrossSection ring_section(const Grid& column) {
  const int n = column.cells[0];
  CrossSection section{n, 1, {}, {}, {}, std::vector<double>(std::size_t(n), 0.0), {}};
  for (int i = 0; i < n; ++i) section.volume.push_back((2.0 * i + 1) / n);
  for (int i = 0; i <= n; ++i) {
    section.open_x.push_back(2.0 * i / n);
    section.radius.push_back(i * column.spacing[0]);
  }
  return section;
}

/// Fills what of the padded box lies in the column, and the rows beyond its bottom and top as those beside them.
class Spreading {
 public:
  Spreading(const Grid& grid, Metric& metric) : grid_(grid), metric_(metric), section_(metric.section) {}

  void fill() {
    const int gx = grid_.ghosts(0), gy = grid_.ghosts(1), gz = grid_.ghosts(2);
    for (int k = -gz; k < grid_.cells[2] + gz; ++k)
      for (int j = -gy; j < grid_.cells[1] + gy; ++j)
        for (int i = -gx; i < grid_.cells[0] + gx; ++i) set_cell(grid_.index(i, j, k), i, k);
    for (int k = -gz; k < grid_.cells[2] + gz; ++k)
      for (int j = -gy; j < grid_.cells[1] + gy; ++j)
        for (int i = -gx; i < grid_.cells[0] + gx; ++i)
          for (int axis = 0; axis < grid_.dimensions; ++axis)
            if ((axis == 0 ? i : axis == 1 ? j : k) > -grid_.ghosts(axis))
              set_momentum(grid_.index(i, j, k), axis, i, k);
  }

 private:
  void set_cell(Index c, int i, int k) {
    const int x = i + grid_.before[0], z = k + grid_.before[2];
    const bool across = x >= 0 && x < section_.width, along = z >= 0 && z < section_.depth;
    const double theta = across && along ? section_.volume[section_.at(x, z)] : 0;
    const auto at = std::size_t(c);
    metric_.volume[at] = metric_.open[1][at] = theta;
    metric_.per_volume[at] = theta > 0 ? 1 / theta : 0;
    if (along && x >= 0 && x <= section_.width)
      metric_.open[0][at] = section_.open_x[std::size_t(x + (section_.width + 1) * z)];
    if (grid_.dimensions == 3 && across && z >= 0 && z <= section_.depth)
      metric_.open[2][at] = section_.open_z[std::size_t(x + section_.width * z)];
    if (section_.radius.empty() || x < 0 || x > section_.width) return;
    const double h = grid_.spacing[0];
    metric_.per_radius[at] = 1 / (section_.radius[std::size_t(x)] + 0.5 * h);
    metric_.per_radius_on[at] = x > 0 ? 1 / section_.radius[std::size_t(x)] : 0;
  }

  void set_momentum(Index c, int axis, int i, int k) {
    const auto a = std::size_t(axis), at = std::size_t(c), low = std::size_t(c - grid_.stride(axis));
    const double both = metric_.volume[low] + metric_.volume[at];
    if (both > 0) metric_.per_volume_on[a][at] = 2 / both;
    if (!(metric_.open[a][at] > 0)) {
      metric_.closed[a].push_back(c);
      return;
    }
    const auto wall = [&](std::size_t cell, int x, int z) {
      x += grid_.before[0];
      z += grid_.before[2];
      const bool inside = x >= 0 && x < section_.width && z >= 0 && z < section_.depth;
      return inside ? section_.wall[section_.at(x, z)] * metric_.volume[cell] : 0.0;
    };
    metric_.wall[a][at] = (wall(at, i, k) + wall(low, i - (axis == 0 ? 1 : 0), k - (axis == 2 ? 1 : 0))) / both;
  }

  const Grid& grid_;
  Metric& metric_;
  const CrossSection& section_;
};

}  // namespace

std::shared_ptr<const Metric> metric_of(const Grid& grid, ColumnShape shape) {
  if (shape == ColumnShape::box) return nullptr;
  auto metric = std::make_shared<Metric>();
  const Grid column = whole_column(grid);
  metric->around_axis = shape == ColumnShape::axisymmetric;
  metric->section = metric->around_axis ? ring_section(column) : round_section(column);
  for (Field* field : {&metric->volume, &metric->per_volume, &metric->per_radius, &metric->per_radius_on})
    *field = make_field(grid);
  for (FaceField* field : {&metric->open, &metric->per_volume_on, &metric->wall}) *field = make_face_field(grid);
  Spreading(grid, *metric).fill();
  return metric;
}

double open_cells_of_layer(const Grid& grid) {
  if (!grid.metric) return double(grid.column_cells(0)) * grid.column_cells(2);
  const std::vector<double>& volume = grid.metric->section.volume;
  return std::accumulate(volume.begin(), volume.end(), 0.0);
}

void weigh_faces(const Grid& grid, FaceField& coefficient) {
  if (!grid.metric) return;
  constexpr double leak = 1e-9;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const Field& open = grid.metric->open[std::size_t(axis)];
    Field& field = coefficient[std::size_t(axis)];
    for (std::size_t f = 0; f < field.size(); ++f) field[f] *= open[f] > 0 ? open[f] : leak;
  }
}

void weigh_cells(const Grid& grid, Field& source) {
  if (!grid.metric) return;
  for (std::size_t c = 0; c < source.size(); ++c) source[c] *= grid.metric->volume[c];
}

void hold_closed(const Grid& grid, FaceField& faces) {
  if (!grid.metric) return;
  for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a)
    for (const Index f : grid.metric->closed[a]) faces[a][std::size_t(f)] = 0;
}

}  // namespace polybed::core
