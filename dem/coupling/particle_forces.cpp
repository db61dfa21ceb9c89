#include "dem/coupling/particle_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "closures/added_mass.hpp"
#include "closures/sphere.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

namespace {

/// Voidages that closures are asked about: that of the densest packing of equal spheres, and clear fluid.
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
  if (own == nullptr) {
    find_by(
        particles, gather, [&](const Lines& l, std::int32_t j) { return gather.solids(l, j); },
        [&](const Lines& l, std::int32_t) { return gather.per_square(l); }, loads);
  } else {
    find_by(
        particles, gather, [&](const Lines& l, std::int32_t j) { return own->without(gather.solids(l, j), l, j); },
        [&](const Lines& l, std::int32_t j) { return own->per_square_without(gather.per_square(l), l, j); }, loads);
  }
}

template <class Solids, class Squares>
void ParticleForces::find_by(const Particles& particles, const Gather& gather, Solids&& solids, Squares&& squares,
                             std::vector<FluidLoad>& loads) {
  for (std::size_t begin = 0; begin < particles.owned; begin += most) {
    const std::size_t count = std::min(most, particles.owned - begin);
    see(particles, gather, solids, squares, begin, count, loads);
    if (laws_.drag) drag(begin, count, loads);
  }
}

/// The fields where the particles are.
template <class Solids, class Squares>
void ParticleForces::see(const Particles& particles, const Gather& gather, Solids&& solids_at, Squares&& squares_at,
                         std::size_t begin, std::size_t count, std::vector<FluidLoad>& loads) {
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = begin + n;
    const auto j = std::size_t(particles.species[i]);
    const double d = diameter_[j], volume = closures::sphere_volume(0.5 * d);
    const Lines lines = gather.lines(particles.place[i].x);
    const Surroundings solids = solids_at(lines, particles.species[i]);
    const Stream stream = gather.stream(lines);
    FluidLoad& load = loads[i];
    load.velocity = stream.velocity;
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      load.force[k] = -volume * stream.gradient[k];
      const double slip = stream.velocity[k] - particles.motion[i].v[k];
      square += slip * slip;
    }
    const double eps = std::clamp(1 - solids.fraction, least_voidage, most_voidage);
    clamped_ += eps != 1 - solids.fraction && solids.fraction > 0;
    const bool alone = !(solids.fraction > 0);
    const double per_fraction = alone ? 0 : 1 / solids.fraction;
    voidage_[n] = eps;
    per_mean_[n] = alone ? 1 / d : solids.per_mean * per_fraction;
    average_[n] = alone ? d : solids.average * per_fraction;
    if (needs_squares_) per_square_[n] = alone ? 1 / (d * d) : squares_at(lines, particles.species[i]) * per_fraction;
    share_[n] = alone ? 1 : solids.own * per_fraction;
    size_[n] = d;
    stokes_[n] = creeping_[j];
    slip_[n] = eps * std::sqrt(square);
    if (laws_.added_mass != nullptr)
      load.added = closures::added_mass_inertia(laws_.added_mass(1 - eps), fluid_density_, d);
  }
}

/// k = 3 pi mu D eps f: pure drag over U_f - U_p.
void ParticleForces::drag(std::size_t begin, std::size_t count, std::vector<FluidLoad>& loads) {
  const auto first = [count](auto& row) { return std::span(row).first(count); };
  closures::drag_of_particles(*laws_.drag, first(voidage_), first(per_mean_), first(average_), first(per_square_),
                              largest_, first(share_), first(size_), first(slip_), fluid_density_, viscosity_,
                              first(f_), count_);
  for (std::size_t n = 0; n < count; ++n) loads[begin + n].drag = stokes_[n] * voidage_[n] * f_[n];
}

LawUse ParticleForces::use() const { return {count_.evaluations, count_.guarded, clamped_}; }

}  // namespace polybed::dem
