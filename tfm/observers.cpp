#include "tfm/observers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.hpp"

namespace polybed::tfm {

namespace {

std::vector<std::string> history_columns(const Constants& constants) {
  std::vector<std::string> columns{"time_s", "dt_s", "bed_height_m", "pressure_drop_Pa", "buoyant_weight_Pa"};
  for (const std::string& name : constants.name) {
    columns.push_back("centre_" + name + "_m");
    columns.push_back("mass_" + name + "_kg");
  }
  columns.insert(columns.end(), {"interface_m", "mixing", "max_solids_fraction", "min_fraction", "divergence"});
  if (constants.openings.present())
    for (const std::string& name : constants.name) {
      columns.push_back("in_" + name + "_kg");
      columns.push_back("out_" + name + "_kg");
    }
  return columns;
}

std::vector<double> slab_centres(const core::Grid& grid) {
  std::vector<double> y;
  for (int k = 0; k < grid.cells[1]; ++k) y.push_back(grid.centre(1, k));
  return y;
}

std::vector<std::string> profile_names(const Constants& constants) {
  std::vector<std::string> names{"voidage", "p"};
  for (const std::string& name : constants.name) {
    names.push_back("phi_" + name);
    names.push_back("u_" + name);
  }
  return names;
}

std::vector<core::FieldName> field_names(const Constants& constants) {
  std::vector<core::FieldName> names{{"voidage"}, {"pressure"}, {"u_fluid", true}};
  for (const std::string& name : constants.name) {
    names.push_back({"phi_" + name});
    names.push_back({"u_" + name, true});
  }
  return names;
}

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw core::FileError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

/// Opens steps.csv; when a run goes on, rows later than its time and a row cut short are dropped.
std::FILE* open_steps(const std::filesystem::path& path, std::optional<double> resume_time) {
  std::string kept = "time_s,dt_s,error_norm,limited_by\n";
  if (resume_time) {
    std::ifstream old(path);
    std::string line;
    std::getline(old, line);
    while (std::getline(old, line) && !old.eof())
      if (std::strtod(line.c_str(), nullptr) <= *resume_time) kept += line + "\n";
  }
  core::write_atomically(path, kept);
  std::FILE* file = std::fopen(path.c_str(), "a");
  if (file == nullptr) fail(path);
  return file;
}

}  // namespace

std::vector<double> masses(const Model& model) {
  std::vector<double> mass = fluid::species_volumes(model.constants().grid, model.fields().solids);
  for (std::size_t j = 0; j < mass.size(); ++j) mass[j] *= model.constants().density[j];
  return mass;
}

fluid::Profile profile_of(const Model& model) {
  fluid::Profile profile;
  profile.slab = model.constants().grid.spacing[1];
  for (const core::Field& phi : model.fields().solids.fraction)
    profile.fraction.push_back(fluid::lateral_mean(model.constants().grid, phi));
  profile.pressure = fluid::lateral_mean(model.constants().grid, model.fields().fluid.pressure);
  return profile;
}

Observers::Observers(const Model& model, const std::filesystem::path& directory, double rtol,
                     std::vector<double> initial_mass, std::optional<double> resume_time)
    : model_(model),
      invariants_(std::move(initial_mass), rtol),
      history_(directory, history_columns(model.constants()), resume_time),
      profiles_(directory, slab_centres(model.constants().grid), profile_names(model.constants()), resume_time),
      fields_(directory, model.constants().grid, field_names(model.constants()), resume_time),
      steps_path_(directory / "steps.csv"),
      steps_(open_steps(steps_path_, resume_time), std::fclose) {}

void Observers::write_history(double time) {
  const Constants& constants = model_.constants();
  const fluid::Profile profile = profile_of(model_);
  const std::vector<double> mass = masses(model_);
  const double area =
      constants.grid.spacing[0] * constants.grid.cells[0] * constants.grid.spacing[2] * constants.grid.cells[2];
  double weight = 0;
  for (std::size_t j = 0; j < constants.species(); ++j)
    weight += mass[j] * (1 - constants.fluid.density / constants.density[j]) * constants.gravity / area;
  const double drop = fluid::pressure_drop(profile);
  force_balance_ = weight != 0 ? drop / weight : 0;
  const Fields& fields = model_.fields();
  const double above = model_.effects().solids_stress ? model_.effects().solids_stress->packing_above(fields) : 0.0;
  const std::vector<fluid::Passed> passed = model_.passed();
  const fluid::InvariantValues now = invariants_.see(constants.grid, fields.solids, fields.fluid, above,
                                                     model_.velocity_scale(), force_balance_ - 1, time, passed);
  const auto height = fluid::bed_height(profile);
  bed_height_ = height.value_or(0);
  std::vector<std::optional<double>> row{time, model_.last_step().step, height, drop, weight};
  for (std::size_t j = 0; j < constants.species(); ++j) {
    row.push_back(fluid::centre(profile, j));
    row.push_back(mass[j]);
  }
  row.insert(row.end(), {fluid::interface_height(profile), fluid::mixing(profile), now.most_solids, -now.fraction_below,
                         now.divergence});
  if (constants.openings.present())
    for (std::size_t j = 0; j < constants.species(); ++j)
      row.insert(row.end(), {passed[j].in * constants.density[j], passed[j].out * constants.density[j]});
  history_.write_row(row);
}

void Observers::write_fields(double time) {
  const core::Grid& grid = model_.constants().grid;
  const Fields& fields = model_.fields();
  std::vector<std::vector<double>> rows{fluid::lateral_mean(grid, fields.fluid.voidage),
                                        fluid::lateral_mean(grid, fields.fluid.pressure)};
  std::vector<core::FaceField> velocities{core::cell_means(grid, fields.fluid.velocity)};
  for (const core::FaceField& u : fields.solids.velocity) velocities.push_back(core::cell_means(grid, u));
  const auto components = [&](const core::FaceField& u) {
    core::FieldValues values;
    for (int a = 0; a < grid.dimensions; ++a) values.emplace_back(u[std::size_t(a)]);
    return values;
  };
  std::vector<core::FieldValues> values{{fields.fluid.voidage}, {fields.fluid.pressure}, components(velocities[0])};
  for (std::size_t j = 0; j < fields.solids.species(); ++j) {
    rows.push_back(fluid::lateral_mean(grid, fields.solids.fraction[j]));
    rows.push_back(fluid::lateral_mean(grid, velocities[j + 1][1]));
    values.push_back({fields.solids.fraction[j]});
    values.push_back(components(velocities[j + 1]));
  }
  profiles_.write_row(time, rows);
  fields_.write_step(time, values);
}

void Observers::log_step() {
  const StepLine& step = model_.last_step();
  const std::string row = fmt::format("{},{},{:.4g},\"{}\"\n", step.time, step.step, step.error_norm, step.limited_by);
  if (std::fwrite(row.data(), 1, row.size(), steps_.get()) != row.size() || std::fflush(steps_.get()) != 0)
    fail(steps_path_);
}

}  // namespace polybed::tfm
