#include "core/case/resolve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/case/grading.hpp"
#include "core/case/layers.hpp"
#include "core/numerics/schedule.hpp"

namespace polybed::core {

namespace {

// Axes are x (width), y (height), z (depth): the height comes last in the case and second in the grid.
void fill_size(Scene& scene) {
  Column& c = scene.column;
  c.dimensions = int(c.given_size.size());
  if (c.dimensions == 3) {
    c.size = {c.given_size[0], c.given_size[2], c.given_size[1]};
    return;
  }
  if (c.around_axis()) {  // the depth that gives the circle's area
    c.size = {c.given_size[0], c.given_size[1], std::numbers::pi * c.given_size[0]};
    return;
  }
  double smallest = 1;
  for (const Species& s : scene.species) smallest = std::min(smallest, s.diameter);
  const double skin = scene.dem.skin.value_or(0.1 * smallest);
  c.size = {c.given_size[0], c.given_size[1], c.depth.value_or(2 * largest_diameter(scene) + 2 * skin)};
}

void fill_cells(Column& column) {
  const auto cells = [&](std::size_t k) { return int(column.given_cells[k]); };
  column.cells = column.dimensions == 3 ? std::array{cells(0), cells(2), cells(1)} : std::array{cells(0), cells(1), 1};
}

void fill_graded_layers(Column& column) {
  if (!column.grading || !column.graded_above || !(*column.graded_above < column.size[1])) return;
  column.layers = graded_layers(column.size[1], column.cells[1], *column.graded_above, *column.grading);
  column.cells[1] = int(column.layers.size());
}

void fill_graded_widths(Column& column) {
  if (!column.grading_across || column.shape != ColumnShape::box || column.sides != Boundary::wall) return;
  for (const std::size_t axis : {0, 2})
    if (column.cells[axis] > 2)
      column.across[axis / 2] = graded_widths(column.size[axis], column.cells[axis], *column.grading_across);
}

void fill_gravity(Column& column) {
  const std::vector<double>& given = column.gravity_direction;
  if (given.empty()) return;
  const bool plane = given.size() == 2;
  const std::array<double, 3> along{given[0], given.back(), plane ? 0 : given[1]};
  const double length = std::hypot(along[0], along[1], along[2]);
  for (std::size_t d = 0; d < 3; ++d) column.down[d] = along[d] / length;
}

/// Solids press on each other below the loosest settled bed, or nothing could carry it.
void fill_onset(Scene& scene) {
  constexpr double share = 0.9;  // of that bed
  const auto* rule = std::get_if<PackingRule>(&scene.tfm.max_packing);
  const double loosest = loosest_settled(scene);
  if (scene.places.has("tfm.frictional_onset") || rule == nullptr || *rule != PackingRule::automatic) return;
  if (loosest > 0 && loosest <= scene.tfm.frictional_onset) scene.tfm.frictional_onset = share * loosest;
}

void fill_inlet(Scene& scene) {
  Inlet& inlet = scene.inlet;
  if (inlet.flow_rate.empty() || !inlet.superficial_velocity.empty()) return;
  const double area = scene.column.cross_section();
  for (const auto& [time, flow] : inlet.flow_rate) inlet.superficial_velocity.emplace_back(time, flow / area);
  inlet.flow_rate.clear();
}

/// Fills in shares and height from the numbers of particles.
void fill_amount(Scene& scene) {
  Bed& bed = scene.bed;
  const double area = scene.column.cross_section();
  double total = 0;
  bed.volume_share.clear();
  for (std::size_t j = 0; j < scene.species.size(); ++j) {
    bed.volume_share.push_back(volume_of(bed.particles[j], scene.species[j]));
    total += bed.volume_share[j];
  }
  for (double& x : bed.volume_share) x /= total;
  bed.static_height = scene.column.filled_height(total / (area * bed.solids_fraction));
}

/// Fills in the bed values that follow from [[layer]], if there are layers.
void fill_from_layers(Scene& scene, WrongKeys& wrong) {
  const bool sound = wrong.sound({"layer", "layer.", "species.name", "column.size", "bed.volume_share",
                                  "bed.static_height", "bed.solids_fraction", "bed.particles"});
  if (scene.layers.empty() && wrong.sound("layer.")) return;
  if (sound) return fill_layers(scene);
  for (const char* key : {"bed.volume_share", "bed.static_height"}) wrong.add(key);
  if (!(scene.bed.solids_fraction > 0)) wrong.add("bed.solids_fraction");
}

/// Of a mixed start: as settled or, between joined ends in a fluid, as dense as fills the box.
double usual_start_fraction(const Scene& scene) {
  const Bed& bed = scene.bed;
  if (!scene.flows_around() || bed.start.kind != StartKind::mixed || !(scene.column.size[1] > 0))
    return bed.solids_fraction;
  return std::min(bed.solids_fraction, bed.static_height * bed.solids_fraction / scene.column.size[1]);
}

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error);
}

