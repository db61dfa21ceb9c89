// The whole state of the particles, to the bit, independent of how many ranks share them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "core/error.hpp"
#include "dem/model.hpp"
#include "dem/parallel/gathered.hpp"

namespace polybed::dem {

namespace {

/// Numbers as doubles: ids and counts below 2^53 are exact; sums in whole units are kept as two halves.
void store(std::vector<double>& out, std::int64_t units) {
  out.push_back(double(units >> 32));
  out.push_back(double(units & 0xffffffff));
}
std::int64_t recalled(const double* in) { return (std::int64_t(in[0]) << 32) + std::int64_t(in[1]); }

void write_sum(core::Checkpoint& checkpoint, const std::string& key, const EnergySum& sum) {
  checkpoint.integers[key] = sum.whole();
  checkpoint.integers[key + "_part"] = sum.part();
}

/// Of all ranks, on the first; 0 on the others and where a checkpoint has none, as of particles that were not sheared
/// before.
EnergySum sum_on_first(const core::Ranks* ranks, const core::Checkpoint& checkpoint, const std::string& key) {
  const auto found = [&](const std::string& name) {
    return core::is_first(ranks) && checkpoint.integers.contains(name) ? checkpoint.integers.at(name) : 0;
  };
  return {found(key), found(key + "_part")};
}

constexpr std::size_t particle_width = 2 + 9 + 12, contact_head = 2;

/// Particles that a file may hold, and where: ids are of one particle each, and nothing has left the world. What the
/// ranges leave open is what no check tells from a state.
void require_particles(const std::vector<double>& numbers, std::size_t species, const Vector& size) {
  constexpr double most_ids = 9007199254740992.0, fastest = 1e5, far = 100, half = 4294967296.0;
  if (numbers.size() % particle_width != 0) core::refuse_checkpoint("particles is cut short");
  std::unordered_set<double> ids;
  const double reach = far * *std::max_element(size.begin(), size.end());
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) core::refuse_checkpoint(fmt::format("the {} of a particle is {:g}", what, value));
  };
  for (const double* p = numbers.data(); p != numbers.data() + numbers.size(); p += particle_width) {
    require(p[0] >= 0 && p[0] < most_ids && p[0] == std::floor(p[0]) && ids.insert(p[0]).second, "number", p[0]);
    require(p[1] >= 0 && p[1] < double(species) && p[1] == std::floor(p[1]), "species", p[1]);
    for (std::size_t k = 2; k < 5; ++k) require(std::abs(p[k]) <= reach, "place", p[k]);
    for (std::size_t k = 5; k < 8; ++k) require(std::abs(p[k]) <= fastest, "velocity", p[k]);
    for (std::size_t k = 11; k < particle_width; ++k) require(std::abs(p[k]) <= half, "load", p[k]);
  }
}

/// The time of a run is that of its steps, or of a stop within a step of it.
/// \param began, began_at  time, s, and number of the first step of this length
void require_clock(double steps, double dt, double time, double began, double began_at) {
  const bool known = began >= 0 && began <= time + dt && began_at >= 0 && began_at <= steps;
  if (!known || !(std::abs(began + (steps - began_at) * dt - time) <= dt * (1 + 1e-6)))
    core::refuse_checkpoint(
        fmt::format("{} steps from {:g} s on, of {:g} s, do not end at {:g} s", steps - began_at, began, dt, time));
}

/// What a run may begin without, but not go on without.
void require_sums(const core::Checkpoint& checkpoint, bool ledger, bool fluid) {
  for (const char* key : {"dissipated", "dissipated_part"})
    if (ledger) (void)checkpoint.integer(key);
  if (!fluid) return;
  for (const char* key : {"fluid_work", "fluid_work_part", "fluid_steps"}) (void)checkpoint.integer(key);
  (void)checkpoint.array("fluid_loads");
}

