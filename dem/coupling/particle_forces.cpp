#include "dem/coupling/particle_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "closures/added_mass.hpp"
#include "closures/own_wake.hpp"
#include "closures/sphere.hpp"
#include "core/vectors.hpp"
#include "dem/contacts/batch.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

namespace {

/// Range of voidages for closures: the densest packing of equal spheres, and clear fluid.
constexpr double least_voidage = 0.26, most_voidage = 1;

}  // namespace

ParticleForces::ParticleForces(const core::Scene& scene, const Materials& materials, double fluid_density,
                               double viscosity)
    : largest_(materials.greatest_diameter()), fluid_density_(fluid_density), viscosity_(viscosity) {
  for (const Species& s : materials.species()) diameter_.push_back(2 * s.radius);
  for (const double divisor : relevance::slip_divisors(scene, diameter_))
    creeping_.push_back(3 * std::numbers::pi * viscosity * diameter_[creeping_.size()] / divisor);
  for_each_called<MakeLoad>(effects(), scene, [&](MakeLoad make, const std::string& law) { make(scene, law, laws_); });
  needs_squares_ = laws_.drag && closures::needs_per_square(*laws_.drag);
}

void ParticleForces::find(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads,
                          const OwnShare* own) {
  for (std::size_t begin = 0; begin < particles.owned; begin += Batch::most) {
    const std::size_t count = std::min(Batch::most, particles.owned - begin);
    const Asked asked{particles, gather, own, wake_ ? &*wake_ : nullptr, diameter_, needs_squares_};
    if (gather.round())
      core::in_vectors<see<true>>(asked, begin, count, loads.data() + begin, batch_);
    else
      core::in_vectors<see<false>>(asked, begin, count, loads.data() + begin, batch_);
    clamped_ += core::in_vectors<average>(count, batch_);
    if (laws_.added_mass != nullptr) add_mass(count, loads.data() + begin);
    if (laws_.drag) drag(particles, begin, count, loads);
  }
}

/// The fields at the particles. A rule restricts `own` to boxes; a wake in a round column is as wide as in a box.
template <bool round>
void ParticleForces::see(const Asked& asked, std::size_t begin, std::size_t count, FluidLoad* loads, Batch& batch) {
  const auto& [particles, gather, own, wake, diameter, needs_squares] = asked;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = begin + n;
    const std::int32_t species = particles.species[i];
    const double d = diameter[std::size_t(species)], volume = closures::sphere_volume(0.5 * d);
    const auto lines = gather.shares<round>(particles.place[i].x);
    Surroundings solids = gather.solids(lines, species);
    if (needs_squares) batch.per_square[n] = gather.per_square(lines);
    if constexpr (!round) {
      if (own != nullptr) {
        const double inside = own->inside(particles.place[i], particles.id[i]);
        solids = own->without(solids, lines, species, inside);
        if (needs_squares) batch.per_square[n] = own->per_square_without(batch.per_square[n], lines, species, inside);
      }
    }
    const Stream stream = gather.stream(lines);
    FluidLoad& load = loads[n];
    load.velocity = stream.velocity;
    Vector squares;
    for (std::size_t k = 0; k < 3; ++k) {
      load.force[k] = -volume * stream.gradient[k];
      const double slip = stream.velocity[k] - particles.motion[i].v[k];
      squares[k] = slip * slip;
    }
    if (wake != nullptr) {
      if constexpr (round)
        batch.spread[n] = wake->spread(gather.lines(particles.place[i].x), squares);
      else
        batch.spread[n] = wake->spread(lines, squares);
    }
    batch.fraction[n] = solids.fraction;
    batch.per_mean[n] = solids.per_mean;
    batch.average[n] = solids.average;
    batch.share[n] = solids.own;
    batch.size[n] = d;
    batch.slip[n] = squares[0] + squares[1] + squares[2];
  }
}

