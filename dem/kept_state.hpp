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

/// Rows of particles and of contacts of all ranks, by the names of their arrays; as the state is when they are asked
/// for, which must stay. Collective.
[[nodiscard]] std::vector<core::BlockData> particle_rows(const Particles& particles,
                                                         const std::shared_ptr<const core::Ranks>& ranks);
[[nodiscard]] std::vector<core::BlockData> contact_rows(const Contacts& pairs, const Contacts& walls,
                                                        const Particles& particles,
                                                        const std::shared_ptr<const core::Ranks>& ranks);

/// Steps of one length: the number and the time of the last one, and where they began.
struct Clock {
  double steps = 0, dt = 0, time = 0;    ///< dt, time: s
  double began = 0, began_at = 0;        ///< time, s, and number of the first step of this length
  double speed = 0, greatest_met = 0;    ///< m/s, for which the length was chosen; met so far
  double strain = 0, strain_before = 0;  ///< of a sheared box now, and at time 0
};
void write_clock(const Clock& clock, core::Checkpoint& checkpoint);
/// \param speed, shear_rate  where the checkpoint, of an older version, names none
[[nodiscard]] Clock read_clock(const core::Checkpoint& checkpoint, double speed, double shear_rate);
/// The time of a run is that of its steps, or of a stop within a step of it; else throws core::FileError.
void require_clock(const Clock& clock);

/// What a checkpoint holds, on every rank.
struct KeptState {
  std::vector<Particle> particles;
  std::vector<KeptContact> contacts;
  Clock clock;
};
/// What the rows must fit.
struct KeptShape {
  const Materials& materials;
  const Box& box;
  int memory_size;  ///< of a contact
};
/// Collective; only the first rank's checkpoint and clock are read. Throws core::FileError for what no run has.
[[nodiscard]] KeptState read_state(const core::Checkpoint& checkpoint, Clock clock, const KeptShape& shape,
                                   const core::Ranks* ranks);

/// What each particle costs: itself and its contacts.
[[nodiscard]] std::vector<std::int32_t> work_of(const KeptState& state, std::int32_t own);

}  // namespace polybed::dem