/// Contacts of particles that are there.
void require_contacts(const std::vector<double>& numbers, std::size_t memory_size,
                      const std::vector<double>& particles) {
  const std::size_t width = contact_head + memory_size;
  if (numbers.size() % width != 0) core::refuse_checkpoint("contacts is cut short");
  std::unordered_set<double> ids;
  for (std::size_t n = 0; n < particles.size(); n += particle_width) ids.insert(particles[n]);
  for (std::size_t n = 0; n < numbers.size(); n += width)
    if (!ids.contains(numbers[n]) || (numbers[n + 1] >= 0 && !ids.contains(numbers[n + 1])))
      core::refuse_checkpoint(
          fmt::format("a contact of {:g} and {:g}, which are not there", numbers[n], numbers[n + 1]));
}

void write_particles(core::Checkpoint& checkpoint, const std::vector<Particle>& particles) {
  std::vector<double>& out = checkpoint.arrays["particles"];
  for (const Particle& p : particles) {
    out.push_back(double(p.id));
    out.push_back(p.species);
    out.insert(out.end(), p.place.x.begin(), p.place.x.end());
    out.insert(out.end(), p.motion.v.begin(), p.motion.v.end());
    out.insert(out.end(), p.motion.w.begin(), p.motion.w.end());
    for (const std::int64_t f : p.load.force) store(out, f);
    for (const std::int64_t t : p.load.torque) store(out, t);
  }
}

Particle read_particle(const double* in, const Materials& materials) {
  Particle p{};
  p.id = std::int64_t(in[0]);
  p.species = std::int32_t(in[1]);
  const Species& s = materials.species()[std::size_t(p.species)];
  p.place.radius = s.radius;
  p.motion.inverse_mass = 1 / s.mass;
  p.motion.inverse_inertia = 1 / s.inertia;
  for (std::size_t k = 0; k < 3; ++k) {
    p.place.x[k] = in[2 + k];
    p.motion.v[k] = in[5 + k];
    p.motion.w[k] = in[8 + k];
    p.load.force[k] = recalled(in + 11 + 2 * k);
    p.load.torque[k] = recalled(in + 17 + 2 * k);
  }
  return p;
}

std::vector<KeptContact> read_contacts(const std::vector<double>& numbers, std::size_t memory_size) {
  std::vector<KeptContact> kept;
  for (std::size_t n = 0; n < numbers.size(); n += contact_head + memory_size) {
    KeptContact c{std::int64_t(numbers[n]), std::int64_t(numbers[n + 1]), {}};
    std::copy_n(numbers.data() + n + contact_head, memory_size, c.memory.begin());
    kept.push_back(c);
  }
  return kept;
}

/// What each particle costs: itself and its contacts. \param own  Model::own_work()
std::vector<std::int32_t> work_of(const std::vector<Particle>& particles, const std::vector<KeptContact>& contacts,
                                  std::int32_t own) {
  std::unordered_map<std::int64_t, std::size_t> where;
  for (std::size_t n = 0; n < particles.size(); ++n) where[particles[n].id] = n;
  std::vector<std::int32_t> work(particles.size(), own);
  for (const KeptContact& c : contacts) {
    ++work.at(where.at(c.low));
    if (c.high >= 0) ++work.at(where.at(c.high));
  }
  return work;
}

/// Of checkpoints that older versions wrote: what holds for them.
double number_of(const core::Checkpoint& checkpoint, const std::string& key, double without) {
  const auto found = checkpoint.numbers.find(key);
  return found == checkpoint.numbers.end() ? without : found->second;
}

constexpr std::size_t load_width = 11;

void write_loads(core::Checkpoint& checkpoint, const std::vector<KeptLoad>& loads) {
  std::vector<double>& out = checkpoint.arrays["fluid_loads"];
  for (const auto& [id, f] : loads) {
    out.insert(out.end(), f.velocity.begin(), f.velocity.end());
    out.insert(out.end(), f.force.begin(), f.force.end());
    out.insert(out.end(), f.impulse.begin(), f.impulse.end());
    out.push_back(f.drag);
    out.push_back(f.added);
  }
}

