#include "multiscale/requirements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/metric.hpp"
#include "measures/bed.hpp"
#include "relevance/drag_law.hpp"
#include "tfm/fields.hpp"
#include "tfm/step_estimate.hpp"

namespace polybed::multiscale {

namespace {

constexpr std::size_t sample_cells = 12000;  ///< enough that their memory is visible, few enough for a second
/// From here to 100 steps the mean time of a step changes by less than a tenth in 12 of 13 shipped cases.
constexpr int sample_steps = 40;

std::size_t cell_count(const core::Scene& scene) {
  const auto& cells = scene.column.cells;
  return std::size_t(cells[0]) * std::size_t(cells[1]) * std::size_t(cells[2]);
}

/// Reduces one direction to a number of cells.
void draw_in(core::Scene& scene, std::size_t axis, int cells) {
  core::Column& column = scene.column;
  const double share = axis == 1 && !column.layers.empty() ? cells * column.cell(1) / column.size[1]
                                                           : double(cells) / column.cells[axis];
  scene.bed.particles.clear();  // volume_share and static_height give the same amount
  column.profile.clear();       // a part of the inside of a round column
  scene.walls.clear();
  column.cells[axis] = cells;
  column.size[axis] *= share;
  if (axis != 1) column.across[axis / 2].clear();
  const auto draw = [&](auto& part, core::ColumnFace at) {
    for (std::size_t n = 0; n < part.from.size(); ++n) {
      if (std::size_t(axis_along(at, column.dimensions, n)) != axis) continue;
      part.from[n] *= share;
      part.to[n] *= share;
    }
  };
  for (core::Jet& jet : scene.jets) draw(jet, jet.at);
  for (core::Feed& feed : scene.feeds) draw(feed, feed.at);
  for (core::Discharge& discharge : scene.discharges) draw(discharge, discharge.at);
  for (core::Layer& layer : scene.layers) draw(layer, core::ColumnFace::bottom);
  if (axis == 1) {
    column.layers.clear();  // those of the lower part remain
    scene.bed.static_height *= share;
    for (core::Layer& layer : scene.layers) layer.height *= share;
    return;
  }
  if (column.is_round()) column.shape = core::ColumnShape::box;
  const bool fed_above = std::any_of(scene.feeds.begin(), scene.feeds.end(),
                                     [](const core::Feed& feed) { return feed.at == core::ColumnFace::top; });
  if (fed_above) column.outlet = core::Outlet::screen;  // a few remaining cells could be fed shut
}

int fewer(int cells, double share, int least) {
  return std::min(cells, std::max(least, int(std::lround(cells * share))));
}

/// Takes steps, then makes a checkpoint; returns the CPU time of a step, s, or nothing if the computation fails.
std::optional<double> time_of_step(tfm::Model& model, double until, int most_steps) {
  const double begin = core::cpu_seconds();
  double spent = 0;
  int steps = 0;
  try {
    while (model.time() < until && steps < most_steps && spent < sample_seconds) {
      model.step(until);
      ++steps;
      spent = core::cpu_seconds() - begin;
    }
    model.restart();
    (void)model.checkpoint();
  } catch (const core::NumericsError&) {
    return std::nullopt;
  }
  return spent / std::max(steps, 1);
}

double superficial_velocity(const tfm::Model& model) { return model.inlet().greatest_below(); }

/// Solids fraction of a bed that is packed still but carried by the fluid: where the solids stress carries a tenth of
/// the weight. The tenth is fitted to the steps that runs took while their beds were lifted.
double lifted_fraction(const core::Scene& scene, const tfm::Model& model) {
  const double rest = scene.bed.solids_fraction;
  if (!model.effects().solids_stress) return rest;
  constexpr double carried = 0.1;
  const tfm::Constants& constants = model.constants();
  const double weight = scene.bed.static_height * rest *
                        std::abs(tfm::mean_density(constants) - constants.fluid.density) * constants.gravity;
  return std::min(rest, model.effects().solids_stress->solids_fraction_at(carried * weight));
}

/// The bed at rest, lifted, and expanded at the inlet's greatest velocity, with time scales and steps.
void estimate_steps(const core::Scene& scene, const tfm::Model& model, Requirements& need) {
  const tfm::Constants& constants = model.constants();
  const double velocity = superficial_velocity(model), fastest = model.inlet().greatest();
  const auto state = [&](double solids_fraction) {
    using enum core::TfmIntegrator;
    const double inside = fastest / (1 - solids_fraction), rtol = scene.tfm.rtol;
    BedState bed{solids_fraction,
                 tfm::time_scales_of_bed(scene, constants, model.effects(), {solids_fraction, velocity},
                                         need.integrator == split_steps),
                 0};
    const double step = need.integrator == explicit_steps ? tfm::explicit_step(bed.scales)
                        : need.integrator == split_steps  ? tfm::split_step(constants, bed.scales, inside, rtol)
                                                          : tfm::implicit_step(constants, inside, rtol);
    const double longest = std::min(scene.run.until, scene.output.checkpoint_every.value_or(scene.run.until));
    bed.step = scene.tfm.fixed_step.value_or(std::min(step, longest));
    return bed;
  };
  const double rest = scene.flows_around() ? scene.bed.start_solids_fraction : scene.bed.solids_fraction;
  need.rest = need.lifted = need.expanded = state(rest);
  if (!scene.drag().given || !(velocity > 0)) return;
  const double expanded = tfm::expanded_fraction(constants, relevance::drag_law_of(scene), velocity, rest);
  if (expanded == rest) return;
  need.expanded = state(expanded);
  need.lifted = state(std::max(lifted_fraction(scene, model), expanded));
}

/// Time for which a bed that starts packed remains so, s: until the inlet's fluid has filled its height once. Measured.
double packed_time(const core::Scene& scene, const Requirements& need, double velocity) {
  if (need.expanded.solids_fraction == need.rest.solids_fraction) return scene.run.until;
  if (scene.bed.start_solids_fraction < scene.tfm.frictional_onset) return 0;
  return std::min(scene.run.until, scene.bed.static_height / velocity);
}

/// Steps of an implicit run while its step grows to the bed's: from its start, and after each checkpoint, where the
/// integrator loses its history. For each factor of ten above 0.1 ms; measured on packed beds in three dimensions.
double growing_steps(const core::Scene& scene, const Requirements& need) {
  if (need.integrator != core::TfmIntegrator::implicit_steps) return 0;
  constexpr double from = 1e-4, of_start = 30, of_restart = 7;
  const double tenfolds = std::max(0.0, std::log10(need.expanded.step / from));
  const double restarts = std::max(0.0, std::ceil(scene.run.until / *scene.output.checkpoint_every * (1 - 1e-9)) - 1);
  return tenfolds * (of_start + restarts * of_restart);
}

TimeNeed time_need(const core::Scene& scene, const Requirements& need, double velocity, double per_step) {
  const double packed = packed_time(scene, need, velocity);
  TimeNeed time;
  time.steps = std::max(packed / need.lifted.step + (scene.run.until - packed) / need.expanded.step, 1.0) +
               growing_steps(scene, need);
  time.seconds_per_step = per_step;
  return time;
}

/// Two samples of different width, built and stepped one after the other: the growth of the process from the first to
/// the second is the memory for their difference in cells, independent of the program itself.
struct Sample {
  std::size_t cells;
  double peak;  ///< memory of the process up to then, bytes
};

double padded_cells(core::Grid grid, const std::array<int, 3>& cells) {
  grid.cells = cells;
  return double(grid.padded_size());
}

MemoryNeed memory_need(const core::Scene& scene, const tfm::Model& part, const Sample& small, const Sample& large) {
  MemoryNeed need;
  const core::Grid& grid = part.constants().grid;
  const auto cells = double(cell_count(scene));
  const double state = double(part.state_bytes()), fields = double(tfm::bytes_of(part.fields()));
  const auto own = double(large.cells);
  // Memory of a run beyond its sample, measured: gaps between blocks and results in transit; HDF5 and its buffers.
  constexpr double beyond = 1.1, output = 12e6;
  const double grown = std::max(0.0, large.peak - small.peak) / std::max(own - double(small.cells), 1.0);
  need.state = state * cells / own;
  need.fields = fields * padded_cells(grid, scene.column.cells) / double(grid.padded_size()) + bytes_of_walls(scene);
  need.solver = std::max(0.0, beyond * grown - (state + fields) / own) * cells;
  need.program = std::max(0.0, small.peak - grown * double(small.cells)) + output;
  return need;
}

/// The smaller sample: half as wide.
Sample small_sample(const core::Scene& part) {
  core::Scene half = part;
  draw_in(half, 0, std::max(1, part.column.cells[0] / 2));
  core::Timers timers;
  tfm::Model model(half, timers);
  constexpr int steps = 2;  // afterwards every lazily created object exists
  (void)time_of_step(model, half.run.until, steps);
  return {cell_count(half), core::process_memory().most};
}

std::size_t unknowns_of(const core::Scene& scene, const tfm::Model& model) {
  core::Grid grid = model.constants().grid;
  grid.cells = scene.column.cells;
  return model.layout_on(grid).size();
}

/// Of the cross-section of a round column; empty for a box.
std::string round_text(const core::Column& column) {
  if (column.shape == core::ColumnShape::box) return "";
  const double radius = column.around_axis() ? column.size[0] : 0.5 * column.size[0];
  const std::string across = fmt::format("round, {:.4g} mm across", 2e3 * radius);
  const bool tapered = column.is_tapered();
  if (column.around_axis() && !tapered)
    return fmt::format("{}: {} rings of {:.3g} mm", across, column.cells[0], 1e3 * radius / column.cells[0]);
  const core::Grid grid = core::grid_of(column, nullptr);
  const auto layers = std::size_t(tapered ? column.cells[1] : 1), cells = grid.metric->layers.front().volume.size();
  std::size_t open = 0;
  double least = 1;
  for (std::size_t y = 0; y < layers; ++y)
    for (std::size_t c = 0; c < cells; ++c) {
      const double theta = grid.metric->layers[y].volume[c],
                   whole = column.around_axis() ? double(2 * c + 1) / column.cells[0] : 1.0;
      if (!(theta > 0)) continue;
      ++open;
      least = std::min(least, theta / whole);
    }
  if (!tapered)
    return fmt::format("{}: {} cells, {} of {} in a layer are open, the smallest {:.2g} of a whole one", across,
                       column.cells[0], open, cells, least);
  return fmt::format(
      "round, {:.4g} mm across at the bottom, {:.4g} at the top: {:.3g} cells where it is narrowest, {:.4g} l, {} of "
      "{} "
      "cells are open, the smallest {:.2g} of a whole one",
      1e3 * column.profile.front().second, 1e3 * column.profile.back().second, column.narrowest() / grid.spacing[0],
      1e3 * column.cross_section() * column.even_height(column.size[1]), open, layers * cells, least);
}

/// Of graded layers; else empty.
std::string layers_text(const core::Column& column) {
  if (column.layers.empty()) return "";
  const std::vector<double>& layers = column.layers;
  return fmt::format(
      "{} layers instead of {:.0f}: {:.4g} mm high up to {:.4g} m, then each {:.4g} times the one below, {:.4g} "
      "mm at the top",
      layers.size(), column.size[1] / layers.front(), 1e3 * layers.front(),
      layers.front() * double(std::count(layers.begin(), layers.end(), layers.front())),
      layers.back() / layers[layers.size() - 2], 1e3 * layers.back());
}

/// Of cells that are graded across; else empty.
std::string widths_text(const core::Column& column) {
  std::string text;
  for (const std::size_t axis : {0, 2}) {
    const std::vector<double>& widths = column.across[axis / 2];
    if (widths.empty()) continue;
    text += fmt::format("{}{:.4g} mm {} at the walls, each {:.4g} times its neighbour, {:.4g} mm in the middle",
                        text.empty() ? "cells " : "; ", 1e3 * widths.front(), axis == 0 ? "wide" : "deep",
                        widths[1] / widths[0], 1e3 * widths[widths.size() / 2]);
  }
  return text;
}

/// Open volume and cells between walls inside; empty without walls that a fluid meets.
std::string walls_text(const core::Scene& scene) {
  const core::Grid grid = core::grid_of(scene, nullptr);
  if (!grid.metric || !grid.metric->walls) return "";
  std::size_t open = 0;
  double volume = 0, least = 1;
  for (int y = 0; y < grid.cells[1]; ++y)
    for (std::size_t c = 0; c < grid.metric->layer(y).volume.size(); ++c) {
      const double theta = grid.metric->layer(y).volume[c],
                   whole = scene.column.around_axis() ? double(2 * c + 1) / grid.cells[0] : 1.0;
      if (!(theta > 0)) continue;
      ++open;
      volume += theta;
      least = std::min(least, theta / whole);
    }
  return fmt::format("{:.4g} l open between {} [[wall]], {} of {} cells, the smallest {:.2g} of a whole one",
                     1e3 * volume * grid.cell_volume(), scene.walls.size(), open, grid.cell_count(), least);
}

}  // namespace

double bytes_of_walls(const core::Scene& scene) {
  if (!scene.fluid.present() || scene.walls.empty()) return 0;
  // The fields of core::Metric and a velocity along the walls; its layers, cut and uncut, for the whole column.
  const double axes = scene.column.dimensions, fields = 6 + 4 * axes, layers = 4 + 3 * axes;
  constexpr double multigrid = 800;  // bytes a cell more than of the row means of the sample, in a tube of 57,344 cells
  return (double(sizeof(double)) * (fields + layers) + multigrid) * double(cell_count(scene));
}

std::optional<double> measured_height(const core::Scene& scene, double solids_fraction) {
  if (!(solids_fraction > 0)) return {};
  const double top = scene.bed.static_height * scene.bed.solids_fraction / solids_fraction;
  if (!(top > 0)) return {};
  const auto slabs = std::size_t(scene.column.cells[1]);
  const measures::Profile bed{top, {{solids_fraction}}, {}};
  return measures::bed_height(measures::on_slabs(bed, scene.column.size[1] / double(slabs), slabs));
}

core::Scene narrow_part(const core::Scene& scene, std::size_t most_cells) {
  core::Scene part = scene;
  constexpr int least = 8, least_in_depth = 6;
  const auto& cells = part.column.cells;
  const auto share = [&] { return double(most_cells) / double(cell_count(part)); };
  if (part.column.dimensions == 3 && share() < 1) draw_in(part, 2, fewer(cells[2], std::sqrt(share()), least_in_depth));
  if (share() < 1) draw_in(part, 0, fewer(cells[0], share(), least));
  if (part.column.dimensions == 3 && share() < 1) draw_in(part, 2, fewer(cells[2], share(), least_in_depth));
  constexpr double far_too_high = 0.1;
  if (share() < far_too_high) {
    draw_in(part, 1, fewer(cells[1], share(), least));
    // The packing that carries the bed's weight depends on its height, which differs from the case's.
    if (part.tfm.max_packing == core::MaxPacking(core::PackingRule::automatic))
      part.tfm.max_packing = part.bed.solids_fraction + 0.05;
  }
  return part;
}

std::string shape_text(const core::Scene& scene) {
  std::vector<std::string> parts;
  for (const std::string& part :
       {round_text(scene.column), walls_text(scene), layers_text(scene.column), widths_text(scene.column)})
    if (!part.empty()) parts.push_back(part);
  return fmt::format("{}", fmt::join(parts, "; "));
}

Requirements requirements_of(const core::Scene& scene, core::Timers& timers, std::unique_ptr<tfm::Model>& model) {
  Requirements need;
  need.cells = cell_count(scene);
  const core::Scene part = narrow_part(scene, sample_cells);
  const Sample small = small_sample(part);
  model = std::make_unique<tfm::Model>(part, timers);
  need.integrator = model->integrator_kind();
  need.reason = model->integrator_reason();
  need.momentum = model->momentum();
  need.unknowns = unknowns_of(scene, *model);
  estimate_steps(scene, *model, need);
  const std::optional<double> per_step = time_of_step(*model, scene.run.until, sample_steps);
  const Sample large{cell_count(part), core::process_memory().most};
  need.memory = memory_need(scene, *model, small, large);
  if (per_step) {
    const double ratio = double(need.cells) / double(large.cells);
    need.time = time_need(scene, need, superficial_velocity(*model), *per_step * ratio);
  }
  return need;
}

Requirements expected_of(const core::Scene& scene, const tfm::Model& model, double seconds_per_step) {
  Requirements need;
  need.cells = cell_count(scene);
  need.unknowns = model.unknowns();
  need.integrator = model.integrator_kind();
  need.reason = model.integrator_reason();
  need.momentum = model.momentum();
  estimate_steps(scene, model, need);
  need.time = time_need(scene, need, superficial_velocity(model), seconds_per_step);
  return need;
}

void refuse_beyond_memory(const core::Scene& scene, double bytes, const core::AvailableMemory& available,
                          std::int64_t particles) {
  if (bytes <= available.bytes) return;
  const std::string what = particles > 0
                               ? fmt::format("{} particles", particles)
                               : fmt::format("column.cells = [{}]", fmt::join(scene.column.given_cells, ", "));
  const auto blamed = particles > 0 ? std::vector<std::string>{"bed.particles", "bed.static_height", "bed.start"}
                                    : std::vector<std::string>{"column.cells"};
  throw core::CaseError(std::vector{scene.places.problem(
      blamed, fmt::format("{}: the run would need about {:.3g} GB of memory; {} leaves {:.3g} GB: choose fewer", what,
                          1e-9 * bytes, available.limit, 1e-9 * available.bytes))});
}

void require_memory(const core::Scene& scene) {
  constexpr double much_per_cell = 20e3;  // bytes; above all measured cases
  const core::AvailableMemory available = core::available_memory();
  if (double(cell_count(scene)) * much_per_cell < 0.5 * available.bytes) return;
  core::Timers timers;
  std::unique_ptr<tfm::Model> model;
  refuse_beyond_memory(scene, requirements_of(scene, timers, model).memory.total(), available);
}

}  // namespace polybed::multiscale
