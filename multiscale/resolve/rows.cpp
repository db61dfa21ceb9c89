#include "multiscale/resolve/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "closures/mixture.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/rows.hpp"
#include "measures/time_mean.hpp"
#include "multiscale/resolve/pair_distribution.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

using core::SphereMotion;

std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }

/// Columns of a box for each species.
std::vector<std::vector<double> BoxDrag::*> columns_of(SphereMotion motion) {
  if (motion != SphereMotion::free) return {&BoxDrag::net, &BoxDrag::pure};
  return {&BoxDrag::net, &BoxDrag::pure, &BoxDrag::slip, &BoxDrag::along, &BoxDrag::across};
}

/// Of held or free spheres.
RowValue value_of(const RowBoxes& boxes, std::vector<double> BoxDrag::*column, std::size_t species) {
  return row_value(boxes, [&](const std::vector<BoxDrag>& parts) { return (parts[0].*column)[species]; });
}

/// Of moving spheres, on species j: the part by the motion of species k, or the sum over all of them if k is negative.
RowValue moving_value(const core::Scene& scene, double reynolds, const RowBoxes& boxes,
                      std::vector<double> BoxDrag::*column, std::size_t j, int k = -1) {
  const std::vector<std::vector<int>> sets = passed(scene, reynolds);
  return row_value(boxes, [&](const std::vector<BoxDrag>& parts) {
    double sum = 0;
    for (std::size_t n = 0; n < sets.size(); ++n) {
      double factor = 0;
      for (int by = 0; by < int(scene.species.size()); ++by)
        if (k < 0 || by == k) factor += factor_of(sets[n], by, scene, reynolds);
      sum += factor * (parts[n].*column)[j];
    }
    return sum;
  });
}

/// With the Sauter diameter and the mean superficial slip of the solids.
double reynolds_of_slip(const core::Scene& scene, const std::vector<double>& share, const RowBoxes& boxes) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  double slip = 0;
  std::vector<double> diameter;
  for (std::size_t j = 0; j < share.size(); ++j) {
    slip += share[j] * value_of(boxes, &BoxDrag::slip, j).mean;
    diameter.push_back(scene.species[j].diameter);
  }
  return fluid.density * slip * closures::sauter_diameter(share, diameter) / fluid.viscosity;
}

/// With a cell and the slip of the fastest species in the pores: a measure of the resolution of the flow past it.
double reynolds_of_cell(const core::Scene& scene, double voidage, const RowBoxes& boxes) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  double slip = 0;
  for (std::size_t j = 0; j < scene.species.size(); ++j) slip = std::max(slip, value_of(boxes, &BoxDrag::slip, j).mean);
  return fluid.density * slip / voidage * least_diameter(scene) / boxes[0][0][0].cells / fluid.viscosity;
}

/// Inputs of the motion of free spheres besides those of the flow: the case without its list of boxes.
std::string free_text(core::Scene scene) {
  const std::optional<double> until = scene.resolve.until;
  scene.resolve = {};
  scene.resolve.until = until;
  return core::resolved_case(scene);
}

}  // namespace

RowValue row_value(const RowBoxes& boxes, const std::function<double(const std::vector<BoxDrag>&)>& value) {
  const auto count = double(boxes.size());
  RowValue row;
  double squares = 0, coarser = 0;
  for (const auto& grids : boxes) {
    row.mean += value(grids[0]) / count;
    if (grids.size() > 1) coarser += value(grids[1]) / count;
  }
  for (const auto& grids : boxes) squares += std::pow(value(grids[0]) - row.mean, 2);
  row.error = boxes.size() > 1 ? std::sqrt(squares / (count * (count - 1))) : unknown;
  row.grid = boxes[0].size() > 1 ? row.mean - coarser : unknown;
  return row;
}

std::string interval_text(int packings) {
  constexpr int least = 4;
  if (packings < 2) return "one packing: no standard errors; resolve.packings of 4 or more gives 95 % intervals";
  if (packings < least)
    return fmt::format(
        "standard errors from {} packings, without Student's factor: too few for a 95 % interval, which "
        "needs resolve.packings of {} or more",
        packings, least);
  return fmt::format("standard errors from {} packings: a 95 % interval is {:.3g} times as wide on either side",
                     packings, measures::student_quantile(std::size_t(packings) - 1));
}

std::string row_header(const core::Scene& scene) {
  const std::size_t species = scene.species.size();
  const SphereMotion motion = scene.resolve.motion;
  const bool free = motion == SphereMotion::free;
  std::string text = "eps,Re";
  for (std::size_t j = 1; j <= species; ++j) text += fmt::format(",x{0},D{0}", j);
  for (std::size_t j = 1; j <= species; ++j)
    text += free ? fmt::format(",u_{0},u_{0}_se,f_{0},v_{0},w_{0}", j) : fmt::format(",n_{0},n_{0}_se,f_{0}", j);
  if (motion == SphereMotion::moving)
    for (std::size_t j = 1; j <= species; ++j)
      for (std::size_t k = 1; k <= species; ++k) text += fmt::format(",f_{0}_{1},f_{0}_{1}_se", j, k);
  text += ",packings,resolution,spheres,imbalance";
  if (free) text += ",cell_Re";
  for (std::size_t j = 1; j <= species; ++j) text += fmt::format(",{}_{}_grid", free ? "u" : "n", j);
  return text;
}

