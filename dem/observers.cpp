#include "dem/observers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/ranks.hpp"
#include "dem/parallel/gathered.hpp"
#include "measures/bed.hpp"

namespace polybed::dem {

namespace {

std::vector<std::string> history_columns(const Model& model, bool ledger) {
  const Materials& materials = model.materials();
  std::vector<std::string> columns{"time_s", "dt_s", "bed_height_m", "pressure_drop_Pa", "buoyant_weight_Pa"};
  for (const Species& s : materials.species()) {
    columns.push_back("centre_" + s.name + "_m");
    columns.push_back("mass_" + s.name + "_kg");
  }
  columns.insert(columns.end(), {"interface_m", "mixing", "kinetic_J", "rotational_J", "elastic_J", "potential_J"});
  if (ledger) columns.insert(columns.end(), {"dissipated_J", "work_J"});
  if (ledger && model.outflow() != nullptr) columns.emplace_back("carried_out_J");
  columns.insert(columns.end(), {"contacts", "max_overlap_m", "max_contact_force_N"});
  if (const Coupling* coupling = model.coupling()) {
    columns.emplace_back("max_solids_fraction");
    if (coupling->flow().compressible() != nullptr) columns.emplace_back("mass_fluid_kg");
  }
  if (model.outflow() != nullptr)
    for (const Species& s : materials.species())
      columns.insert(columns.end(), {"out_" + s.name, "out_" + s.name + "_kg"});
  return columns;
}

std::vector<std::string> profile_names(const Model& model) {
  std::vector<std::string> names{"voidage"};
  for (const Species& s : model.materials().species())
    for (const char* what : {"phi_", "u_", "theta_"}) names.push_back(what + s.name);
  if (model.coupling() != nullptr)
    for (const std::string& name : FluidOutput::profile_names()) names.push_back(name);
  return names;
}

/// Weight of the particles less that of the fluid that they displace, if there is one, over the area, Pa.
double weight_of(const Model& model, const std::vector<double>& mass, double area) {
  double weight = 0;
  for (std::size_t j = 0; j < mass.size(); ++j) {
    const double displaced = model.coupling() == nullptr ? 0 : model.coupling()->flow().constants().density;
    weight += mass[j] * (1 - displaced / model.materials().species()[j].density);
  }
  return weight * std::abs(model.gravity()[1]) / area;
}

/// Particles by component, as the files want them.
struct Snapshot {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> species;
  std::vector<double> radius;
  std::vector<Vector> position, velocity, spin;

