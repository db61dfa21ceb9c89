#include "dem/observers.hpp"

#include <algorithm>
#include <cmath>

#include "core/ranks.hpp"
#include "dem/gathered.hpp"
#include "fluid/measures.hpp"

namespace polybed::dem {

namespace {

std::vector<std::string> history_columns(const Materials& materials, bool ledger) {
  std::vector<std::string> columns{"time_s", "dt_s", "bed_height_m", "pressure_drop_Pa", "buoyant_weight_Pa"};
  for (const Species& s : materials.species()) {
    columns.push_back("centre_" + s.name + "_m");
    columns.push_back("mass_" + s.name + "_kg");
  }
  columns.insert(columns.end(), {"interface_m", "kinetic_J", "rotational_J", "elastic_J", "potential_J"});
  if (ledger) columns.insert(columns.end(), {"dissipated_J", "work_J"});
  columns.insert(columns.end(), {"contacts", "max_overlap_m", "max_contact_force_N"});
  return columns;
}

std::vector<std::string> profile_names(const Materials& materials) {
  std::vector<std::string> names{"voidage"};
  for (const Species& s : materials.species())
    for (const char* what : {"phi_", "u_", "theta_"}) names.push_back(what + s.name);
  return names;
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

std::vector<double> slab_centres(const fluid::Slabs& slabs) {
  std::vector<double> y;
  for (std::size_t k = 0; k < slabs.count; ++k) y.push_back((double(k) + 0.5) * slabs.thickness());
  return y;
}

}  // namespace

Observers::Observers(const Model& model, const core::Scene& scene, const std::filesystem::path& directory,
                     std::optional<double> initial_energy, std::optional<double> resume_time)
    : model_(model),
      slabs_{model.box().size[0] * model.box().size[2], model.box().size[1], std::size_t(scene.column.cells[1])},
      has_ledger_(scene.dem.ledger),
      totals_(totals_of(model)) {
  initial_energy_ = initial_energy.value_or(totals_.sum());
  core::on_first(model.ranks(), [&] {
    core::ParticleScene particles{model.box().size, model.box().periodic, {}};
    for (const Species& s : model.materials().species()) particles.species.push_back(s.name);
    files_.reset(new Files{{directory, history_columns(model.materials(), has_ledger_), resume_time},
                           {directory, slab_centres(slabs_), profile_names(model.materials()), resume_time},
                           {directory, particles, resume_time}});
  });
}

void Observers::close_ledger() {
  totals_ = totals_of(model_);
  if (!has_ledger_) return;
  greatest_energy_ = std::max({greatest_energy_, totals_.kinetic + totals_.rotational, totals_.dissipated});
  if (greatest_energy_ > 0)
    ledger_error_ = std::max(ledger_error_, std::abs(totals_.sum() - initial_energy_) / greatest_energy_);
}

void Observers::write_history(double time) {
  close_ledger();
  const std::vector<Particle> all = gathered_particles(model_.particles(), model_.share());
  const double pressure_drop = model_.coupling() != nullptr ? model_.coupling()->pressure_drop() : 0;
  core::on_first(model_.ranks(), [&] {
    const auto& species = model_.materials().species();
    std::vector<double> mass(species.size(), 0.0), density;
    for (const Species& s : species) density.push_back(s.density);
    for (const Particle& p : all) mass[std::size_t(p.species)] += species[std::size_t(p.species)].mass;
    const Snapshot snapshot(all);
    const fluid::Profile profile = fluid::particle_profile(snapshot.view(), species.size(), slabs_).solids;
    const fluid::ParticleHeights heights = fluid::particle_heights(snapshot.view(), density);
    const auto height = fluid::bed_height(profile);
    bed_height_ = height.value_or(0);
    double weight = 0;
    for (const double m : mass) weight += m;
    weight *= std::abs(model_.gravity()[1]) / slabs_.area;
    double drop = 0;  // without a fluid nothing carries the bed but its bottom
    if (const Coupling* coupling = model_.coupling()) {
      drop = pressure_drop;
      weight = 0;
      for (std::size_t j = 0; j < species.size(); ++j)
        weight -= mass[j] * coupling->motion().net_gravity(std::int32_t(j))[1] / slabs_.area;
    }
    std::vector<std::optional<double>> row{time, model_.limits().dt, height, drop, weight};
    for (std::size_t j = 0; j < species.size(); ++j) {
      row.push_back(heights.mean[j]);
      row.push_back(mass[j]);
    }
    const Totals& t = totals_;
    row.insert(row.end(), {fluid::interface_height(profile), t.kinetic, t.rotational, t.elastic, t.potential});
    if (has_ledger_) row.insert(row.end(), {t.dissipated, t.work});
    row.insert(row.end(), {double(t.contacts), t.max_overlap, t.max_force});
    files_->history.write_row(row);
  });
}

void Observers::write_particles(double time) {
  const std::vector<Particle> all = gathered_particles(model_.particles(), model_.share());
  core::on_first(model_.ranks(), [&] {
    const Snapshot snapshot(all);
    const std::size_t species = model_.materials().species().size();
    const fluid::ParticleProfile profile = fluid::particle_profile(snapshot.view(), species, slabs_);
    std::vector<std::vector<double>> rows{std::vector<double>(slabs_.count, 0.0)};
    for (std::size_t k = 0; k < slabs_.count; ++k) rows[0][k] = 1 - profile.solids.solids_fraction(k);
    for (std::size_t j = 0; j < species; ++j) {
      rows.push_back(profile.solids.fraction[j]);
      rows.push_back(profile.velocity[j]);
      rows.push_back(profile.temperature[j]);
    }
    files_->profiles.write_row(time, rows);
    files_->particles.write_step(time, snapshot.view());
  });
}

}  // namespace polybed::dem
