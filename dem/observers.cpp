#include "dem/observers.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/numerics/messages.hpp"
#include "core/numerics/metric.hpp"
#include "dem/parallel/gathered.hpp"
#include "measures/bed.hpp"

namespace polybed::dem {

namespace {

std::vector<std::string> names_of(const Model& model) {
  std::vector<std::string> names;
  for (const Species& s : model.materials().species()) names.push_back(s.name);
  return names;
}

Parts parts_of(const Model& model, const core::Scene& scene) {
  const Coupling* coupling = model.coupling();
  return {.ledger = scene.dem.ledger,
          .outflow = model.outflow() != nullptr,
          .fluid = coupling != nullptr,
          .feeding = model.feeding() != nullptr,
          .compressible = coupling != nullptr && coupling->flow().compressible() != nullptr,
          .open_sides = coupling != nullptr && coupling->flow().has_open_sides(),
          .around = scene.flows_around(),
          .exits = fluid::names_of_exits(scene)};
}

std::vector<std::string> profile_names(const Model& model, const measures::Slabs& slabs) {
  std::vector<std::string> names{"voidage"};
  if (!slabs.areas.empty()) names.emplace_back(core::area_of_slabs);
  for (const Species& s : model.materials().species())
    for (const char* what : {"phi_", "u_", "theta_"}) names.push_back(what + s.name);
  if (model.coupling() != nullptr)
    for (const std::string& name : FluidOutput::profile_names()) names.push_back(name);
  return names;
}

/// Weight of the particles minus the weight of the displaced fluid, each over the cross-section at its height, Pa. In a
/// tapered column this is the load on the fluid: the walls carry the rest, or press from above.
double weight_of(const Model& model, const measures::Bed& bed, double area) {
  double weight = 0;
  for (std::size_t j = 0; j < bed.mass.size(); ++j) {
    const double displaced = model.coupling() == nullptr ? 0 : model.coupling()->flow().constants().density;
    const double density = model.materials().species()[j].density;
    const std::vector<double>& phi = bed.profile.fraction[j];
    const double carried = bed.profile.areas.empty()
                               ? bed.mass[j] / area
                               : std::accumulate(phi.begin(), phi.end(), 0.0) * bed.profile.slab * density;
    weight += carried * (1 - displaced / density);
  }
  return weight * std::abs(model.gravity()[1]);
}

std::vector<double> slab_centres(const measures::Slabs& slabs) {
  std::vector<double> y;
  for (std::size_t k = 0; k < slabs.count; ++k) y.push_back((double(k) + 0.5) * slabs.thickness());
  return y;
}

measures::Slabs slabs_of(const Model& model, const core::Column& column) {
  measures::Slabs slabs{column.cross_section(), model.box().size[1], std::size_t(column.even_layers()),
                        model.box().periodic[1], model.box().image_speed()};
  const double thickness = slabs.thickness();
  for (std::size_t k = 0; k < slabs.count && column.is_tapered(); ++k)
    slabs.areas.push_back(column.area_between(double(k) * thickness, double(k + 1) * thickness));
  if (slabs.areas.empty() && model.coupling() != nullptr)
    slabs.areas = measures::areas_of_slabs(model.coupling()->flow().grid());
  return slabs;
}

/// Values that set the units of the sums over particles: for this rank, or for all after a reduction.
struct Greatest {
  measures::ParticleExtremes of;
  double height = 0;  ///< m

  void put_into(core::Reduction& all) {
    for (double* value : {&of.volume, &of.momentum, &of.energy, &height}) all.greatest(*value);
  }
};

Greatest greatest_of(const Model& model) {
  const Particles& particles = model.particles();
  std::vector<double> volume;
  for (const Species& s : model.materials().species())
    volume.push_back(measures::sphere_volume_below(s.radius, 0, s.radius));
  Greatest most;
  const double image_speed = std::abs(model.box().image_speed());
  for (std::size_t i = 0; i < particles.owned; ++i) {
    Vector v = particles.motion[i].v;
    v[0] = std::abs(v[0]) + image_speed;  // for the faster image
    most.of.add(volume[std::size_t(particles.species[i])], v);
    most.height = std::max(most.height, std::abs(particles.place[i].x[1]));
  }
  most.of.particles = model.particle_count();
  return most;
}

/// The bed of particles as a profile; every rank sums over its own particles, and nothing is gathered. After a
/// reduction it is the same on every rank, and on any number of ranks to the bit.
class BedSums {
 public:
  /// \param most  over all ranks
  BedSums(const Model& model, const measures::Slabs& slabs, const Greatest& most)
      : slabs_(slabs),
        species_(model.materials().species().size()),
        height_unit_(model.particle_count(), most.height),
        heights_(species_, 0),
        number_(species_, 0) {
    const Particles& particles = model.particles();
    measures::ParticleAdder adder(species_, slabs, most.of);
    std::vector<measures::SteadySum> height(species_, height_unit_);
    for (std::size_t i = 0; i < particles.owned; ++i) {
      const auto j = std::size_t(particles.species[i]);
      const Place& place = particles.place[i];
      adder.add(j, place.radius, place.x[1], particles.motion[i].v);
      height[j].add(place.x[1]);
      ++number_[j];
    }
    sums_ = adder.take();
    for (std::size_t j = 0; j < species_; ++j) heights_[j] = height[j].units();
  }
  void put_into(core::Reduction& all) {
    for (std::vector<std::int64_t>* sums : {&sums_.sum, &heights_, &number_}) all.sum(*sums);
  }

