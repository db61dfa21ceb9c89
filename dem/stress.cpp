#include "dem/stress.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/messages.hpp"

namespace polybed::dem {

namespace {

/// A tensor's components, row by row, as a sum of whole units: the same in any order.
struct Sum {
  std::array<std::int64_t, 9> units{};
  void add(const Vector& a, const Vector& b, double scale) {
    for (std::size_t n = 0; n < 9; ++n) units[n] += std::llround(a[n / 3] * b[n % 3] * scale);
  }
};

Tensor tensor(const std::int64_t* units, double scale) {
  Tensor t;
  for (std::size_t n = 0; n < 9; ++n) t[n / 3][n % 3] = double(units[n]) * scale;
  return t;
}

/// Unit for the sum of r F over all contacts: each particle's forces fit into the unit of force.
FixedPoint virial_unit(const Model& model) {
  const double reach = model.materials().greatest_diameter() + model.laws().reach();
  const int q = int(std::ceil(std::log2(reach * double(std::max<std::int64_t>(model.particle_count(), 1)))));
  const FixedPoint force = model.unit_of_force();
  return {std::ldexp(force.per_unit, -q), std::ldexp(force.unit, q)};
}

/// Evaluates the laws of the force again, with a zero time step.
void find_force(const PairLaws& laws, ContactBatch& batch) {
  laws.normal->act(batch);
  if (laws.tangential) laws.tangential->act(batch, 0);
  laws.each_attraction([&](const CohesionLaw& law) { law.act(batch, 0); });
  if (!laws.film) return;
  alignas(64) ContactBatch::Row force;
  laws.film->act(batch, force);
  for (int c = 0; c < batch.padded(); ++c) batch.normal[c] += force[c];
}

/// Calls `see` for every interacting pair that this rank counts, with the force on the first.
template <class See>
void each_contact(Model& model, See&& see) {
  model.refresh_ghosts();
  const Images images = model.images();
  const Contacts& contacts = model.pairs();
  const Particles& particles = model.particles();
  ContactBatch batch;
  for (std::size_t begin = 0; begin < contacts.touching.size(); begin += ContactBatch::width) {
    model.pair_forces().loader().load_touching_pairs(particles, contacts, images, begin, batch);
    find_force(model.laws(), batch);
    for (int c = 0; c < batch.count; ++c) {
      if (std::size_t(batch.first[c]) >= particles.owned) continue;
      const Vector n{batch.distance[0][c], batch.distance[1][c], batch.distance[2][c]};
      Vector force;
      for (std::size_t k = 0; k < 3; ++k) force[k] = batch.normal[c] * n[k] + batch.tangential[k][c];
      see(ContactForce{std::size_t(batch.first[c]), n, force, batch.arm_i[c] + batch.arm_j[c], batch.overlap[c] > 0});
    }
  }
}

/// Adds the contacts that this rank counts. Returns the number that touch.
std::int64_t add_contacts(Model& model, double per_unit, Sum& sum) {
  std::int64_t touching = 0;
  each_contact(model, [&](const ContactForce& c) {
    sum.add(c.normal, c.force, c.length * per_unit);
    touching += c.touches ? 1 : 0;
  });
  return touching;
}

/// Adds m v' v' of this rank's particles to their species' sums.
void add_motion(const Model& model, std::vector<Sum>& kinetic, std::vector<std::int64_t>& number) {
  const Particles& particles = model.particles();
  const double per_unit = model.energy_unit().per_unit;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    Vector v = particles.motion[i].v;
    v[0] -= model.box().shear_rate * particles.place[i].x[1];
    const auto j = std::size_t(particles.species[i]);
    kinetic[j].add(v, v, per_unit / particles.motion[i].inverse_mass);
    ++number[j];
  }
}

}  // namespace

std::vector<ContactForce> contact_forces(Model& model) {
  std::vector<ContactForce> forces;
  each_contact(model, [&](const ContactForce& c) { forces.push_back(c); });
  return forces;
}

Stress stress_of(Model& model) {
  const auto& materials = model.materials().species();
  const std::size_t species = materials.size();
  std::vector<Sum> kinetic(species);
  std::vector<std::int64_t> number(species, 0);
  Sum contact;
  const FixedPoint virial = virial_unit(model);
  add_motion(model, kinetic, number);
  std::vector<std::int64_t> sums{add_contacts(model, virial.per_unit, contact)};
  sums.insert(sums.end(), number.begin(), number.end());
  sums.insert(sums.end(), contact.units.begin(), contact.units.end());
  for (const Sum& s : kinetic) sums.insert(sums.end(), s.units.begin(), s.units.end());
  core::add_over_ranks(model.ranks(), sums);

  const Vector& size = model.box().size;
  const double volume = size[0] * size[1] * size[2];
  Stress stress;
  stress.contacts = sums[0];
  stress.shear_rate = model.box().shear_rate;
  stress.contact = tensor(&sums[1 + species], virial.unit / volume);
  for (std::size_t j = 0; j < species; ++j) {
    stress.kinetic_of.push_back(tensor(&sums[1 + species + 9 * (j + 1)], model.energy_unit().unit / volume));
    const Tensor& t = stress.kinetic_of.back();
    for (std::size_t n = 0; n < 9; ++n) stress.kinetic[n / 3][n % 3] += t[n / 3][n % 3];
    const double mass = materials[j].mass * double(std::max<std::int64_t>(sums[1 + j], 1));
    stress.temperature.push_back((t[0][0] + t[1][1] + t[2][2]) * volume / (3 * mass));
  }
  return stress;
}

}  // namespace polybed::dem