/// Converts sums over the surroundings into averages; returns the number of voidages outside the range of a bed.
std::uint64_t ParticleForces::average(std::size_t count, Batch& batch) {
  std::int64_t clamped = 0;
  POLYBED_INDEPENDENT
  for (std::size_t n = 0; n < count; ++n) {
    const double fraction = batch.fraction[n], d = batch.size[n], clear = 1 - fraction;
    const bool alone = !(fraction > 0);
    const double eps = std::clamp(clear, least_voidage, most_voidage), per_fraction = 1 / (alone ? 1 : fraction);
    clamped += eps != clear && !alone ? 1 : 0;
    batch.voidage[n] = eps;
    batch.per_mean[n] = alone ? 1 / d : batch.per_mean[n] * per_fraction;
    batch.average[n] = alone ? d : batch.average[n] * per_fraction;
    batch.per_square[n] = alone ? 1 / (d * d) : batch.per_square[n] * per_fraction;
    batch.share[n] = alone ? 1 : batch.share[n] * per_fraction;
    batch.slip[n] = eps * std::sqrt(batch.slip[n]);
  }
  return std::uint64_t(clamped);
}

void ParticleForces::add_mass(std::size_t count, FluidLoad* loads) const {
  for (std::size_t n = 0; n < count; ++n)
    loads[n].added =
        closures::added_mass_inertia(laws_.added_mass(1 - batch_.voidage[n]), fluid_density_, batch_.size[n]);
}

void ParticleForces::drag(const Particles& particles, std::size_t begin, std::size_t count,
                          std::vector<FluidLoad>& loads) {
  ask_drag(particles, begin, count, loads);
  if (wake_) remove_own_wake(particles, begin, count, loads);
}

/// The fluid velocity seen moves with the particle by F G, G = closures::own_wake: F = k (U_f + F G - U_p) for the U_f
/// seen; drag over the slip seen is then k/(1 - k G). k and G depend on the slip without the wake, 1/(1 - k G) of it.
void ParticleForces::remove_own_wake(const Particles& particles, std::size_t begin, std::size_t count,
                                     std::vector<FluidLoad>& loads) {
  constexpr int rounds = 4;  // k G is at most a half: each round gains a digit
  const Batch::Row seen = batch_.slip;
  const auto rest = [&](std::size_t n) {
    return 1 - loads[begin + n].drag *
                   closures::own_wake(viscosity_, fluid_density_, batch_.spread[n], batch_.slip[n] / batch_.voidage[n]);
  };
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t n = 0; n < count; ++n) batch_.slip[n] = seen[n] / rest(n);
    ask_drag(particles, begin, count, loads);
  }
  for (std::size_t n = 0; n < count; ++n) loads[begin + n].drag /= rest(n);
}

/// k = 3 pi mu D eps f: pure drag over U_f - U_p.
void ParticleForces::ask_drag(const Particles& particles, std::size_t begin, std::size_t count,
                              std::vector<FluidLoad>& loads) {
  const auto first = [count](auto& row) { return std::span(row).first(count); };
  closures::drag_of_particles(*laws_.drag, first(batch_.voidage), first(batch_.per_mean), first(batch_.average),
                              first(batch_.per_square), largest_, first(batch_.share), first(batch_.size),
                              first(batch_.slip), fluid_density_, viscosity_, first(batch_.f), count_);
  if (const auto& shape = laws_.drag->shape)
    for (std::size_t n = 0; n < count; ++n)
      batch_.f[n] *= shape->species[std::size_t(particles.species[begin + n])](
          batch_.voidage[n], fluid_density_ * batch_.slip[n] * batch_.size[n] / viscosity_);
  for (std::size_t n = 0; n < count; ++n)
    loads[begin + n].drag = creeping_[std::size_t(particles.species[begin + n])] * batch_.voidage[n] * batch_.f[n];
}

LawUse ParticleForces::use() const { return {count_.evaluations, count_.guarded, clamped_}; }

}  // namespace polybed::dem
