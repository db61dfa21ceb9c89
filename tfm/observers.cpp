#include "tfm/observers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/numerics/blocks.hpp"
#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/rows.hpp"
#include "tfm/mean_flow.hpp"
#include "tfm/packing_limit.hpp"

namespace polybed::tfm {

namespace {

constexpr std::size_t last_steps_kept = 10;  // reported by a failed run

std::vector<double> slab_centres(const core::Grid& grid) {
  std::vector<double> y;
  for (std::size_t k = 0; k < measures::slabs_of(grid); ++k) y.push_back((double(k) + 0.5) * grid.spacing[1]);
  return y;
}

/// Whether there are granular temperatures to write, as unknowns or from a local balance.
bool knows_temperature(const Model& model) { return !model.fields().solids.temperature.empty(); }

std::vector<std::string> profile_names(const Constants& constants, bool temperature) {
  std::vector<std::string> names{"voidage", "p"};
  if (!measures::areas_of_slabs(constants.grid).empty()) names.emplace_back(core::area_of_slabs);
  for (const std::string& name : constants.name) {
    names.push_back("phi_" + name);
    names.push_back("u_" + name);
    if (temperature) names.push_back("theta_" + name);
  }
  return names;
}

std::vector<core::FieldName> field_names(const Constants& constants, bool temperature, bool compressible) {
  std::vector<core::FieldName> names{{"voidage"}, {"pressure"}, {"u_fluid", true}};
  for (const std::string& name : constants.name) {
    names.push_back({"phi_" + name});
    names.push_back({"u_" + name, true});
    if (temperature) names.push_back({"theta_" + name});
  }
  if (compressible) names.insert(names.end(), {{"total_pressure"}, {"density_fluid"}});
  for (const measures::Kind& kind : measures::divided_species(constants.name))
    names.push_back({.name = "phi_" + kind.name, .sum = true});
  return names;
}

constexpr const char* header_of_steps = "time_s,dt_s,error_norm,limited_by\n";

}  // namespace

namespace {

core::FieldValues components(const core::Grid& grid, const core::FaceField& u) {
  return {u.begin(), u.begin() + grid.dimensions};
}

}  // namespace

core::Field shown_temperature(const core::Field& fraction, const core::Field& temperature) {
  constexpr double absent_below = 1e-6;
  core::Field shown = temperature;
  for (std::size_t c = 0; c < shown.size(); ++c)
    if (!(fraction[c] >= absent_below)) shown[c] = 0;
  return shown;
}

std::vector<double> mean_temperature(const core::Grid& grid, const core::Field& fraction, const core::Field& shown) {
  core::Field weight = fraction, weighted = shown;
  for (std::size_t c = 0; c < weight.size(); ++c) {
    weight[c] = std::max(fraction[c], 0.0);
    weighted[c] *= weight[c];
  }
  std::vector<double> mean = measures::lateral_mean(grid, weighted);
  const std::vector<double> solids = measures::lateral_mean(grid, weight);
  for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = mean[k] > 0 ? mean[k] / solids[k] : 0;
  return mean;
}

std::vector<double> masses(const Model& model) {
  std::vector<double> mass = measures::species_volumes(model.constants().grid, model.fields().solids);
  for (std::size_t j = 0; j < mass.size(); ++j) mass[j] *= model.constants().density[j];
  return mass;
}

namespace {

/// The block's contribution to the profile of the fields last shown.
measures::Profile part_of_profile(const Model& model) {
  const core::Grid& grid = model.constants().grid;
  measures::Profile profile;
  profile.slab = grid.spacing[1];
  profile.areas = measures::areas_of_slabs(grid);
  for (const core::Field& phi : model.fields().solids.fraction)
    profile.fraction.push_back(measures::part_of_lateral_mean(grid, phi));
  profile.pressure = measures::part_of_lateral_mean(grid, model.fields().fluid.pressure, measures::Within::linear);
  return profile;
}

/// Net pressure at the bottom minus the top, Pa. In the lowest half cell it falls by the weight of the solids there:
/// from the pressures alone, linear, a heavy layer of one cell under a light bed would count half.
double pressure_drop_of(const measures::Profile& profile, const Constants& constants) {
  const double linear = measures::pressure_drop(profile);
  if (profile.slabs() < 2) return linear;
  double weight[2] = {0, 0};
  for (std::size_t j = 0; j < constants.species(); ++j)
    for (std::size_t k = 0; k < 2; ++k)
      weight[k] += profile.fraction[j][k] * (constants.density[j] - constants.fluid.density);
  if (!(weight[0] * weight[1] > 0)) return linear;
  const double share = weight[0] / (weight[0] + weight[1]);  // of the fall between the centres of both cells
  return linear + (share - 0.5) * (profile.pressure[0] - profile.pressure[1]);
}

}  // namespace

Observers::Observers(const Model& model, const std::filesystem::path& directory, double rtol,
                     std::vector<double> initial_mass, std::optional<double> resume_time)
    : model_(model),
      ranks_(model.constants().grid.ranks.get()),
      invariants_(std::move(initial_mass), model.constants().name, rtol, model.effects().compressible != nullptr),
      history_(measures::bed_table(around()),
               history_table(model.effects().compressible != nullptr, model.constants().openings.present(),
                             model.has_open_sides(), around(), model.exits().names()),
               model.constants().name) {
  const Constants& constants = model.constants();
  const bool compressible = model.effects().compressible != nullptr;
  core::on_first(ranks_, [&] {
    const std::filesystem::path steps = directory / "steps.csv";
    files_.reset(new Files{
        {directory, history_.columns(), resume_time},
        {directory, slab_centres(constants.grid), profile_names(constants, knows_temperature(model)), resume_time},
        {steps, core::kept_rows(steps, header_of_steps, resume_time)}});
  });
  fields_.emplace(directory, constants.grid, field_names(constants, knows_temperature(model), compressible),
                  resume_time);
}

core::Json Observers::past() const {
  const LeastWellPosed& least = least_well_posed_;
  core::Json past = {{"invariants", measures::past_of(invariants_.worst())}, {"force_balance", force_balance_}};
  if (std::isfinite(least.cell.least))
    past["well_posed"] = {least.cell.least,     least.cell.critical_slope, least.cell.place[0],
                          least.cell.place[1],  least.cell.place[2],       least.time,
                          least.share_below_now};
  return past;
}

void Observers::recall(const core::Json& past) {
  invariants_.recall(core::member_of(past, "invariants"));
  force_balance_ = core::number_of(core::member_of(past, "force_balance"));
  if (!past.contains("well_posed")) return;
  std::vector<double> numbers;
  for (const core::Json& number : core::array_of(past["well_posed"])) numbers.push_back(core::number_of(number));
  numbers.resize(7);
  least_well_posed_ = {{numbers[0], numbers[1], {numbers[2], numbers[3], numbers[4]}, 0}, numbers[5], numbers[6]};
}

void Observers::flush() {
  core::on_first(ranks_, [&] { files_->history.flush(); });
}

void Observers::write_history(double time) {
  const Constants& constants = model_.constants();
  const Fields& fields = model_.fields();
  const auto& stress = model_.effects().solids_stress;
  measures::Bed bed{.profile = part_of_profile(model_), .time = time, .step = model_.last_step().step};
  measures::Watched watched(constants.grid, fields.solids, fields.fluid, packing_above(constants, fields, stress.get()),
                            model_.velocity_scale());
  WellPosednessOfBlocks well_posed(constants, fields);
  core::Reduction all;
  for (std::vector<double>& phi : bed.profile.fraction) all.sum(phi);
  all.sum(bed.profile.pressure);
  watched.put_into(all);
  well_posed.put_into(all);
  all.over(ranks_);

  const double area = constants.grid.spacing[0] * constants.grid.spacing[2] * core::open_cells_of_layer(constants.grid);
  for (std::size_t j = 0; j < constants.species(); ++j) {
    bed.mass.push_back(watched.volume[j] * constants.density[j]);
    const std::vector<double>& phi = bed.profile.fraction[j];
    // A sloping wall supports part of the weight of the solids, or presses from above.
    const double carried = bed.profile.areas.empty() ? bed.mass[j]
                                                     : std::accumulate(phi.begin(), phi.end(), 0.0) * bed.profile.slab *
                                                           constants.density[j] * area;
    bed.buoyant_weight +=
        carried * (1 - constants.fluid.density / constants.density[j]) * constants.gravity * -constants.down[1] / area;
  }
  bed.pressure_drop =
      around() ? -model_.mean_gradient() * constants.grid.column_height() : pressure_drop_of(bed.profile, constants);
  force_balance_ = bed.buoyant_weight != 0 ? *bed.pressure_drop / bed.buoyant_weight : 0;
  if (!around()) bed_height_ = measures::bed_height(bed.profile);
  const std::vector<measures::Value> row = history_.row(bed, told(watched, time));
  watch(bed.time, well_posed.column());
  core::on_first(ranks_, [&] { files_->history.write_row(row); });
}

Told Observers::told(const measures::Watched& column, double time) {
  const Constants& constants = model_.constants();
  const auto account = model_.fluid_account(time);
  const double fluid_mass = account ? fluid::fluid_mass(constants.grid, model_.fields().fluid) : 0;
  const std::vector<fluid::Passed> passed = model_.passed();
  const measures::InvariantValues now = invariants_.see(column, constants.density, force_balance_ - 1, time, passed,
                                                        account ? account->error(fluid_mass) : 0);
  const Fields& fields = model_.fields();
  Told told{.invariants = now,
            .fluid_mass = fluid_mass,
            .account = account.value_or(fluid::MassAccount{}),
            .in = {},
            .out = {},
            .overflow = model_.overflow(),
            .exit_flow = model_.exits().flows(time, fields.fluid.flux),
            .exit_mass = model_.exits().passed(constants.openings, fields.solids)};
  if (around()) told.box = box_flow(constants, model_.mean_gradient(), fields);
  for (std::vector<double>& species : told.exit_mass)
    for (std::size_t j = 0; j < species.size(); ++j) species[j] *= constants.density[j];
  for (std::size_t j = 0; j < passed.size(); ++j) {
    told.in.push_back(passed[j].in * constants.density[j]);
    told.out.push_back(passed[j].out * constants.density[j]);
  }
  return told;
}

void Observers::watch(double time, const WellPosedness& now) {
  LeastWellPosed& least = least_well_posed_;
  least.share_below_now = now.share_below;
  if (now.lacks_more_than(least.cell)) {
    least.cell = now;
    least.time = time;
  }
}

void Observers::write_fields(double time) {
  const core::Grid& grid = model_.constants().grid;
  const Fields& fields = model_.fields();
  std::vector<std::vector<double>> rows;
  core::Reduction all;
  const auto add_mean = [&](const core::Field& field, measures::Within layers = measures::Within::even) {
    rows.push_back(measures::part_of_lateral_mean(grid, field, layers));
    all.sum(rows.back());  // its numbers keep their addresses when others are added
  };
  add_mean(fields.fluid.voidage);
  add_mean(fields.fluid.pressure, measures::Within::linear);
  if (const std::vector<double> areas = measures::areas_of_slabs(grid); !areas.empty()) rows.push_back(areas);
  std::vector<core::FaceField> velocities{core::cell_means(grid, fields.fluid.velocity)};
  for (const core::FaceField& u : fields.solids.velocity) velocities.push_back(core::cell_means(grid, u));
  std::vector<core::Field> temperatures;
  for (std::size_t j = 0; j < fields.solids.species() && knows_temperature(model_); ++j)
    temperatures.push_back(shown_temperature(fields.solids.fraction[j], fields.solids.temperature[j]));
  std::vector<core::FieldValues> values{
      {fields.fluid.voidage}, {fields.fluid.pressure}, components(grid, velocities[0])};
  for (std::size_t j = 0; j < fields.solids.species(); ++j) {
    add_mean(fields.solids.fraction[j]);
    add_mean(velocities[j + 1][1]);
    values.push_back({fields.solids.fraction[j]});
    values.push_back(components(grid, velocities[j + 1]));
    if (!knows_temperature(model_)) continue;
    const core::Field& shown = temperatures[j];
    rows.push_back(mean_temperature(grid, fields.solids.fraction[j], shown));
    values.push_back({shown});
  }
  core::Field total;
  if (model_.effects().compressible) {
    total = model_.effects().compressible->total_pressure(fields.fluid);
    values.push_back({total});
    values.push_back({fields.fluid.compression.density});
  }
  std::vector<core::Field> sums;
  for (const measures::Kind& kind : measures::divided_species(model_.constants().name))
    sums.push_back(measures::sum_of(fields.solids.fraction, kind.members));
  for (const core::Field& sum : sums) values.push_back({sum});
  all.over(ranks_);
  core::on_first(ranks_, [&] { files_->profiles.write_row(time, rows); });
  fields_->write_step(time, values);
}

void Observers::log_step() {
  const StepLine& step = model_.last_step();
  last_steps_.push_back(step);
  if (last_steps_.size() > last_steps_kept) last_steps_.pop_front();
  const std::string row = fmt::format("{},{},{:.4g},\"{}\"\n", step.time, step.step, step.error_norm, step.limited_by);
  core::on_first(ranks_, [&] { files_->steps.append(row); });
}

}  // namespace polybed::tfm