/// A path of a list refers to the working directory or, if there is no such file, to the folder of the case.
void find_list(Bed& bed, const std::string& case_name) {
  const std::filesystem::path beside = std::filesystem::path(case_name).parent_path() / bed.start.file;
  if (!is_file(bed.start.file) && is_file(beside)) bed.start.file = beside.string();
}

/// A path of a law or a table refers to the folder of the case or, if there is no such file, to the working directory;
/// one from the command line to the working directory alone.
void find_files_of_laws(Scene& scene, const std::string& case_name) {
  for (auto& [role, law] : scene.effects)
    for (const std::string prefix : {"file:", "table:"}) {
      const bool in_case = scene.places.problem({"effects." + role}, "").line > 0;
      if (!law.starts_with(prefix) || !in_case) continue;
      const std::filesystem::path beside = std::filesystem::path(case_name).parent_path() / law.substr(prefix.size());
      if (is_file(beside)) law = prefix + beside.string();
    }
}

void fill_output(Scene& scene) {
  const double until = scene.run.until;
  scene.output.every = scene.output.every.value_or(until / 20);
  scene.output.history_every = scene.output.history_every.value_or(until / 400);
  scene.output.checkpoint_every = scene.output.checkpoint_every.value_or(until / 10);
}

}  // namespace

double volume_of(std::int64_t number, const Species& species) {
  return double(number) * std::numbers::pi / 6 * std::pow(species.diameter, 3);
}

double largest_diameter(const Scene& scene) {
  double largest = 0;
  for (const Species& species : scene.species) largest = std::max(largest, species.diameter);
  return largest;
}

void resolve(Scene& scene, const std::string& case_name, WrongKeys& wrong) {
  join_times(scene);
  resolve_materials(scene);
  for (InnerWall& wall : scene.walls)
    if (wall.shape == WallShape::rod && wall.to.empty()) wall.to = wall.from;
  fill_output(scene);
  find_files_of_laws(scene, case_name);
  if (wrong.sound("column.size")) {
    fill_size(scene);
    if (wrong.sound("column.cells")) fill_cells(scene.column);
    if (wrong.sound({"column.cells", "column.grading", "column.graded_above"})) fill_graded_layers(scene.column);
    if (wrong.sound({"column.cells", "column.grading_across", "column.shape", "column.sides"}))
      fill_graded_widths(scene.column);
    if (wrong.sound("column.gravity_direction")) fill_gravity(scene.column);
    if (wrong.sound({"inlet.flow_rate", "column.depth"})) fill_inlet(scene);
  }
  Bed& bed = scene.bed;
  if (!wrong.sound("bed.start")) return;
  if (bed.start.kind == StartKind::list) return find_list(bed, case_name);  // the list itself gives the amount
  const bool counted = !bed.particles.empty();
  const bool known = wrong.sound({"bed.particles", "species.name", "species.diameter", "column.size", "column.depth",
                                  "dem.skin", "bed.solids_fraction"});
  if (counted && known) fill_amount(scene);
  if (counted && !known) {
    wrong.add("bed.volume_share");
    wrong.add("bed.static_height");
  }
  fill_from_layers(scene, wrong);
  bed.start_solids_fraction = bed.start_fraction.value_or(usual_start_fraction(scene));
  fill_onset(scene);
}

}  // namespace polybed::core
