// What a checkpoint keeps of the parts of a model that only some scenes have: a fluid, a ledger, a sheared box, feeds,
// and ways out.
#pragma once

#include <span>

#include "core/numerics/ranks.hpp"
#include "dem/particles.hpp"

namespace polybed::core {
struct Checkpoint;
}

namespace polybed::dem {

/// A checkpoint whose particles are back in place.
struct Restored {
  const core::Checkpoint& checkpoint;  ///< the first rank's
  const core::Ranks* ranks;
  const Particles& particles;     ///< of this rank
  std::span<const Particle> all;  ///< in the order of the checkpoint
  bool same_run;                  ///< the run goes on; else another one begins with these particles
};

/// A part with state in the checkpoint. All functions but require() are collective.
class KeptPart {
 public:
  virtual ~KeptPart() = default;
  virtual void write(core::Checkpoint&, const Particles&, const core::Ranks*) const {}
  /// On the first rank alone: throws core::FileError where a run cannot go on without what the checkpoint lacks.
  virtual void require(const core::Checkpoint&) const {}
  virtual void read(const Restored&) = 0;
};

}  // namespace polybed::dem
