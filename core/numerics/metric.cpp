#include "core/numerics/metric.hpp"

#include <algorithm>
#include <numeric>

#include "core/numerics/blocks.hpp"
#include "core/numerics/cross_sections.hpp"
#include "core/numerics/inner_walls.hpp"

namespace polybed::core {

namespace {

/// Fills the entries of the padded box in the column, and copies its bottom and top rows to the rows beyond.
class Spreading {
 public:
  /// \param uncut  the layers without walls inside
  Spreading(const Grid& grid, const std::vector<CrossSection>& uncut, Metric& metric)
      : grid_(grid), uncut_(uncut), metric_(metric) {}

  void fill() {
    const int gx = grid_.ghosts(0), gy = grid_.ghosts(1), gz = grid_.ghosts(2);
    for (int k = -gz; k < grid_.cells[2] + gz; ++k)
      for (int j = -gy; j < grid_.cells[1] + gy; ++j)
        for (int i = -gx; i < grid_.cells[0] + gx; ++i) set_cell(grid_.index(i, j, k), i, j, k);
    for (int k = -gz; k < grid_.cells[2] + gz; ++k)
      for (int j = -gy; j < grid_.cells[1] + gy; ++j)
        for (int i = -gx; i < grid_.cells[0] + gx; ++i)
          for (int axis = 0; axis < grid_.dimensions; ++axis)
            if ((axis == 0 ? i : axis == 1 ? j : k) > -grid_.ghosts(axis))
              set_momentum(grid_.index(i, j, k), axis, i, j, k);
  }

 private:
  void set_cell(Index c, int i, int j, int k) {
    int x = i + grid_.before[0], y = j + grid_.before[1], z = k + grid_.before[2];
    const CrossSection& section = metric_.layer(y);
    if (metric_.shape == ColumnShape::box) {  // as open beyond its sides
      x = std::clamp(x, 0, section.width - 1);
      z = std::clamp(z, 0, section.depth - 1);
    }
    const double a = grid_.height(y) / grid_.spacing[1];
    const bool across = x >= 0 && x < section.width, along = z >= 0 && z < section.depth;
    const double theta = across && along ? a * section.volume[section.at(x, z)] : 0;
    const auto at = std::size_t(c);
    metric_.volume[at] = theta;
    metric_.per_volume[at] = theta > 0 ? 1 / theta : 0;
    for (int axis = 0; axis < grid_.dimensions; ++axis) {
      const int n = std::array{i, j, k}[std::size_t(axis)] + grid_.before[std::size_t(axis)];
      const double h = grid_.spacing[std::size_t(axis)], own = grid_.side(axis, n) / h,
                   low = grid_.side(axis, n - 1) / h;
      metric_.per_length[std::size_t(axis)][at] = 1 / own;
      metric_.per_distance[std::size_t(axis)][at] = 2 / (low + own);
    }
    metric_.open[1][at] = across && along ? metric_.level(y).open_y[section.at(x, z)] : 0;
    if (along && x >= 0 && x <= section.width)
      metric_.open[0][at] = a * section.open_x[std::size_t(x + (section.width + 1) * z)];
    if (grid_.dimensions == 3 && across && z >= 0 && z <= section.depth)
      metric_.open[2][at] = a * section.open_z[std::size_t(x + section.width * z)];
    if (section.radius.empty() || x < 0 || x > section.width) return;
    const double h = grid_.spacing[0];
    metric_.per_radius[at] = 1 / (section.radius[std::size_t(x)] + 0.5 * h);
    metric_.per_radius_on[at] = x > 0 ? 1 / section.radius[std::size_t(x)] : 0;
  }

  void set_momentum(Index c, int axis, int i, int j, int k) {
    const auto a = std::size_t(axis), at = std::size_t(c), low = std::size_t(c - grid_.stride(axis));
    const double both = metric_.volume[low] + metric_.volume[at];
    if (both > 0) metric_.per_volume_on[a][at] = 2 / both;
    if (!(metric_.open[a][at] > 0)) {
      metric_.closed[a].push_back(c);
      if (i >= 0 && j >= 0 && k >= 0 && i < grid_.cells[0] + (axis == 0 ? 1 : 0) &&
          j < grid_.cells[1] + (axis == 1 ? 1 : 0) && k < grid_.cells[2] + (axis == 2 ? 1 : 0))
        add_step(c, axis, i + grid_.before[0], j + grid_.before[1], k + grid_.before[2]);
      return;
    }
    const auto wall = [&](std::size_t cell, int x, int y, int z) {
      const CrossSection& section = metric_.layer(y + grid_.before[1]);
      x += grid_.before[0];
      z += grid_.before[2];
      const bool inside = x >= 0 && x < section.width && z >= 0 && z < section.depth;
      if (!inside) return 0.0;
      const std::size_t of = section.at(x, z);
      return (section.wall[of] + (section.wall_along[a].empty() ? 0 : section.wall_along[a][of])) *
             metric_.volume[cell];
    };
    metric_.wall[a][at] =
        (wall(at, i, j, k) + wall(low, i - (axis == 0 ? 1 : 0), j - (axis == 1 ? 1 : 0), k - (axis == 2 ? 1 : 0))) /
        both;
  }

