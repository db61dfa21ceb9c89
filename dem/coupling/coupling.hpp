// Coupling of particles and fluid: exchanged data, and order of the steps.
//
// During a fluid step the fluid's fields and the loads on each particle are constant. The particle moves with exactly
// integrated drag, and its impulse is summed. At the end of the step the loads are recomputed at the new places, and
// each particle receives half of their change (trapezoidal rule). Side forces depend on spins and on earlier steps;
// with them all loads are recomputed in every particle step. Then the fluid receives the particles' volumes and
// impulses and takes its step. Each particle then receives one impulse: the effect of the fluid's change over the step.
// The fluid's equations include this impulse, so that total momentum is conserved for any length of the steps.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "core/timers.hpp"
#include "dem/coupling/fluid_motion.hpp"
#include "dem/coupling/gather.hpp"
#include "dem/coupling/kept_loads.hpp"
#include "dem/coupling/particle_forces.hpp"
#include "dem/coupling/scatter.hpp"
#include "dem/effects/side_forces.hpp"
#include "dem/kept_part.hpp"
#include "fluid/flow.hpp"
#include "fluid/smoothing.hpp"

namespace polybed::dem {

class Exchange;
class Outflow;

class Coupling final : public KeptPart {
 public:
  struct Units {
    FixedPoint force, energy;  ///< N, J
  };
  /// \param ranks  that share the box; null: it is all here  \param units  for the loads and the fluid's work
  /// \param dt  of the particles, s  \param speed  greatest expected, m/s  \param volume, count  of all particles, m3
  Coupling(const core::Scene& scene, const Materials& materials, std::shared_ptr<const core::Ranks> ranks,
           core::Timers& timers, Units units, double dt, double speed, double volume, std::int64_t count);
  ~Coupling() override;

  /// Starts the fluid between the particles at the beginning of a run.
  void begin(Particles& particles);
  void begin_from_other(Particles& particles) {
    motion_.set_work({});
    begin(particles);
  }
  /// For a fixed bed: the particles do not move and only receive the fluid's drag over a step.
  void hold(const Particles& particles);
  /// Computes the loads at the particles' places, unless loads are constant during a fluid step.
  void find_forces(const Particles& particles, std::uint64_t timed);
  /// Applies the fluid's torques to the spins in a step.
  void turn(Particles& particles) { sides_.turn(particles, motion_); }
  /// Whether the fluid's step is due after this number of particle steps.
  [[nodiscard]] bool due(std::int64_t steps) const { return steps % every_ == 0; }
  /// The fluid's step to a time; each particle then receives the impulse of the change of the fluid.
  void advance(Particles& particles, double time, Arrivals arrivals);
  /// Before particles change ranks and places, and after.
  void send_ahead(Exchange& exchange, const Particles& particles);
  void settle_in(const Particles& particles);
  /// Deletes the data of particles that are about to be removed.
  void let_go(const Outflow& outflow, const Particles& particles);
  /// From here on particles count as far as they have come in.
  void see(Arrivals arrivals) {
    if (scatter_.open_faces() != nullptr) scatter_.open_faces()->see(std::move(arrivals));
  }
  /// Particles that have entered since the end of a step of the fluid: forces act on them from now on; nothing changes for the others. Collective. \param first  least id of those that have entered
  void take_in(const Particles& particles, std::int64_t first);
  /// Cost of a particle relative to a contact's: 5.5 was measured (docs/theory/parallel.md).
  static constexpr std::int32_t work_of_particle = 5;
  /// Whether the particles' steps can become shorter after this number of steps: only between steps of the fluid, and
  /// without side forces, which depend on the step length.
  [[nodiscard]] bool may_shorten(std::int64_t steps) const { return due(steps) && !sides_.present(); }
  void set_dt(const Particles& particles, double dt) {
    dt_ = dt;
    relax(particles);
  }
  /// Further solves do not depend on earlier steps.
  void restart() { flow_.forget(); }
  void write(core::Checkpoint& checkpoint, const Particles& particles, const core::Ranks* ranks) const override;
  void require(const core::Checkpoint& checkpoint) const override;
  /// Restores the fluid and its forces on the particles from a checkpoint; without a fluid there, as at a start.
  void read(const Restored& from) override;

