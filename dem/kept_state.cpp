// The complete state of the particles, to the bit, independent of the number of ranks.
#include "dem/kept_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "core/error.hpp"
#include "dem/parallel/ordered_rows.hpp"

namespace polybed::dem {

namespace {

constexpr std::size_t particle_width = 2 + 9 + 12, contact_head = 2;

/// Numbers as doubles: ids and counts below 2^53 are exact; sums in whole units are stored as two halves.
double* store(std::int64_t units, double* out) {
  *out++ = double(units >> 32);
  *out++ = double(units & 0xffffffff);
  return out;
}
std::int64_t recalled(const double* in) { return (std::int64_t(in[0]) << 32) + std::int64_t(in[1]); }

/// Checks particles from a file: ids are unique, and no particle has left the world. Values within the ranges cannot be
/// distinguished from a real state.
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

/// The centres of particles lie within the side of a round box, unless it has holes through which they pass.
void require_within_side(const std::vector<double>& numbers, const Box& box) {
  if (std::any_of(box.openings.begin(), box.openings.end(), [](const Opening& o) { return o.about.has_value(); }))
    return;
  const double radius = 0.5 * box.size[0];
  const auto most = [&](double y) { return box.side && y >= 0 ? box.side.reach(y, 0) : radius; };
  for (const double* p = numbers.data(); p != numbers.data() + numbers.size(); p += particle_width)
    if (std::hypot(p[2] - radius, p[4] - radius) > most(p[3]))
      core::refuse_checkpoint(fmt::format("particle {:.0f} lies outside the round column, at ({:g}, {:g}, {:g}) m",
                                          p[0], p[2], p[3], p[4]));
}

/// Checks that contacts refer to existing particles.
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

/// A number that checkpoints from older versions lack, with its value for them.
double number_of(const core::Checkpoint& checkpoint, const std::string& key, double without) {
  const auto found = checkpoint.numbers.find(key);
  return found == checkpoint.numbers.end() ? without : found->second;
}

void store_particle(const Particles& particles, std::size_t i, double* out) {
  const Motion& m = particles.motion[i];
  *out++ = double(particles.id[i]);
  *out++ = particles.species[i];
  for (const Vector* v : {&particles.place[i].x, &m.v, &m.w}) out = std::copy(v->begin(), v->end(), out);
  for (const std::int64_t f : particles.load[i].force) out = store(f, out);
  for (const std::int64_t t : particles.load[i].torque) out = store(t, out);
}

void store_contact(const Contacts& contacts, std::int32_t pair, const Particles& particles, bool walls, double* out) {
  const auto [low, high] = ids_of(contacts.pairs[std::size_t(pair)], particles, walls);
  *out++ = double(low);
  *out++ = double(high);
  std::copy_n(contacts.memory_of(pair), contacts.memory_size, out);
}

}  // namespace

std::vector<core::BlockData> particle_rows(const Particles& particles,
                                           const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<RowName> own;
  own.reserve(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i) own.push_back({particles.id[i], 0, std::int32_t(i)});
  return OrderedRows(std::move(own), ranks)
      .blocks("particles", particle_width, true,
              [&particles](std::int32_t i, double* row) { store_particle(particles, std::size_t(i), row); });
}

/// A contact across ranks is written by the owner of its first particle, as both ranks have it. Walls are stored as the
/// complements of their indices.
std::vector<core::BlockData> contact_rows(const Contacts& pairs, const Contacts& walls, const Particles& particles,
                                          const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<RowName> own;
  own.reserve(pairs.touching.size() + walls.touching.size());
  for (const std::int32_t p : pairs.touching) {
    const auto [low, high] = ids_of(pairs.pairs[std::size_t(p)], particles, false);
    if (std::size_t(pairs.pairs[std::size_t(p)].first) < particles.owned) own.push_back({low, high, p});
  }
  for (const std::int32_t p : walls.touching) {
    const auto [low, high] = ids_of(walls.pairs[std::size_t(p)], particles, true);
    own.push_back({low, high, ~p});
  }
  return OrderedRows(std::move(own), ranks)
      .blocks("contacts", contact_head + std::size_t(pairs.memory_size), true,
              [&pairs, &walls, &particles](std::int32_t at, double* row) {
                const bool wall = at < 0;
                store_contact(wall ? walls : pairs, wall ? ~at : at, particles, wall, row);
              });
}

void write_clock(const Clock& clock, core::Checkpoint& checkpoint) {
  checkpoint.integers["steps"] = std::int64_t(clock.steps);
  checkpoint.numbers["dt"] = clock.dt;
  checkpoint.numbers["time"] = clock.time;
  checkpoint.numbers["step_began"] = clock.began;
  checkpoint.numbers["step_began_at"] = clock.began_at;
  checkpoint.numbers["step_speed"] = clock.speed;
  checkpoint.numbers["greatest_speed_met"] = clock.greatest_met;
  checkpoint.numbers["strain"] = clock.strain;
  checkpoint.numbers["strain_before"] = clock.strain_before;
}

Clock read_clock(const core::Checkpoint& checkpoint, double speed, double shear_rate) {
  return {double(checkpoint.count("steps")),
          checkpoint.number("dt"),
          checkpoint.time("time"),
          number_of(checkpoint, "step_began", 0),
          number_of(checkpoint, "step_began_at", 0),
          number_of(checkpoint, "step_speed", speed),
          number_of(checkpoint, "greatest_speed_met", 0),
          number_of(checkpoint, "strain", shear_rate * checkpoint.time("time")),
          number_of(checkpoint, "strain_before", 0)};
}

void require_clock(const Clock& c) {
  const bool known = c.began >= 0 && c.began <= c.time + c.dt && c.began_at >= 0 && c.began_at <= c.steps;
  if (!known || !(std::abs(c.began + (c.steps - c.began_at) * c.dt - c.time) <= c.dt * (1 + 1e-6)))
    core::refuse_checkpoint(fmt::format("{} steps from {:g} s on, of {:g} s, do not end at {:g} s",
                                        c.steps - c.began_at, c.began, c.dt, c.time));
}

KeptState read_state(const core::Checkpoint& checkpoint, Clock clock, const KeptShape& shape,
                     const core::Ranks* ranks) {
  std::vector<double> particles, contacts;
  std::array<double, 11> head{};
  core::on_first(ranks, [&] {
    particles = checkpoint.array("particles");
    contacts = checkpoint.array("contacts");
    require_particles(particles, shape.materials.species().size(), shape.box.size);
    if (shape.box.round) require_within_side(particles, shape.box);
    require_contacts(contacts, std::size_t(shape.memory_size), particles);
    head = {double(particles.size()),
            double(contacts.size()),
            clock.steps,
            clock.dt,
            clock.time,
            clock.began,
            clock.began_at,
            clock.speed,
            clock.greatest_met,
            clock.strain,
            clock.strain_before};
  });
  core::take_from_first(ranks, head);
  particles.resize(std::size_t(head[0]));
  contacts.resize(std::size_t(head[1]));
  core::take_from_first(ranks, particles);
  core::take_from_first(ranks, contacts);
  KeptState state{{},
                  read_contacts(contacts, std::size_t(shape.memory_size)),
                  {head[2], head[3], head[4], head[5], head[6], head[7], head[8], head[9], head[10]}};
  state.particles.reserve(particles.size() / particle_width);
  for (std::size_t n = 0; n < particles.size(); n += particle_width)
    state.particles.push_back(read_particle(particles.data() + n, shape.materials));
  return state;
}

std::vector<std::int32_t> work_of(const KeptState& state, std::int32_t own) {
  std::unordered_map<std::int64_t, std::size_t> where;
  for (std::size_t n = 0; n < state.particles.size(); ++n) where[state.particles[n].id] = n;
  std::vector<std::int32_t> work(state.particles.size(), own);
  for (const KeptContact& c : state.contacts) {
    ++work.at(where.at(c.low));
    if (c.high >= 0) ++work.at(where.at(c.high));
  }
  return work;
}

}  // namespace polybed::dem