  explicit Snapshot(const std::vector<Particle>& particles) {
    for (const Particle& p : particles) {
      id.push_back(p.id);
      species.push_back(p.species);
      radius.push_back(p.place.radius);
      position.push_back(p.place.x);
      velocity.push_back(p.motion.v);
      spin.push_back(p.motion.w);
    }
  }
  [[nodiscard]] core::ParticleSnapshot view() const { return {id, species, radius, position, velocity, spin}; }
};

std::vector<double> slab_centres(const measures::Slabs& slabs) {
  std::vector<double> y;
  for (std::size_t k = 0; k < slabs.count; ++k) y.push_back((double(k) + 0.5) * slabs.thickness());
  return y;
}

}  // namespace

Observers::Observers(const Model& model, const core::Scene& scene, const std::filesystem::path& directory,
                     std::optional<RunStart> start, const FluidTotals& fluid, std::optional<double> resume_time)
    : model_(model),
      slabs_{model.box().size[0] * model.box().size[2], model.box().size[1], std::size_t(scene.column.cells[1])},
      has_ledger_(scene.dem.ledger),
      totals_(totals_of(model)),
      invariants_(model, start ? std::move(*start) : RunStart{totals_.sum(), numbers_of(model)}, has_ledger_) {
  const Coupling* coupling = model.coupling();
  if (coupling != nullptr) fluid_.emplace(*coupling, model.ranks(), fluid);
  core::on_first(model.ranks(), [&] {
    core::ParticleScene particles{model.box().size, model.box().periodic, {}};
    for (const Species& s : model.materials().species()) particles.species.push_back(s.name);
    files_.reset(new Files{{directory, history_columns(model, has_ledger_), resume_time},
                           {directory, slab_centres(slabs_), profile_names(model), resume_time},
                           {directory, particles, resume_time},
                           nullptr});
    if (coupling != nullptr)
      files_->fluid = std::make_unique<FluidOutput>(*coupling, particles.species, directory, resume_time);
  });
}

void Observers::see_step() {
  if (fluid_) fluid_->see();
}

void Observers::write_history(double time) {
  totals_ = totals_of(model_);
  see_step();
  invariants_.see(totals_, fluid());
  const std::vector<Particle> all = gathered_particles(model_.particles(), model_.share());
  const double most_solids = model_.coupling() != nullptr ? model_.coupling()->most_solids() : 0;
  core::on_first(model_.ranks(), [&] {
    const auto& species = model_.materials().species();
    std::vector<double> mass(species.size(), 0.0), density;
    for (const Species& s : species) density.push_back(s.density);
    for (const Particle& p : all) mass[std::size_t(p.species)] += species[std::size_t(p.species)].mass;
    const Snapshot snapshot(all);
    const measures::Profile profile = measures::particle_profile(snapshot.view(), species.size(), slabs_).solids;
    const measures::ParticleHeights heights = measures::particle_heights(snapshot.view(), density);
    bed_height_ = measures::bed_height(profile);
    files_->history.write_row(row_of(time, profile, heights, mass, most_solids));
  });
}

/// On the first rank. Without a fluid nothing carries the bed but its bottom: there is no pressure drop.
std::vector<std::optional<double>> Observers::row_of(double time, const measures::Profile& profile,
                                                     const measures::ParticleHeights& heights,
                                                     const std::vector<double>& mass, double most_solids) const {
  const double drop = fluid_ ? fluid_->pressure_drop() : 0, weight = weight_of(model_, mass, slabs_.area);
  std::vector<std::optional<double>> row{time, model_.limits().dt, measures::bed_height(profile), drop, weight};
  for (std::size_t j = 0; j < mass.size(); ++j) {
    row.push_back(heights.mean[j]);
    row.push_back(mass[j]);
  }
  const Totals& t = totals_;
  row.insert(row.end(), {measures::interface_height(profile), measures::mixing(profile), t.kinetic, t.rotational,
                         t.elastic, t.potential});
  if (has_ledger_) row.insert(row.end(), {t.dissipated, t.work});
  if (has_ledger_ && model_.outflow() != nullptr) row.emplace_back(t.carried_out);
  row.insert(row.end(), {double(t.contacts), t.max_overlap, t.max_force});
  if (fluid_) {
    row.push_back(most_solids);
    if (model_.coupling()->flow().compressible() != nullptr) row.push_back(fluid_->mass());
  }
  if (const Outflow* outflow = model_.outflow())
    for (std::size_t j = 0; j < mass.size(); ++j) {
      const auto number = double(outflow->number[j]);
      row.insert(row.end(), {number, number * model_.materials().species()[j].mass});
    }
  return row;
}

void Observers::write_particles(double time) {
  const std::vector<Particle> all = gathered_particles(model_.particles(), model_.share());
  std::optional<Coupling::Column> column;
  if (model_.coupling() != nullptr) column = model_.coupling()->column();
  core::on_first(model_.ranks(), [&] {
    const Snapshot snapshot(all);
    const std::size_t species = model_.materials().species().size();
    const measures::ParticleProfile profile = measures::particle_profile(snapshot.view(), species, slabs_);
    std::vector<std::vector<double>> rows{std::vector<double>(slabs_.count, 0.0)};
    for (std::size_t k = 0; k < slabs_.count; ++k) rows[0][k] = 1 - profile.solids.solids_fraction(k);
    for (std::size_t j = 0; j < species; ++j) {
      rows.push_back(profile.solids.fraction[j]);
      rows.push_back(profile.velocity[j]);
      rows.push_back(profile.temperature[j]);
    }
    if (column)
      for (std::vector<double>& row : FluidOutput::profiles(*column)) rows.push_back(std::move(row));
    files_->profiles.write_row(time, rows);
    files_->particles.write_step(time, snapshot.view());
    if (column) files_->fluid->write(time, *column, snapshot.view());
  });
}

}  // namespace polybed::dem
