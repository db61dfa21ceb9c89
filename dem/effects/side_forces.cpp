#include "dem/effects/side_forces.hpp"

#include <algorithm>

namespace polybed::dem {

SideForces::SideForces(const core::Scene& scene, const Materials& materials, double density, double viscosity,
                       double dt, double interval, const std::vector<const Maker*>& list)
    : dt_(dt) {
  LoadLaws loads;
  for_each_called<MakeLoad>(list, scene, [&](MakeLoad make, const std::string& law) { make(scene, law, loads); });
  // Effects with a memory have consecutive places in it.
  for_each_called<MakeForce>(list, scene, [&](MakeForce make, const std::string&) {
    effects_.push_back(
        make({scene, materials, density, viscosity, dt, interval, memory_end(), loads.added_mass != nullptr}));
  });
  if (effects_.empty()) return;
  rows_.width = memory_end();
  for (const auto& effect : effects_) needs_vorticity_ |= effect->needs_vorticity();
}

/// End of the force and of the memory of the effects so far.
std::size_t SideForces::memory_end() const {
  std::size_t end = SideRows::force_size;
  for (const auto& effect : effects_) end += effect->memory_size();
  return end;
}

bool SideForces::has_inertia() const {
  return std::any_of(effects_.begin(), effects_.end(), [](const auto& effect) { return effect->has_inertia(); });
}

SideView SideForces::look(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads) {
  if (needs_vorticity_) {
    vorticity_.resize(particles.owned);
    const auto see = [&](const auto round) {
      for (std::size_t i = 0; i < particles.owned; ++i)
        vorticity_[i] = gather.vorticity(gather.shares<round()>(particles.place[i].x));
    };
    gather.round() ? see(std::true_type()) : see(std::false_type());
  }
  return {particles, loads, vorticity_};
}

/// Replaces the previous forces by those at the particles' present places.
void SideForces::replace(const SideView& view) {
  for (std::size_t i = 0; i < view.loads.size(); ++i) std::fill_n(rows_.of(i), SideRows::force_size, 0.0);
  for (const auto& effect : effects_) effect->add(view, rows_);
  for (std::size_t i = 0; i < view.loads.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) view.loads[i].force[k] += rows_.of(i)[k];
}

void SideForces::add_impulse(std::span<FluidLoad> loads, double time) const {
  for (std::size_t i = 0; i < loads.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) loads[i].impulse[k] += time * rows_.of(i)[k];
}

void SideForces::begin(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads) {
  if (!present()) return;
  rows_.clear(particles.owned);
  const SideView view = look(particles, gather, loads);
  for (const auto& effect : effects_) effect->begin(view, rows_);
  replace(view);
}

void SideForces::find(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads) {
  if (!present()) return;
  add_impulse(loads, 0.5 * dt_);  // for the half kick that has acted
  replace(look(particles, gather, loads));
  add_impulse(loads, 0.5 * dt_);  // for the next one
}

void SideForces::refresh(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads) {
  if (!present()) return;
  const SideView view = look(particles, gather, loads);
  for (const auto& effect : effects_) effect->end_interval(view, rows_);
  replace(view);
}

void SideForces::hold(std::vector<FluidLoad>& loads) const {
  if (present()) add_impulse(loads, dt_);
}

void SideForces::turn(Particles& particles, FluidMotion& motion) {
  for (const auto& effect : effects_) effect->turn(vorticity_, particles, motion);
}

}  // namespace polybed::dem
