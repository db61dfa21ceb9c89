#include "core/output/xdmf.hpp"

#include <fmt/format.h>

namespace polybed::core {

namespace {

/// Numbers per axis, slowest first: cells and `more` of each.
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

/// ParaView shows vectors of three components only; a 2-D run stores a copy made for it.
std::string attribute(const Grid& grid, const FieldName& field, const std::string& file) {
  const std::string shape = dimensions(grid, 0);
  const bool copied = field.vector && grid.dimensions == 2;
  const std::string item = data_item(field.vector ? shape + " 3" : shape, copied ? 4 : 8,
                                     fmt::format("{}:/{}/{}", file, copied ? "paraview" : "step", field.name));
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Cell\">\n          {}\n"
      "        </Attribute>\n",
      field.name, field.vector ? "Vector" : "Scalar", item);
}

}  // namespace

std::string fields_xdmf(const Grid& grid, std::span<const FieldName> names, std::span<const double> times) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"fields\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const std::string mesh = geometry(grid);
  for (std::size_t step = 0; step < times.size(); ++step) {
    text += fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n",
                        step_name(step), times[step]);
    text += mesh;
    for (const FieldName& field : names) text += attribute(grid, field, fmt::format("fields/{}.h5", step_name(step)));
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace polybed::core
