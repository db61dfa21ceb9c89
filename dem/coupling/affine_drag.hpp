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
    Four dv, free;  ///< change of the velocity, and the change without drag, m/s; three numbers count
  };
  /// U <- u + (U - u) exp(-x) + free (1 - exp(-x))/x, x = k h/m, u = gamma y e_x. \param h  s
  [[nodiscard]] Kick kick(const Particles& particles, std::size_t i, double h) const {
    const Motion& m = particles.motion[i];
    const double x = drag_[std::size_t(particles.species[i])] * m.inverse_mass * h, mean = mean_decay(x);
    const double linear = m.inverse_mass * force_.unit * h;
    const Four flow{shear_rate_ * particles.place[i].x[1], 0, 0, 0};
    Kick kick;
    kick.free = to_four(particles.load[i].force) * linear;
    kick.dv = mean * (kick.free + x * (flow - four_at(m.v)));
    return kick;
  }
  /// Adds the work of the drag in a kick, before the velocity changes.
  void account(const Particles& particles, std::size_t i, const Kick& kick, double, WorkShare share) {
    const Motion& m = particles.motion[i];
    double work = 0;
    for (std::size_t k = 0; k < 3; ++k)
      work += (m.v[k] + 0.5 * kick.dv[k]) * kick.dv[k] - (m.v[k] + share.load * kick.dv[k]) * kick.free[k];
    work_.add(work / m.inverse_mass * energy_.per_unit);
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
  return scene.fluid.present() && scene.column.shear_rate != 0 && core::acts(scene, "drag");
}

}  // namespace polybed::dem
