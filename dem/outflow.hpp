// What has left the box: through an opening in its bottom or a side, or through its open top.
#pragma once

#include <algorithm>
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
/// wholly beyond the top or a side, or have rolled round the rim of an opening in a side. The same on every rank, and
/// on any number of ranks to the bit.
class Outflow final : public KeptPart {
 public:
  /// Of a box with openings.
  Outflow(const Box& box, const Materials& materials);

  std::vector<std::int64_t> number;  ///< of each species, since the start
  std::int64_t steps = 0;            ///< that all of them took together before they left
  /// What they took with them, in the unit of energy: of motion, spin and gravity, and in the springs of all contacts
  /// that they were in.
  EnergySum energy;

  [[nodiscard]] bool takes(const Place& place) const {
    return std::any_of(box_.openings.begin(), box_.openings.end(), [&](const Opening& o) {
      const double out = o.outward(place.x), face = o.outward(o.place);
      if (o.is_bottom()) return out - face > greatest_diameter_;
      return out - place.radius > face || (out > face && !box_.in_line(o, place.x));
    });
  }
  /// Particles of all species.
  [[nodiscard]] std::int64_t all() const;

  /// While contacts are still known: how many particles are about to leave, of all ranks. Collective.
  std::int64_t count_leaving(const Model& model);
  void take_out(Particles& particles);
  void write(core::Checkpoint& checkpoint, const Particles& particles, const core::Ranks* ranks) const override;
  void read(const Restored& from) override;

 private:
  const Box& box_;
  double greatest_diameter_;  ///< m
};

}  // namespace polybed::dem
