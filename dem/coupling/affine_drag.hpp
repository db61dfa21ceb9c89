// Drag in a sheared box whose fluid follows the box's own flow, whatever the particles do.
#pragma once

#include <vector>

#include "core/case/scene.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/coupling/fluid_motion.hpp"
#include "dem/kept_part.hpp"
#include "dem/kept_sums.hpp"
#include "dem/particles.hpp"
#include "dem/scene.hpp"
#include "dem/several.hpp"

namespace polybed::dem {

/// Drag k_j (gamma y e_x - U) on each particle, k_j = 3 pi mu D_j eps f_j with f_j for the composition and voidage of
/// the whole box at zero slip: it replaces the fluid that wet stress boxes lack. For constant k the motion under it is
/// integrated exactly, so that no step is too long for it. Other boxes contain none.
class AffineDrag final : public KeptPart {
 public:
  /// \param solids  in the box  \param force, energy  units for the forces and the work
  AffineDrag(const core::Scene& scene, const Materials& materials, const SolidsVolume& solids, const Vector& box,
             FixedPoint force, FixedPoint energy);

  /// k_j for a species, kg/s.
  [[nodiscard]] double coefficient(std::size_t species) const { return drag_[species]; }

  struct Kick {
    FourVectors dv, free;  ///< change of the velocity, and the change without drag, m/s
  };
  struct Pull {
    FourVectors free, flow;
    Four x, mean;
  };
  /// U <- u + (U - u) exp(-x) + free (1 - exp(-x))/x, x = k h/m, u = gamma y e_x. \param h  s
  template <class Group>
  [[gnu::always_inline, nodiscard]] Pull pull(const Particles& particles, const Group& group, const FourMotions& s,
                                              double h) const {
    Pull pull{s.load.force * (s.inverse_mass * force_.unit * h), {shear_rate_ * s.y, Four{}, Four{}}, {}, {}};
    for (std::size_t n = 0; n < 4; ++n) {
      pull.x[n] = drag_[std::size_t(particles.species[group[n]])] * s.inverse_mass[n] * h;
      pull.mean[n] = mean_decay(pull.x[n]);
    }
    return pull;
  }
  template <class Group>
  [[gnu::always_inline, nodiscard]] Pull take(const Particles& particles, const Group& group, const FourMotions& s,
                                              double h) const {
    return pull(particles, group, s, h);
  }
  [[gnu::always_inline, nodiscard]] static Kick kick(const Pull& pull, const FourVectors& v) {
    const auto change = [&](const Four& f, const Four& u, const Four& v) { return pull.mean * (f + pull.x * (u - v)); };
    return {each(change, pull.free, pull.flow, v), pull.free};
  }
  /// Adds the work of the drag in a kick, before the velocity changes.
  template <class Group>
  [[gnu::always_inline]] void account(const Group& group, const Kick& kick, const FourMotions& s, double,
                                      WorkShare share) {
    const auto of = [&](const Four& v, const Four& dv, const Four& free) {
      return (v + 0.5 * dv) * dv - (v + share.load * dv) * free;
    };
    const Four work = sum_of(each(of, s.v, kick.dv, kick.free)) / s.inverse_mass * energy_.per_unit;
    for (std::size_t n = 0; n < group.count; ++n) work_.add(work[n]);
  }
  void sum_work() const {}

  [[nodiscard]] const EnergySum& work() const { return work_; }
  void write(core::Checkpoint& checkpoint, const Particles&, const core::Ranks* ranks) const override {
    write_sum(checkpoint, ranks, "fluid_work", work_);
  }
  void read(const Restored& from) override { work_ = sum_on_first(from.ranks, from.checkpoint, "fluid_work"); }

 private:
  std::vector<double> drag_;  ///< k_j, kg/s
  double shear_rate_;
  FixedPoint force_, energy_;
  EnergySum work_;  ///< on this rank's particles since the start, in the frame of the box's bottom
};

/// Whether the drag in a scene is for a sheared box.
[[nodiscard]] inline bool has_affine_drag(const core::Scene& scene) {
  return scene.fluid.present() && scene.column.shear_rate != 0 && scene.drag().acts();
}

}  // namespace polybed::dem