  [[nodiscard]] FluidMotion& motion() { return motion_; }
  [[nodiscard]] const FluidMotion& motion() const { return motion_; }
  [[nodiscard]] const fluid::Flow& flow() const { return flow_; }
  [[nodiscard]] const fluid::FlowStep& last_step() const { return last_; }
  [[nodiscard]] const std::vector<core::Field>& fraction() const { return fraction_; }
  [[nodiscard]] const ParticleForces& forces() const { return forces_; }
  [[nodiscard]] const Gather& gather() const { return gather_; }
  [[nodiscard]] SideForces& sides() { return sides_; }
  [[nodiscard]] const SideForces& sides() const { return sides_; }
  [[nodiscard]] int every() const { return every_; }
  /// Sums of squares over this rank's particles and this process's fluid steps, in one unit: for the change of the
  /// force during a step, and for the force at its end.
  struct Changes {
    EnergySum change, force;
  };
  [[nodiscard]] const Changes& changes() const { return changes_; }
  /// Full width at half height of the averaging kernel, m; 0: bilinear weights alone.
  [[nodiscard]] double kernel_width() const { return width_; }
  /// Mean net pressure on the distributor minus the outlet's, Pa. Collective.
  [[nodiscard]] double pressure_drop() const;
  /// Mean over the box of voidage times vertical velocity of the fluid, m/s. Collective.
  [[nodiscard]] double fluid_flux() const;
  /// A box with nothing but joined faces whose weight the pressure carries: its momentum stays what it was.
  struct Frame {
    Vector momentum{};  ///< of particles and fluid at the start, kg m/s
    Vector now{};       ///< after the last step of the fluid
    Vector velocity{};  ///< by which all has been moved since the start to keep the momentum, m/s
    double mass = 0;    ///< of particles and fluid, kg
  };
  /// Empty for other boxes.
  [[nodiscard]] const std::optional<Frame>& frame() const { return frame_; }
  /// Largest solids fraction in a cell of this rank's block.
  [[nodiscard]] double most_solids() const;
  /// The fluid of the whole column, on every rank. Collective.
  struct Column {
    core::Grid grid;
    std::vector<core::Field> fraction;    ///< phi_j
    core::FaceField velocity;             ///< U_f, m/s
    core::Field pressure;                 ///< net, Pa
    core::Field total_pressure, density;  ///< for a compressible fluid, Pa, kg/m3; else empty
  };
  [[nodiscard]] Column column() const;
  /// curl U_f in the cells of the whole column, 1/s, as used for the particles. Collective.
  struct Vorticity {
    core::Grid grid;
    std::array<core::Field, 3> components;
  };
  [[nodiscard]] Vorticity vorticity() const;
  /// Steps of the fluid since the start.
  [[nodiscard]] std::uint64_t steps() const { return steps_; }

 private:
  void write_fields(core::Checkpoint& checkpoint) const;
  void read_loads(const Restored& from);
  void read_frame(const Restored& from);
  void read_fields(const core::Checkpoint& checkpoint);
  void read_sides(const Restored& from);
  void collect(const Particles& particles);
  void require_voidage() const;
  void drive(const Particles& particles);
  [[nodiscard]] Vector momentum_of(const Particles& particles) const;
  void keep_momentum(Particles& particles);
  void smooth(core::FaceField& field) const;
  void smooth_sums();
  [[nodiscard]] bool has_sloping_walls() const;
  void slip(core::FaceField& velocity) const;
  void correct(Particles& particles);
  void couple_two_way(Particles& particles);
  void take_fields();
  void here(std::initializer_list<core::FaceField*> fields) const;
  void fetch();
  void weigh();
  [[nodiscard]] core::Field of_column(const core::Field& own) const;
  void take_own(const core::Field& column, core::Field& own) const;
  void find_vorticity(core::FaceField velocity, std::array<core::Field, 3>& vorticity) const;
  [[nodiscard]] const OwnShare* own() const { return own_ ? &*own_ : nullptr; }
  [[nodiscard]] bool has_inertia() const { return forces_.has_added_mass() || sides_.has_inertia(); }
  /// Whether loads are constant during a fluid step and corrected at its end. A fixed bed needs no correction.
  [[nodiscard]] bool stand() const { return !sides_.present() && !held_; }
  /// Sets the coefficients for the two kicks of a step.
  void relax(const Particles& particles) { motion_.relax(particles, 0.5 * dt_); }
  /// Step of the fluid, s.
  [[nodiscard]] double interval() const { return every_ * dt_; }

  std::shared_ptr<const core::Ranks> ranks_;
  core::Timers& timers_;
  fluid::Flow flow_;
  std::vector<core::Field> fraction_;     ///< phi_j, [species][cell]
  core::Field at_ends_;                   ///< on the faces of bottom and top: force on particles per volume, N/m3
  std::optional<GridExchange> exchange_;  ///< absent: every rank has the whole fluid
  /// On the cells that this rank's particles touch; empty without an exchange.
  std::vector<core::Field> fraction_here_;
  core::FaceField velocity_here_, gradient_here_;
  std::array<core::Field, 3> vorticity_, vorticity_here_;  ///< empty if no effect needs it
  std::optional<double> given_gradient_;  ///< mean, of the net pressure between joined ends, Pa/m; else the weight's
  std::optional<Frame> frame_;
  double width_;
  fluid::Smoothing smoothing_;
  ParticleForces forces_;
  SideForces sides_;
  fluid::ParticlePhase phase_;
  Scatter scatter_;
  Gather gather_;
  std::optional<OwnShare> own_;  ///< absent: averages include the particle itself
  FluidMotion motion_;
  std::vector<KeptLoad> loads_on_the_way_;  ///< while particles change ranks
  KeptRows sides_on_the_way_;
  int every_;
  bool held_;
  double dt_;  ///< of the particles, s
  fluid::FlowStep last_;
  std::uint64_t steps_ = 0;
  std::vector<FluidLoad> before_;  ///< at the start of a fluid step, while it ends
  Changes changes_;
  double per_square_;  ///< units of changes_ in 1 N2
};

}  // namespace polybed::dem
