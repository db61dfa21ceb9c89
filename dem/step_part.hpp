// What takes part in the steps of a model where a scene has it: a fluid, a ledger, a sheared box, an opening.
#pragma once

#include <cstdint>
#include <span>

#include "core/numerics/ranks.hpp"
#include "dem/energy_sum.hpp"
#include "dem/particles.hpp"

namespace polybed::core {
struct Checkpoint;
}

namespace polybed::dem {

class AffineDrag;
class Exchange;
class FluidMotion;
class Model;

/// What the particles move through: a fluid, the flow of a sheared box, or neither.
struct Around {
  FluidMotion* fluid = nullptr;
  AffineDrag* flow = nullptr;
};

/// Energies counted since the start, of one rank, in the unit of energy.
struct CountedEnergy {
  EnergySum dissipated;   ///< in contacts
  EnergySum fluid_work;   ///< of a fluid on the particles
  EnergySum joined_work;  ///< of joined faces, of a sheared box or along gravity
};

/// A checkpoint whose particles are back in place.
struct Restored {
  const core::Checkpoint& checkpoint;  ///< the first rank's
  const core::Ranks* ranks;
  const Particles& particles;     ///< of this rank
  std::span<const Particle> all;  ///< in the order of the checkpoint
  bool same_run;                  ///< the run goes on; else another one begins with these particles
};

/// The model holds a list of those that its scene has, and asks each of them once at every point of a step: what a
/// scene has not costs nothing. All hooks are collective.
class StepPart {
 public:
  virtual ~StepPart() = default;

  // At the start, in this order: what particles move through; once the first forces are found; where a run begins
  // from the particles of another.
  virtual void surround(Around&) {}
  virtual void begin(Particles&) {}
  virtual void begin_from_other(Particles&) {}

  // In the order of a step.
  /// In place of all motion, where particles are held.
  virtual void hold(const Particles&) {}
  /// After the first half kick, the drift and the forces of contacts. \param timed  see core::Timers::scope
  virtual void find_forces(const Particles&, std::uint64_t /*timed*/) {}
  /// After the second half kick.
  virtual void turn(Particles&) {}
  /// At the end. \param steps  since the start  \param time  s
  virtual void end_step(Particles&, std::int64_t /*steps*/, double /*time*/) {}

  // In this order while the pairs are listed anew.
  /// While contacts are still known: how many particles are about to leave, of all ranks.
  virtual std::int64_t count_leaving(const Model&) { return 0; }
  /// A particle is back between the joined faces. \param gained  energy, J; 0 if it has not left
  virtual void wrapped(double /*gained*/) {}
  virtual void take_out(Particles&) {}
  /// Before particles change ranks and places, and after.
  virtual void send_ahead(Exchange&, const Particles&) {}
  virtual void settle_in(const Particles&) {}

  /// What a particle costs over what it costs to be in a contact.
  [[nodiscard]] virtual std::int32_t work_of_particle() const { return 1; }
  /// Whether steps may become shorter after so many.
  [[nodiscard]] virtual bool may_shorten(std::int64_t /*steps*/) const { return true; }
  virtual void set_dt(double /*s*/) {}
  /// What comes next does not depend on what earlier steps have left behind.
  virtual void restart() {}

  /// Adds what it has counted.
  virtual void count(CountedEnergy&) const {}
  /// Steps that particles took that are no longer there.
  [[nodiscard]] virtual std::int64_t steps_of_gone() const { return 0; }

  virtual void write(core::Checkpoint&, const Particles&, const core::Ranks*) const {}
  /// On the first rank alone: throws core::FileError where a run cannot go on without what the checkpoint lacks.
  virtual void require(const core::Checkpoint&) const {}
  virtual void read(const Restored&) {}
};

}  // namespace polybed::dem
