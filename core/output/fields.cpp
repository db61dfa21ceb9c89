#include "core/output/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/blocks.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

const FileKind index_kind{"polybed fields", 1};
const FileKind step_kind{"polybed fields step", 1};
constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

std::vector<double> face_positions(const Grid& grid, int axis) {
  std::vector<double> faces;
  for (int i = 0; i <= grid.cells[std::size_t(axis)]; ++i) faces.push_back(grid.low(axis, i));
  return faces;
}

/// A cell field of the column in the file, with its components if there are any, and the place of the block in it.
Slab cell_slab(const Grid& grid, int components) {
  Slab slab;
  for (int axis = grid.dimensions - 1; axis >= 0; --axis) {
    slab.shape.push_back(std::size_t(grid.column_cells(axis)));
    slab.start.push_back(std::size_t(grid.before[std::size_t(axis)]));
    slab.count.push_back(std::size_t(grid.cells[std::size_t(axis)]));
  }
  if (components == 0) return slab;
  slab.shape.push_back(std::size_t(components));
  slab.start.push_back(0);
  slab.count.push_back(std::size_t(components));
  return slab;
}

[[noreturn]] void refuse(const std::string& name, int component, std::array<int, 3> cell, double value, double time) {
  throw NumericsError(fmt::format("{} (component {}) is {} in cell ({}, {}, {}) at t = {} s: not written", name,
                                  component, value, cell[0], cell[1], cell[2], time));
}

/// Throws NumericsError if a value of an owned cell is not finite.
void check_finite(const Grid& grid, const FieldName& field, const FieldValues& values, double time) {
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i)
        for (std::size_t a = 0; a < values.size(); ++a) {
          const double value = values[a][std::size_t(grid.index(i, j, k))];
          if (!std::isfinite(value))
            refuse(field.name, int(a), {i + grid.before[0], j + grid.before[1], k + grid.before[2]}, value, time);
        }
}

/// The owned cells of padded components, component fastest; missing components up to `components` are zero.
std::vector<double> packed(const Grid& grid, const FieldValues& values, int components) {
  std::vector<double> out;
  out.reserve(grid.cell_count() * std::size_t(components));
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i)
        for (int a = 0; a < components; ++a) {
          const bool given = std::size_t(a) < values.size();
          out.push_back(given ? values[std::size_t(a)][std::size_t(grid.index(i, j, k))] : 0);
        }
  return out;
}

BlockData cell_data(const Grid& grid, const std::string& name, const FieldValues& values, int components,
                    Packing packing) {
  BlockData data{name, cell_slab(grid, components), packing,
                 [&grid, &values, components] { return packed(grid, values, std::max(components, 1)); },
                 greatest_block(grid)};
  if (components > 0) data.chunk.push_back(std::size_t(components));
  return data;
}

void check_sizes(const Grid& grid, const FieldName& field, const FieldValues& values) {
  const std::size_t components = field.vector ? std::size_t(grid.dimensions) : 1;
  const bool fits = values.size() == components &&
                    std::all_of(values.begin(), values.end(), [&](auto v) { return v.size() == grid.padded_size(); });
  if (!fits) throw std::invalid_argument("the values of " + field.name + " do not fit the grid");
}

/// Whether ParaView gets its own copy: it shows only vectors with three components.
bool is_copied(const Grid& grid, const FieldName& field) { return field.sum || (field.vector && grid.dimensions == 2); }

std::vector<BlockData> step_data(const Grid& grid, std::span<const FieldName> names,
                                 std::span<const FieldValues> values) {
  std::vector<BlockData> data;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const FieldName& field = names[n];
    if (!field.sum)
      data.push_back(
          cell_data(grid, "step/" + field.name, values[n], field.vector ? grid.dimensions : 0, Packing::small));
    if (is_copied(grid, field))
      data.push_back(cell_data(grid, "paraview/" + field.name, values[n], field.vector ? 3 : 0, Packing::small_single));
  }
  return data;
}

/// Open volumes of cells over a whole cell's where a wall closes some: these contain no fluid although their voidage is
/// 1. Else empty.
std::vector<double> open_volumes(const Grid& grid) {
  if (!grid.metric) return {};
  std::vector<double> open = packed(grid, {grid.metric->volume}, 1);
  return std::count(open.begin(), open.end(), 0.0) > 0 ? open : std::vector<double>();
}

void write_grid(const Grid& grid, OutputFile& file) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> faces = face_positions(grid, axis);
    file.write(std::string("grid/") + axis_names[std::size_t(axis)], {faces.size()}, faces);
  }
  if (const std::vector<double> open = open_volumes(grid); !open.empty())
    file.write("grid/open", cell_slab(grid, 0).shape, open);
}

bool has_grid(const Grid& grid, const OutputFile& file) {
  for (int axis = 0; axis < 3; ++axis)
    if (file.read(std::string("grid/") + axis_names[std::size_t(axis)]).values != face_positions(grid, axis))
      return false;
  const std::vector<double> open = open_volumes(grid);
  return open.empty() || file.read("grid/open").values == open;
}

/// Numbers of cells per axis, slowest first, each plus `more`.
std::string dimensions(const Grid& grid, int more) {
  std::string text;
  for (int axis = grid.dimensions - 1; axis >= 0; --axis)
    text += fmt::format("{}{}", text.empty() ? "" : " ", grid.cells[std::size_t(axis)] + more);
  return text;
}

