// Particles in the averaged fluid with textbook treatments, for tests only: each replaces one treatment of the product
// and leaves the rest as it is. Production code knows nothing of them.
#pragma once

#include <string>
#include <vector>

#include "dem/coupling/fluid_motion.hpp"
#include "dem/coupling/gather.hpp"
#include "dem/coupling/particle_forces.hpp"
#include "dem/coupling/scatter.hpp"
#include "fluid/flow.hpp"
#include "fluid/smoothing.hpp"
#include "hard/textbook.hpp"

namespace polybed::hard::naive {

/// Particles that do not touch, step by step as dem::Coupling and dem::Verlet do it, with the treatment of a name:
///   drag_explicit      a kick with the slip at its start, dU = h (a + kappa (U_f - U_p))
///   added_mass_lagged  added mass as a force, -C_m rho_f V a, with the acceleration of the last kick
///   pcm_void           all of a particle's volume in the cell of its centre
///   last_substep       the impulse of the last step of the particles, taken as that of all
///   double_buoyancy    the displaced fluid's weight once by the pressure and once by itself
///   nothing            no change: what the product does
/// Throws std::invalid_argument for any other name.
class ParticleRun final : public hard::TextbookSuspension {
 public:
  /// \param dt  of the particles, s; `dem.fluid_every` of the scene to a step of the fluid
  ParticleRun(const std::string& name, const core::Scene& scene, dem::Particles particles, double dt);

  /// One step of the fluid, those of the particles before it included.
  void step() override;

  [[nodiscard]] const dem::Particles& particles() const override { return particles_; }
  [[nodiscard]] const fluid::Flow& flow() const override { return flow_; }
  [[nodiscard]] const fluid::ParticlePhase& phase() const { return phase_; }
  [[nodiscard]] const core::Field& voidage() const override { return phase_.voidage; }
  /// Sums the particles up for the fluid where they are now.
  void collect();

 private:
  enum class Treatment { nothing, drag_explicit, added_mass_lagged, pcm_void, last_substep, double_buoyancy };
  static Treatment treatment_of(const std::string& name);
  void kick(std::size_t i);
  void move();
  void correct();
  void crowd_centres();
  void couple_two_way();
  void take_fields();

  Treatment treatment_;
  core::Scene scene_;
  dem::Materials materials_;
  dem::Particles particles_;
  double dt_, time_ = 0;
  int every_;
  fluid::Flow flow_;
  dem::ParticleForces forces_;
  fluid::ParticlePhase phase_;
  std::vector<core::Field> fraction_;
  fluid::Smoothing smoothing_;
  dem::Scatter scatter_;
  dem::Gather gather_;
  dem::FluidMotion motion_;
  std::vector<dem::Vector> last_;  ///< acceleration, m/s2, or impulse, kg m/s
};

/// Particles of one species given one by one.
[[nodiscard]] dem::Particles particles_of(const core::Scene& scene, const std::vector<scenes::Bead>& beads);

}  // namespace polybed::hard::naive