FluidLoad read_load(const double* in) {
  return {{in[0], in[1], in[2]}, in[9], {in[3], in[4], in[5]}, in[10], {in[6], in[7], in[8]}};
}

}  // namespace

core::Checkpoint Model::checkpoint() const {
  core::Checkpoint checkpoint;
  std::vector<Particle> particles = gathered_particles(particles_, ranks_);
  std::vector<KeptContact> contacts = gathered_contacts(kept_contacts(), ranks_);
  write_particles(checkpoint, particles);
  std::vector<double>& out = checkpoint.arrays["contacts"];
  for (const KeptContact& c : contacts) {
    out.push_back(double(c.low));
    out.push_back(double(c.high));
    out.insert(out.end(), c.memory.begin(), c.memory.begin() + pairs_.memory_size);
  }
  if (coupling_) {
    const std::vector<KeptLoad> loads = gathered_loads(keep(particles_, coupling_->motion().load), ranks_);
    write_loads(checkpoint, loads);
    if (coupling_->sides().present())
      checkpoint.arrays["fluid_sides"] = gathered_rows(keep(particles_, coupling_->sides().rows()), ranks_).numbers;
    coupling_->write(checkpoint);
  }
  checkpoint.integers["steps"] = steps_;
  checkpoint.integers["memory_size"] = pairs_.memory_size;
  checkpoint.numbers["dt"] = limits_.dt;
  checkpoint.numbers["time"] = reported_;
  checkpoint.numbers["step_began"] = began_;
  checkpoint.numbers["step_began_at"] = double(began_at_);
  checkpoint.numbers["step_speed"] = limits_.greatest_speed;
  checkpoint.numbers["greatest_speed_met"] = core::greatest_of_ranks(ranks_.get(), met_);
  std::array<EnergySum, 4> sums{dissipated(), flow_work(), flow_work_ ? flow_work_->due() : EnergySum(), fluid_work()};
  add_over_ranks(ranks_.get(), sums);
  write_sum(checkpoint, "dissipated", sums[0]);
  if (coupling_ || affine_drag_) write_sum(checkpoint, "fluid_work", sums[3]);
  if (outflow_) write_outflow(checkpoint);
  if (flow_work_) {
    write_sum(checkpoint, "flow_work", sums[1]);
    write_sum(checkpoint, "flow_work_due", sums[2]);
  }
  return checkpoint;
}

void Model::resume(const core::Checkpoint& checkpoint) { restore(checkpoint, true); }

void Model::restore(const core::Checkpoint& checkpoint, bool same_step) {
  std::vector<double> particles, contacts;
  std::array<double, 9> head{};
  core::on_first(ranks_.get(), [&] {
    core::require_numbers(checkpoint);
    particles = checkpoint.array("particles");
    contacts = checkpoint.array("contacts");
    head = {double(particles.size()),
            double(contacts.size()),
            double(checkpoint.count("steps")),
            checkpoint.number("dt"),
            checkpoint.time("time"),
            number_of(checkpoint, "step_began", 0),
            number_of(checkpoint, "step_began_at", 0),
            number_of(checkpoint, "step_speed", limits_.greatest_speed),
            number_of(checkpoint, "greatest_speed_met", 0)};
    const double dt = step_limits(scene_, materials_, laws_, head[7]).dt;
    if (checkpoint.integer("memory_size") != pairs_.memory_size || (same_step && head[3] != dt))
      throw core::FileError("the checkpoint is of another law of contact or another time step");
    if (same_step) require_clock(head[2], head[3], head[4], head[5], head[6]);
    if (same_step) require_sums(checkpoint, ledger_.has_value(), coupling_.has_value());
    require_particles(particles, materials_.species().size(), box_.size);
    require_contacts(contacts, std::size_t(pairs_.memory_size), particles);
  });
  const auto first = [&](const char* key) { return sum_on_first(ranks_.get(), checkpoint, key); };
  if (ledger_) ledger_->set_lost(first("dissipated"));
  if (flow_work_) flow_work_->set(first("flow_work"), first("flow_work_due"));
  if (affine_drag_) affine_drag_->set_work(first("fluid_work"));
  if (outflow_) {
    *outflow_ = {outflow_->fall, std::vector<std::int64_t>(outflow_->number.size(), 0), 0, {}};
    if (same_step) read_outflow(checkpoint);
  }
  core::take_from_first(ranks_.get(), head);
  particles.resize(std::size_t(head[0]));
  contacts.resize(std::size_t(head[1]));
  core::take_from_first(ranks_.get(), particles);
  core::take_from_first(ranks_.get(), contacts);
  steps_ = std::int64_t(head[2]);
  reported_ = head[4];
  if (same_step) {
    set_step_for(head[5], std::int64_t(head[6]), head[7]);
    met_ = head[8];
  }
  std::vector<Particle> all;
  for (std::size_t n = 0; n < particles.size(); n += particle_width)
    all.push_back(read_particle(particles.data() + n, materials_));
  const std::vector<KeptContact> kept = read_contacts(contacts, std::size_t(pairs_.memory_size));
  place(all, work_of(all, kept, own_work()));
  if (coupling_) restore_fluid(checkpoint, all);
  if (coupling_ && same_step && coupling_->sides().present()) restore_sides(checkpoint, all.size());
  list_pairs({kept, pairs_.memory_size});
}