  [[nodiscard]] measures::ParticleProfile profile() const { return particle_profile(sums_, species_, slabs_); }
  /// Number of particles of each species.
  [[nodiscard]] const std::vector<std::int64_t>& number() const { return number_; }
  /// Mean height of the centres of each species, m.
  [[nodiscard]] std::vector<std::optional<double>> centre() const {
    std::vector<std::optional<double>> found(species_);
    for (std::size_t j = 0; j < species_; ++j)
      if (number_[j] > 0) found[j] = height_unit_.value_of(heights_[j]) / double(number_[j]);
    return found;
  }

 private:
  measures::Slabs slabs_;
  std::size_t species_;
  measures::SteadySum height_unit_;
  measures::ParticleSums sums_;
  std::vector<std::int64_t> heights_, number_;
};

/// Collective.
measures::ParticleProfile profile_of(const Model& model, const measures::Slabs& slabs) {
  Greatest most = greatest_of(model);
  core::Reduction greatest, all;
  most.put_into(greatest);
  greatest.over(model.ranks());
  BedSums sums(model, slabs, most);
  sums.put_into(all);
  all.over(model.ranks());
  return sums.profile();
}

}  // namespace

Observers::Observers(const Model& model, const core::Scene& scene, const std::filesystem::path& directory,
                     std::optional<RunStart> start, const FluidTotals& fluid, std::optional<double> resume_time)
    : model_(model),
      slabs_(slabs_of(model, scene.column)),
      exits_(model.coupling() != nullptr ? fluid::Exits(model.coupling()->flow().grid(), scene) : fluid::Exits()),
      history_(measures::bed_table(scene.flows_around()), history_table(parts_of(model, scene)), names_of(model)),
      particles_(directory, {model.box().size, model.box().periodic, names_of(model)}, resume_time, model.share()),
      totals_(totals_of(model)),
      invariants_(model, start ? std::move(*start) : RunStart{totals_.sum(), numbers_of(model)}, scene.dem.ledger) {
  const Coupling* coupling = model.coupling();
  if (coupling != nullptr) fluid_.emplace(*coupling, model.ranks(), fluid);
  core::on_first(model.ranks(), [&] {
    files_.reset(new Files{{directory, history_.columns(), resume_time},
                           {directory, slab_centres(slabs_), profile_names(model, slabs_), resume_time},
                           nullptr});
    if (coupling != nullptr)
      files_->fluid = std::make_unique<FluidOutput>(*coupling, names_of(model), directory, resume_time);
  });
}

void Observers::see_step() {
  if (fluid_) fluid_->see();
}

void Observers::flush() {
  core::on_first(model_.ranks(), [&] { files_->history.flush(); });
}

void Observers::write_history(double time) {
  see_step();
  TotalsOfRanks totals(model_);
  Greatest most = greatest_of(model_);
  double most_solids = model_.coupling() != nullptr ? model_.coupling()->most_solids() : 0;
  const fluid::Flow* flow = model_.coupling() != nullptr ? &model_.coupling()->flow() : nullptr;
  const double overflow = flow != nullptr ? flow->overflow() : 0;
  const double fluid_flux = is_around() ? model_.coupling()->fluid_flux() : 0;
  std::vector<double> exit_flow;
  if (flow != nullptr) exit_flow = exits_.flows(time, flow->state().flux);
  core::Reduction greatest, all;
  totals.put_greatest_into(greatest);
  most.put_into(greatest);
  greatest.greatest(most_solids);
  greatest.over(model_.ranks());
  BedSums sums(model_, slabs_, most);
  totals.put_sums_into(all);
  sums.put_into(all);
  all.over(model_.ranks());

  totals_ = totals.totals();
  const std::vector<std::int64_t>& number = sums.number();
  invariants_.see(totals_, number, fluid());
  measures::Bed bed{
      .profile = sums.profile().solids, .time = time, .step = model_.limits().dt, .centre = sums.centre()};
  for (std::size_t j = 0; j < number.size(); ++j)
    bed.mass.push_back(double(number[j]) * model_.materials().species()[j].mass);
  // Without a fluid only the bottom carries the bed: there is no pressure drop.
  bed.pressure_drop = fluid_ ? fluid_->pressure_drop() : 0;
  bed.buoyant_weight = weight_of(model_, bed, slabs_.area);
  core::on_first(model_.ranks(), [&] {
    if (!is_around()) bed_height_ = measures::bed_height(bed.profile);
    Told own = told(most_solids, overflow, std::move(exit_flow));
    if (is_around()) own.box = box_flow(sums.profile(), fluid_flux);
    files_->history.write_row(history_.row(bed, own));
  });
}

bool Observers::is_around() const { return model_.coupling() != nullptr && model_.box().periodic[1]; }

measures::BoxFlow Observers::box_flow(const measures::ParticleProfile& profile, double fluid_flux) const {
  const fluid::Flow& flow = model_.coupling()->flow();
  measures::BoxFlow box{.gradient = flow.mean_gradient()};
  const double fluid_density = flow.constants().density;
  double mass = fluid_density, momentum = fluid_density * fluid_flux;
  for (std::size_t j = 0; j < profile.velocity.size(); ++j) {
    const std::vector<double>& phi = profile.solids.fraction[j];
    const double volume = std::accumulate(phi.begin(), phi.end(), 0.0);
    const double carried = std::inner_product(phi.begin(), phi.end(), profile.velocity[j].begin(), 0.0);
    box.fraction.push_back(volume / double(phi.size()));
    box.velocity.push_back(volume > 0 ? carried / volume : 0);
    const double density = model_.materials().species()[j].density;
    mass += (density - fluid_density) * box.fraction[j];
    momentum += density * box.fraction[j] * box.velocity[j];
  }
  box.fluid = fluid_flux / box.voidage();
  const auto& frame = model_.coupling()->frame();
  box.mass_velocity = frame ? frame->now[1] / frame->mass : momentum / mass;
  if (frame) box.moved = frame->velocity[1];
  return box;
}

Told Observers::told(double most_solids, double overflow, std::vector<double> exit_flow) const {
  Told told{totals_, most_solids, fluid_ ? fluid_->mass() : 0, {}, {}, {}, {}, overflow, std::move(exit_flow), {}};
  const auto tell = [this](const std::vector<std::int64_t>& passed, std::vector<double>& number,
                           std::vector<double>& mass) {
    for (std::size_t j = 0; j < passed.size(); ++j) {
      number.push_back(double(passed[j]));
      mass.push_back(number[j] * model_.materials().species()[j].mass);
    }
  };
  if (const Outflow* outflow = model_.outflow()) {
    tell(outflow->number, told.number_out, told.mass_out);
    for (const std::vector<std::int64_t>& one : outflow->number_at) {
      std::vector<double> number;
      tell(one, number, told.exit_mass.emplace_back());
    }
  }
  if (const Feeding* feeding = model_.feeding()) tell(feeding->number, told.number_in, told.mass_in);
  return told;
}

/// Each rank writes its share, piece by piece.
void Observers::write_all_particles(double time) {
  const Particles& particles = model_.particles();
  core::on_all(model_.ranks(), [&] {
    for (std::size_t i = 0; i < particles.owned; ++i) {
      const std::int64_t id = particles.id[i];
      core::require_finite("position", id, particles.place[i].x, time);
      core::require_finite("velocity", id, particles.motion[i].v, time);
      core::require_finite("spin", id, particles.motion[i].w, time);
    }
  });
  const ShownRows shown = shown_rows(particles, model_.share());
  particles_.write_step(time, shown.head, shown.vectors);
}

void Observers::write_particles(double time) {
  const measures::ParticleProfile profile = profile_of(model_, slabs_);
  std::optional<Coupling::Column> column;
  if (model_.coupling() != nullptr) column = model_.coupling()->column();
  core::on_first(model_.ranks(), [&] {
    std::vector<std::vector<double>> rows{std::vector<double>(slabs_.count, 0.0)};
    for (std::size_t k = 0; k < slabs_.count; ++k) rows[0][k] = 1 - profile.solids.solids_fraction(k);
    if (!slabs_.areas.empty()) rows.push_back(slabs_.areas);
    for (std::size_t j = 0; j < profile.velocity.size(); ++j) {
      rows.push_back(profile.solids.fraction[j]);
      rows.push_back(profile.velocity[j]);
      rows.push_back(profile.temperature[j]);
    }
    if (column)
      for (std::vector<double>& row : FluidOutput::profiles(*column)) rows.push_back(std::move(row));
    files_->profiles.write_row(time, rows);
  });
  write_all_particles(time);
  if (!column) return;
  const Snapshot snapshot = gathered_snapshot(model_.particles(), model_.share());
  core::on_first(model_.ranks(), [&] { files_->fluid->write(time, *column, snapshot.view()); });
}

}  // namespace polybed::dem