std::string row_text(const core::Scene& scene, double voidage, double reynolds, const RowBoxes& boxes) {
  const std::vector<double> share = shares_of(scene, sphere_numbers(scene));
  const std::size_t species = share.size();
  const bool free = scene.resolve.motion == SphereMotion::free;
  const bool moving = scene.resolve.motion == SphereMotion::moving;
  const auto value = [&](std::vector<double> BoxDrag::*column, std::size_t j) {
    return moving ? moving_value(scene, reynolds, boxes, column, j) : value_of(boxes, column, j);
  };
  const auto main = free ? &BoxDrag::slip : &BoxDrag::net;
  std::string text = fmt::format("{:g},{:.6g}", voidage, free ? reynolds_of_slip(scene, share, boxes) : reynolds);
  for (std::size_t j = 0; j < species; ++j)
    text += fmt::format(",{:.8f},{:g}", share[j], scene.species[j].diameter);  // shares sum to 1 within 1e-6
  for (std::size_t j = 0; j < species; ++j) {
    const RowValue v = value(main, j);
    text += fmt::format(",{},{},{}", cell(v.mean), cell(v.error), cell(value(&BoxDrag::pure, j).mean));
    if (free)
      text += fmt::format(",{},{}", cell(value(&BoxDrag::along, j).mean), cell(value(&BoxDrag::across, j).mean));
  }
  if (moving)
    for (std::size_t j = 0; j < species; ++j)
      for (std::size_t k = 0; k < species; ++k) {
        const RowValue v = moving_value(scene, reynolds, boxes, &BoxDrag::pure, j, int(k));
        text += fmt::format(",{},{}", cell(v.mean), cell(v.error));
      }
  double imbalance = 0;
  for (const auto& grids : boxes)
    for (const auto& parts : grids)
      for (const BoxDrag& box : parts) imbalance = std::max(imbalance, box.imbalance);
  std::int64_t spheres = 0;
  for (const std::int64_t n : sphere_numbers(scene)) spheres += n;
  text += fmt::format(",{},{:.4g},{},{:.2g}", boxes.size(), boxes[0][0][0].cells, spheres, imbalance);
  if (free) text += fmt::format(",{:.3g}", reynolds_of_cell(scene, voidage, boxes));
  for (std::size_t j = 0; j < species; ++j) text += "," + cell(value(main, j).grid);
  return text;
}

std::string pair_header() { return "eps,Re,j,k,r,g,g_se"; }

std::string pair_text(const core::Scene& scene, double voidage, const RowBoxes& boxes) {
  const std::vector<PairDistribution::Shell> shells = pair_distribution(scene, voidage).shells();
  for (const auto& grids : boxes)
    if (grids[0][0].pairs.size() != shells.size()) return "";
  const double reynolds = reynolds_of_slip(scene, shares_of(scene, sphere_numbers(scene)), boxes);
  std::string text;
  for (std::size_t n = 0; n < shells.size(); ++n) {
    const RowValue g = row_value(boxes, [&](const std::vector<BoxDrag>& parts) { return parts[0].pairs.at(n); });
    text += fmt::format("{:g},{:.6g},{},{},{:.2f},{},{}\n", voidage, reynolds, shells[n].j + 1, shells[n].k + 1,
                        shells[n].middle, cell(g.mean), cell(g.error));
  }
  return text;
}

std::string box_text(const BoxDrag& box) {
  std::string text =
      fmt::format("{},{},{},{},{},{}", box.cells, box.change, box.imbalance, box.steps, box.sites, box.seconds);
  for (std::size_t j = 0; j < box.net.size(); ++j)
    for (const auto column : columns_of(box.slip.empty() ? SphereMotion::held : SphereMotion::free))
      text += fmt::format(",{}", (box.*column)[j]);
  for (const double g : box.pairs) text += fmt::format(",{}", g);
  return text;
}

BoxDrag box_of_text(const std::string& text, const core::Scene& scene) {
  std::vector<double> numbers;
  for (const std::string_view cell : core::cells_of_row(text)) {
    const std::optional<double> number = core::finite_number(cell);
    if (!number) return {};
    numbers.push_back(*number);
  }
  constexpr std::size_t before = 6;
  const auto columns = columns_of(scene.resolve.motion);
  const std::size_t end = before + columns.size() * scene.species.size();
  if (numbers.size() < end || (numbers.size() > end && scene.resolve.motion != SphereMotion::free)) return {};
  BoxDrag box;
  box.cells = numbers[0];
  box.change = numbers[1];
  box.imbalance = numbers[2];
  box.steps = numbers[3];
  box.sites = numbers[4];
  box.seconds = numbers[5];
  for (std::size_t n = before; n < end; ++n) (box.*columns[(n - before) % columns.size()]).push_back(numbers[n]);
  box.pairs.assign(numbers.begin() + std::ptrdiff_t(end), numbers.end());
  return box;
}

std::string box_name(const core::Scene& scene, const ResolvePoint& point) {
  std::string text = fmt::format("{},{},{},{},{},{},{}", point.voidage, point.reynolds, point.packing,
                                 cells_of(scene.resolve, point.grid), scene.resolve.spheres, scene.bed.seed,
                                 int(scene.resolve.precision));
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    text += fmt::format(",{},{}", scene.bed.volume_share[j], scene.species[j].diameter);
  if (!point.past.empty())
    text += fmt::format(",past {},roughness {}", fmt::join(point.past, " "), scene.material.roughness);
  if (scene.resolve.motion != SphereMotion::held) text += fmt::format(",gap {}", resolved_gap);
  if (scene.resolve.motion == SphereMotion::free) text += free_text(scene);
  return core::text_hash(text);
}

}  // namespace polybed::multiscale