/// The fluid of a checkpoint, and what it does to the particles; or, where that had none, as at a start.
void Model::restore_fluid(const core::Checkpoint& checkpoint, const std::vector<Particle>& all) {
  std::vector<double> loads(all.size() * load_width);
  const bool with_fluid =
      core::on_any_rank(ranks_.get(), core::is_first(ranks_.get()) && checkpoint.arrays.contains("fluid_loads"));
  coupling_->motion().load.assign(particles_.owned, FluidLoad{});
  coupling_->sides().rows().clear(particles_.owned);
  if (!with_fluid) return;
  core::on_first(ranks_.get(), [&] {
    if (checkpoint.array("fluid_loads").size() != loads.size())
      core::refuse_checkpoint("fluid_loads is not of these particles");
    loads = checkpoint.array("fluid_loads");
  });
  core::take_from_first(ranks_.get(), loads);
  std::unordered_map<std::int64_t, std::size_t> row;
  for (std::size_t n = 0; n < all.size(); ++n) row[all[n].id] = n;
  for (std::size_t i = 0; i < particles_.owned; ++i)
    coupling_->motion().load[i] = read_load(loads.data() + row.at(particles_.id[i]) * load_width);
  coupling_->read(checkpoint);
  coupling_->motion().set_work(sum_on_first(ranks_.get(), checkpoint, "fluid_work"));
}

/// What side forces had kept of the particles; of a run that had none those without a memory begin with nothing.
void Model::restore_sides(const core::Checkpoint& checkpoint, std::size_t count) {
  SideRows& rows = coupling_->sides().rows();
  const bool any =
      core::on_any_rank(ranks_.get(), core::is_first(ranks_.get()) && checkpoint.arrays.contains("fluid_sides"));
  if (!any && rows.width == SideRows::force_size) return;
  KeptRows kept{rows.width + 1, std::vector<double>(count * (rows.width + 1))};
  core::on_first(ranks_.get(), [&] {
    const auto found = checkpoint.arrays.find("fluid_sides");
    if (found == checkpoint.arrays.end() || found->second.size() != kept.numbers.size())
      throw core::FileError("the checkpoint lacks what a force on particles keeps of them: it is of other [effects]");
    kept.numbers = found->second;
  });
  core::take_from_first(ranks_.get(), kept.numbers);
  recall(kept, particles_, rows);
}

void Model::start_from(const core::Checkpoint& checkpoint) {
  restore(checkpoint, false);
  steps_ = marked_at_ = 0;
  reported_ = 0;
  if (coupling_) coupling_->begin(particles_);
}

}  // namespace polybed::dem