std::string data_item(const std::string& shape, int precision, const std::string& place) {
  return fmt::format(R"(<DataItem Dimensions="{}" NumberType="Float" Precision="{}" Format="HDF">{}</DataItem>)", shape,
                     precision, place);
}

std::string geometry(const Grid& grid) {
  const bool flat = grid.dimensions == 2;
  std::string text =
      fmt::format("        <Topology TopologyType=\"{}\" Dimensions=\"{}\"/>\n        <Geometry GeometryType=\"{}\">\n",
                  flat ? "2DRectMesh" : "3DRectMesh", dimensions(grid, 1), flat ? "VXVY" : "VXVYVZ");
  constexpr const char* axes = "xyz";
  for (int axis = 0; axis < grid.dimensions; ++axis)
    text += fmt::format("          {}\n", data_item(std::to_string(grid.cells[std::size_t(axis)] + 1), 8,
                                                    fmt::format("fields.h5:/grid/{}", axes[axis])));
  return text + "        </Geometry>\n";
}

std::string attribute(const Grid& grid, const FieldName& field, const std::string& file, const char* group = "step") {
  const std::string shape = dimensions(grid, 0);
  const bool copied = is_copied(grid, field);
  const std::string item = data_item(field.vector ? shape + " 3" : shape, copied ? 4 : 8,
                                     fmt::format("{}:/{}/{}", file, copied ? "paraview" : group, field.name));
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Cell\">\n          {}\n"
      "        </Attribute>\n",
      field.name, field.vector ? "Vector" : "Scalar", item);
}

/// XDMF 3.0, for ParaView: a temporal collection of rectilinear grids, one per stored step.
std::string fields_xdmf(const Grid& grid, std::span<const FieldName> names, std::span<const double> times) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"fields\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const std::string mesh = geometry(grid);
  const std::string open = open_volumes(grid).empty() ? "" : attribute(grid, {"open"}, "fields.h5", "grid");
  for (std::size_t step = 0; step < times.size(); ++step) {
    text += fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n",
                        step_name(step), times[step]);
    text += mesh;
    for (const FieldName& field : names) text += attribute(grid, field, fmt::format("fields/{}.h5", step_name(step)));
    text += open;
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

StepSeries fields_series(const Grid& grid, const std::vector<FieldName>& names) {
  return {"fields",
          index_kind,
          [grid](OutputFile& file) { write_grid(grid, file); },
          [grid](const OutputFile& file) { return has_grid(grid, file); },
          "grid",
          "",
          [grid, names](const StepTimes& steps) { return fields_xdmf(grid, names, steps.time); }};
}

}  // namespace

FaceField cell_means(const Grid& grid, const FaceField& faces) {
  FaceField means = make_face_field(grid);
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const int count = grid.cells[std::size_t(axis)];
    const bool joined = grid.periodic[std::size_t(axis)] && !grid.divided(axis);
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 0; i < grid.cells[0]; ++i) {
          std::array<int, 3> high{i, j, k};
          int& along = high[std::size_t(axis)];
          along = joined && along + 1 == count ? 0 : along + 1;
          const auto& f = faces[std::size_t(axis)];
          const auto here = std::size_t(grid.index(i, j, k));
          means[std::size_t(axis)][here] = 0.5 * (f[here] + f[std::size_t(grid.index(high[0], high[1], high[2]))]);
        }
  }
  return means;
}

FieldWriter::FieldWriter(const fs::path& run_directory, const Grid& grid, std::vector<FieldName> names,
                         std::optional<double> resume_time)
    : directory_(run_directory), grid_(grid), names_(std::move(names)) {
  on_first(grid_.ranks.get(), [&] {
    steps_.emplace(run_directory, fields_series(whole_column(grid_), names_), resume_time);
    times_ = steps_->times();
  });
  double steps = double(times_.size());
  take_from_first(grid_.ranks.get(), std::span(&steps, 1));
  times_.resize(std::size_t(steps));
  take_from_first(grid_.ranks.get(), times_);
}

void FieldWriter::write_step(double time_s, std::span<const FieldValues> values) {
  if (values.size() != names_.size())
    throw std::invalid_argument(fmt::format("{} fields for {} names", values.size(), names_.size()));
  on_all(grid_.ranks.get(), [&] {
    for (std::size_t n = 0; n < names_.size(); ++n) {
      check_sizes(grid_, names_[n], values[n]);
      check_finite(grid_, names_[n], values[n], time_s);
    }
  });
  write_file(step_path(directory_, "fields", times_.size()), time_s, values);
  times_.push_back(time_s);
  on_first(grid_.ranks.get(), [&] { steps_->add_written(time_s); });
}

void FieldWriter::write_file(const fs::path& path, double time_s, std::span<const FieldValues> values) const {
  const std::vector<BlockData> data = step_data(grid_, names_, values);
  std::optional<OutputFile> file;
  on_first(grid_.ranks.get(), [&] {
    file.emplace(step_kind);
    file->make_group("step");
    file->set_attribute("step", "time_s", time_s);
  });
  if (!grid_.ranks) {
    write_blocks(*file, data);
    file->save(path);
    return;
  }
  const fs::path temporary = path.string() + ".temporary";
  write_blocks(temporary, file ? &*file : nullptr, data, grid_.ranks.get());
  on_first(grid_.ranks.get(), [&] { put_in_place(temporary, path); });
}

}  // namespace polybed::core
