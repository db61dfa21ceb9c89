// Particles that have left the box: through an opening in its bottom or a side, or through its open top.
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

/// Particles are removed when the list of pairs is rebuilt: once they are a largest diameter below the bottom, or
/// wholly beyond the top or a side, or have rolled round the rim of an opening in a side. The same on every rank, and
/// on any number of ranks to the bit.
class Outflow final : public KeptPart {
 public:
  /// For a box with openings. \param exits  its holes one by one and its top, if particles are counted in each
  Outflow(const Box& box, const Materials& materials, std::vector<Opening> exits = {});

  std::vector<std::int64_t> number;                  ///< of each species, since the start
  std::vector<std::vector<std::int64_t>> number_at;  ///< of these, through each of several exits, [exit][species]
  std::int64_t steps = 0;                            ///< step numbers at their exit, summed over them
  /// Their energy at exit, in the unit of energy: motion, spin and gravity, and the springs of all their contacts.
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

  /// Number of particles about to leave, on all ranks, while contacts still exist. Collective.
  std::int64_t count_leaving(const Model& model);
  void take_out(Particles& particles);
  void write(core::Checkpoint& checkpoint, const Particles& particles, const core::Ranks* ranks) const override;
  void read(const Restored& from) override;

 private:
  [[nodiscard]] std::size_t exit_of(const Place& place) const;

  const Box& box_;
  std::vector<Opening> exits_;
  double greatest_diameter_;  ///< m
};

}  // namespace polybed::dem