  /// \param x, y, z  of a closed face in the column
  void add_step(Index f, int axis, int x, int y, int z) {
    const auto a = std::size_t(axis), last = uncut_.size() - (axis == 1 ? 1 : 2);
    const bool inside = metric_.walls && uncut_[std::min(std::size_t(y), last)].face(axis, x, z) > 0;
    if (inside) metric_.steps_inside[a].push_back(f);
    if (inside || !metric_.taper.empty()) metric_.steps[a].push_back(f);
  }

  const Grid& grid_;
  const std::vector<CrossSection>& uncut_;
  Metric& metric_;
};

/// A layer of a box.
CrossSection whole_section(const Grid& column) {
  const int nx = column.cells[0], nz = column.cells[2];
  const auto width = [&](int i) { return column.side(0, i) / column.spacing[0]; };
  const auto depth = [&](int k) { return column.side(2, k) / column.spacing[2]; };
  CrossSection section{nx, nz, {}, {}, {}, {}, std::vector<double>(std::size_t(nx * nz), 0.0), {}, {}};
  for (int k = 0; k < nz; ++k) {
    for (int i = 0; i < nx; ++i) section.volume.push_back(width(i) * depth(k));
    for (int i = 0; i <= nx; ++i) section.open_x.push_back(depth(k));
  }
  section.open_y = section.volume;
  for (int k = 0; column.dimensions == 3 && k <= nz; ++k)
    for (int i = 0; i < nx; ++i) section.open_z.push_back(width(i));
  return section;
}

/// Without walls inside.
std::vector<CrossSection> layers_of(const Grid& column, const Metric& metric) {
  if (metric.shape == ColumnShape::box) return {whole_section(column)};
  return cross_sections(column, metric.around_axis, metric.taper, metric.ducts);
}

/// \param uncut  the layers without the walls inside; receives an entry for each layer
std::vector<CrossSection> layers_between_walls(const Grid& column, const Metric& metric,
                                               std::vector<CrossSection>& uncut) {
  if (uncut.size() == 1) uncut.assign(std::size_t(column.cells[1]) + 1, CrossSection(uncut.front()));
  std::array<double, 3> size{};
  for (std::size_t a = 0; a < 3; ++a) size[a] = column.cells[a] * column.spacing[a];
  return cut_by_walls(column, InnerWalls(*metric.walls, size, metric.around_axis), metric.around_axis, uncut);
}

}  // namespace

std::shared_ptr<const Metric> metric_of(const Grid& grid, ColumnShape shape, const Taper& taper,
                                        const InsideWalls& walls, const Ducts& ducts) {
  if (shape == ColumnShape::box && !grid.layers && !grid.across[0] && !grid.across[1] && !walls) return nullptr;
  auto metric = std::make_shared<Metric>();
  const Grid column = whole_column(grid);
  metric->shape = shape;
  metric->around_axis = shape == ColumnShape::axisymmetric;
  metric->taper = taper;
  metric->ducts = ducts;
  metric->walls = walls;
  std::vector<CrossSection> uncut = layers_of(column, *metric);
  metric->layers = walls ? layers_between_walls(column, *metric, uncut) : uncut;
  for (Field* field : {&metric->volume, &metric->per_volume, &metric->per_radius, &metric->per_radius_on})
    *field = make_field(grid);
  for (FaceField* field :
       {&metric->open, &metric->per_volume_on, &metric->wall, &metric->per_length, &metric->per_distance})
    *field = make_face_field(grid);
  Spreading(grid, uncut, *metric).fill();
  return metric;
}

double open_cells_of_layer(const Grid& grid, int layer) {
  if (!grid.metric) return double(grid.column_cells(0)) * grid.column_cells(2);
  const std::vector<double>& volume = grid.metric->layer(layer).volume;
  return grid.height(layer) / grid.spacing[1] * std::accumulate(volume.begin(), volume.end(), 0.0);
}

double open_faces_below(const Grid& grid, int layer) {
  if (!grid.metric) return double(grid.column_cells(0)) * grid.column_cells(2);
  const std::vector<double>& open = grid.metric->level(layer).open_y;
  return std::accumulate(open.begin(), open.end(), 0.0);
}

std::vector<double> areas_of_layers(const Grid& grid) {
  std::vector<double> areas;
  if (grid.metric && grid.metric->tapered())
    for (int y = 0; y < grid.column_cells(1); ++y)
      areas.push_back(open_cells_of_layer(grid, y) / (grid.height(y) / grid.spacing[1]) * grid.spacing[0] *
                      grid.spacing[2]);
  return areas;
}

void weigh_faces(const Grid& grid, FaceField& coefficient) {
  if (!grid.metric) return;
  constexpr double leak = 1e-9;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const Field& open = grid.metric->open[std::size_t(axis)];
    Field& field = coefficient[std::size_t(axis)];
    const auto height = [&](std::size_t f) { return axis == 1 ? 1.0 : 1 / grid.metric->per_length[1][f]; };
    for (std::size_t f = 0; f < field.size(); ++f) field[f] *= open[f] > 0 ? open[f] : leak * height(f);
    const Field& per_distance = grid.metric->per_distance[std::size_t(axis)];
    for (std::size_t f = 0; grid.graded(axis) && f < field.size(); ++f) field[f] *= per_distance[f];
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
