// Checkpoint data of a model's optional parts: a fluid, a ledger, a sheared box, feeds, and openings.
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
  const Particles& particles;     ///< on this rank
  std::span<const Particle> all;  ///< in the order of the checkpoint
  bool same_run;                  ///< the run continues; else another one starts with these particles
};

/// A part with state in the checkpoint. All functions except require() are collective.
class KeptPart {
 public:
  virtual ~KeptPart() = default;
  virtual void write(core::Checkpoint&, const Particles&, const core::Ranks*) const {}
  /// On the first rank only: throws core::FileError if a run cannot continue without data that the checkpoint lacks.
  virtual void require(const core::Checkpoint&) const {}
  virtual void read(const Restored&) = 0;
};

}  // namespace polybed::dem
