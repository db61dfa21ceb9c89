#include "multiscale/resolve/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/rows.hpp"

namespace polybed::multiscale {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }

}  // namespace

std::vector<RowValue> row_values(const std::vector<std::vector<BoxDrag>>& boxes) {
  const auto count = double(boxes.size());
  std::vector<RowValue> row(boxes[0][0].net.size());
  for (std::size_t j = 0; j < row.size(); ++j) {
    double squares = 0, coarser = 0;
    for (const std::vector<BoxDrag>& grids : boxes) {
      row[j].net += grids[0].net[j] / count;
      row[j].pure += grids[0].pure[j] / count;
      if (grids.size() > 1) coarser += grids[1].net[j] / count;
    }
    for (const std::vector<BoxDrag>& grids : boxes) squares += std::pow(grids[0].net[j] - row[j].net, 2);
    row[j].net_error = boxes.size() > 1 ? std::sqrt(squares / (count * (count - 1))) : unknown;
    row[j].net_grid = boxes[0].size() > 1 ? row[j].net - coarser : unknown;
  }
  return row;
}

std::string row_header(std::size_t species) {
  std::string text = "eps,Re";
  for (std::size_t j = 1; j <= species; ++j) text += fmt::format(",x{0},D{0}", j);
  for (std::size_t j = 1; j <= species; ++j) text += fmt::format(",n_{0},n_{0}_se,f_{0}", j);
  text += ",packings,resolution,spheres,imbalance";
  for (std::size_t j = 1; j <= species; ++j) text += fmt::format(",n_{}_grid", j);
  return text;
}

std::string row_text(const core::Scene& scene, double voidage, double reynolds,
                     const std::vector<std::vector<BoxDrag>>& boxes) {
  const std::vector<RowValue> values = row_values(boxes);
  const std::vector<double> share = shares_of(scene, sphere_numbers(scene));
  std::string text = fmt::format("{:g},{:g}", voidage, reynolds);
  for (std::size_t j = 0; j < values.size(); ++j)
    text += fmt::format(",{:.8f},{:g}", share[j], scene.species[j].diameter);  // shares sum to 1 within 1e-6
  double imbalance = 0;
  for (const std::vector<BoxDrag>& grids : boxes)
    for (const BoxDrag& box : grids) imbalance = std::max(imbalance, box.imbalance);
  for (const RowValue& v : values) text += fmt::format(",{},{},{}", cell(v.net), cell(v.net_error), cell(v.pure));
  std::int64_t spheres = 0;
  for (const std::int64_t n : sphere_numbers(scene)) spheres += n;
  text += fmt::format(",{},{:.4g},{},{:.2g}", boxes.size(), boxes[0][0].cells, spheres, imbalance);
  for (const RowValue& v : values) text += "," + cell(v.net_grid);
  return text;
}

std::string box_text(const BoxDrag& box) {
  std::string text =
      fmt::format("{},{},{},{},{},{}", box.cells, box.change, box.imbalance, box.steps, box.sites, box.seconds);
  for (std::size_t j = 0; j < box.net.size(); ++j) text += fmt::format(",{},{}", box.net[j], box.pure[j]);
  return text;
}

BoxDrag box_of_text(const std::string& text, std::size_t species) {
  std::vector<double> numbers;
  for (const std::string_view cell : core::cells_of_row(text)) {
    const std::optional<double> number = core::finite_number(cell);
    if (!number) return {};
    numbers.push_back(*number);
  }
  constexpr std::size_t before = 6;
  if (numbers.size() != before + 2 * species) return {};
  BoxDrag box{{}, {}, numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
  for (std::size_t j = 0; j < species; ++j) {
    box.net.push_back(numbers[before + 2 * j]);
    box.pure.push_back(numbers[before + 2 * j + 1]);
  }
  return box;
}

std::string box_name(const core::Scene& scene, const ResolvePoint& point) {
  std::string text = fmt::format("{},{},{},{},{},{},{}", point.voidage, point.reynolds, point.packing,
                                 cells_of(scene.resolve, point.grid), scene.resolve.spheres, scene.bed.seed,
                                 int(scene.resolve.precision));
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    text += fmt::format(",{},{}", scene.bed.volume_share[j], scene.species[j].diameter);
  return core::text_hash(text);
}

}  // namespace polybed::multiscale
