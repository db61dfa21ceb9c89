// What has left the box: through the opening in its bottom, or through its open top.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/energy_sum.hpp"
#include "dem/kept_part.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class Model;

/// Particles are taken out when the list of pairs is made anew: once they lie a largest diameter below the bottom, or
/// wholly beyond the top. The same on every rank, and on any number of ranks to the bit.
class Outflow final : public KeptPart {
 public:
  /// Of a box with an opening in the bottom, or an open top.
  Outflow(const Box& box, const Materials& materials);

  std::vector<std::int64_t> number;  ///< of each species, since the start
  std::int64_t steps = 0;            ///< that all of them took together before they left
  /// What they took with them, in the unit of energy: of motion, spin and gravity, and in the springs of all contacts
  /// that they were in.
  EnergySum energy;

  [[nodiscard]] bool takes(const Place& place) const {
    return place.x[1] < lowest_ || place.x[1] - place.radius > highest_;
  }
  /// Particles of all species.
  [[nodiscard]] std::int64_t all() const;

  /// While contacts are still known: how many particles are about to leave, of all ranks. Collective.
  std::int64_t count_leaving(const Model& model);
  void take_out(Particles& particles);
  void write(core::Checkpoint& checkpoint, const Particles& particles, const core::Ranks* ranks) const override;
  void read(const Restored& from) override;

 private:
  double lowest_, highest_;  ///< of centres, and of what a particle must be above with all of it, m; infinite: closed
};

}  // namespace polybed::dem
