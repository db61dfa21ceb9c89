// Particles and contacts as rows of a checkpoint, to the bit, in an order that does not depend on the ranks.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "dem/box.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/kept.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Rows of particles and contacts on all ranks, by the names of their arrays. They are computed from the state when
/// needed; it must not change before. Collective.
[[nodiscard]] std::vector<core::BlockData> particle_rows(const Particles& particles,
                                                         const std::shared_ptr<const core::Ranks>& ranks);
[[nodiscard]] std::vector<core::BlockData> contact_rows(const Contacts& pairs, const Contacts& walls,
                                                        const Particles& particles,
                                                        const std::shared_ptr<const core::Ranks>& ranks);

/// Steps of one length: number and time of the last one, and their start.
struct Clock {
  double steps = 0, dt = 0, time = 0;    ///< dt, time: s
  double began = 0, began_at = 0;        ///< time, s, and number at the first step of this length
  double speed = 0, greatest_met = 0;    ///< m/s, that the length was chosen for; greatest so far
  double strain = 0, strain_before = 0;  ///< of a sheared box now, and at time 0
};
void write_clock(const Clock& clock, core::Checkpoint& checkpoint);
/// \param speed, shear_rate  used if the checkpoint, of an older version, lacks them
[[nodiscard]] Clock read_clock(const core::Checkpoint& checkpoint, double speed, double shear_rate);
/// Throws core::FileError unless the time of a run is at one of its steps, or at a stop within a step.
void require_clock(const Clock& clock);

/// The content of a checkpoint, on every rank.
struct KeptState {
  std::vector<Particle> particles;
  std::vector<KeptContact> contacts;
  Clock clock;
};
/// Required shape of the rows.
struct KeptShape {
  const Materials& materials;
  const Box& box;
  int memory_size;  ///< per contact
};
/// Collective; reads only the first rank's checkpoint and clock. Throws core::FileError for impossible values.
[[nodiscard]] KeptState read_state(const core::Checkpoint& checkpoint, Clock clock, const KeptShape& shape,
                                   const core::Ranks* ranks);

/// Cost of each particle: itself and its contacts.
[[nodiscard]] std::vector<std::int32_t> work_of(const KeptState& state, std::int32_t own);

}  // namespace polybed::dem
