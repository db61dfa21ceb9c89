// The particle model, ready to run: it owns the particles, their contacts, and the step.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/case/scene.hpp"
#include "core/numerics/ranks.hpp"
#include "core/numerics/run.hpp"
#include "core/output/checkpoint.hpp"
#include "core/timers.hpp"
#include "dem/box.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/contacts/neighbours.hpp"
#include "dem/contacts/pair_forces.hpp"
#include "dem/contacts/relative_motion.hpp"
#include "dem/coupling/affine_drag.hpp"
#include "dem/coupling/coupling.hpp"
#include "dem/effects.hpp"
#include "dem/energy_sum.hpp"
#include "dem/feeding.hpp"
#include "dem/joined_work.hpp"
#include "dem/kept_part.hpp"
#include "dem/kept_state.hpp"
#include "dem/ledger.hpp"
#include "dem/outflow.hpp"
#include "dem/overlap_forecast.hpp"
#include "dem/parallel/exchange.hpp"
#include "dem/particles.hpp"
#include "dem/scene.hpp"
#include "dem/step_limits.hpp"
#include "dem/verlet.hpp"

namespace polybed::dem {

/// Work done so far on all ranks; repeats exactly from run to run and on any number of ranks, except for pairs across
/// ranks and the division of the box.
struct Work {
  std::uint64_t steps = 0, particle_steps = 0, pair_checks = 0, contact_steps = 0, rebuilds = 0, candidates = 0;
  std::uint64_t cuts = 0;         ///< of the box among the ranks, after the first
  std::uint64_t shortenings = 0;  ///< of the step, because of particles faster than expected
  double greatest_speed = 0;      ///< since the start, relative to a sheared box's own flow, m/s
  double imbalance = 1;           ///< greatest over mean work of the ranks at the last rebuild of the list
};

/// Counted energies since the start, on one rank, in the unit of energy.
struct CountedEnergy {
  EnergySum dissipated;   ///< in contacts
  EnergySum fluid_work;   ///< of a fluid on the particles
  EnergySum joined_work;  ///< by joined faces, of a sheared box or along gravity
};

/// The solver for a scene's fluid.
enum class FluidBy {
  model,  ///< averaged, coupled to the particles
  caller  ///< resolved between them: it adds impulses with kick(), and films stay
};

/// Kick of one particle, m/s and rad/s.
struct Kick {
  Vector dv{}, dw{};
};

class Model : public core::Simulation {
 public:
  /// The scene's particles at their start; throws core::CaseError for parts that cannot be created. Collective, like
  /// step, restart, checkpoint and resume.
  /// \param ranks  that share the box; null: it is all here  \param resolved_gap  for the caller's fluid, as in
  /// make_pair_laws()
  Model(const core::Scene& scene, core::Timers& timers, std::shared_ptr<const core::Ranks> ranks = nullptr,
        FluidBy fluid_by = FluidBy::model, double resolved_gap = 0);
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  ~Model() override = default;

  /// A time is reached with the nearest step to it.
  [[nodiscard]] double time() const override { return reported_; }
  /// One step of dt, towards the time nearest to `stop` that steps of one length reach.
  void step(double stop) override;
  /// The state is at the last step: observers read times at most a step old.
  void show(double) override {}
  [[nodiscard]] bool shows_inside_steps() const override { return false; }
  /// Rebuilds the list of pairs, as a resumed run does: both then have the same bits.
  void restart() override;

  /// All particles and contacts, to the bit, on the first rank; independent of the number of ranks.
  [[nodiscard]] core::Checkpoint checkpoint() const;
  /// The same for a file in two parts: all except the rows of particles and contacts, and those rows, which are
  /// computed from the state while they are written.
  [[nodiscard]] core::Checkpoint checkpoint_but_rows() const;
  [[nodiscard]] std::vector<core::BlockData> rows() const;
  /// Changes the velocities of each species, between steps, as a body force over some time would: it drives species
  /// apart in a box. Collective. \param dv  by species, m/s
  void push(const std::vector<Vector>& dv);
  /// Changes velocity and spin of each particle, between steps, as an impulse would. On one rank. \param by_id
  void kick(const std::vector<Kick>& by_id);
  /// Updates ghosts from their owners, which have moved half a step since the last forces. Collective.
  void refresh_ghosts();
  /// Resumes a run, on any number of ranks; reads only the first rank's checkpoint.
  void resume(const core::Checkpoint& checkpoint) { restore(checkpoint, true); }
  /// Starts at time 0 from the particles in a checkpoint.
  void start_from(const core::Checkpoint& checkpoint);

  [[nodiscard]] const Particles& particles() const { return particles_; }
  [[nodiscard]] const Contacts& pairs() const { return pairs_; }
  [[nodiscard]] const Contacts& walls() const { return walls_; }
  [[nodiscard]] const Materials& materials() const { return materials_; }
  [[nodiscard]] const PairLaws& laws() const { return laws_; }
  [[nodiscard]] const PairForces& pair_forces() const { return pair_forces_; }
  [[nodiscard]] const Box& box() const { return box_; }
  /// For the present step, which becomes shorter if particles are faster than expected.
  [[nodiscard]] const StepLimits& limits() const { return limits_; }
  /// Speeds expected before the run, and their effect on contacts.
  [[nodiscard]] const Speeds& expected() const { return expected_; }
  [[nodiscard]] const OverlapForecast& overlap_expected() const { return overlap_; }
  [[nodiscard]] const core::Ranks* ranks() const { return ranks_.get(); }
  [[nodiscard]] const std::shared_ptr<const core::Ranks>& share() const { return ranks_; }
  /// Drag of a sheared box; null without it.
  [[nodiscard]] const AffineDrag* affine_drag() const { return sheared_.get(); }
  /// Coupling with the fluid; null without one.
  [[nodiscard]] const Coupling* coupling() const { return coupling_.get(); }
  [[nodiscard]] Vector gravity() const { return gravity_; }
  [[nodiscard]] bool synchronised() const { return verlet_.synchronised(); }
  /// In the box now.
  [[nodiscard]] std::int64_t particle_count() const { return count_; }
  /// Null without feeds.
  [[nodiscard]] const Feeding* feeding() const { return feeding_.get(); }
  /// Null without openings.
  [[nodiscard]] const Outflow* outflow() const { return outflow_.get(); }
  /// Present positions of the particles' images.
  [[nodiscard]] Images images() const { return {box_, clock(), double(steps_ - marked_at_) * limits_.dt}; }
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  /// Collective.
  [[nodiscard]] Work work() const;
  /// Units of the loads of a particle.
  [[nodiscard]] FixedPoint unit_of_force() const { return force_unit_; }
  [[nodiscard]] FixedPoint unit_of_torque() const { return torque_unit_; }
  /// Units of the energies and momenta of all particles together.
  [[nodiscard]] FixedPoint energy_unit() const { return energy_unit_; }
  [[nodiscard]] FixedPoint momentum_unit() const { return momentum_unit_; }
  /// On this rank.
  [[nodiscard]] CountedEnergy counted_energy() const;

 private:
  void measure(const std::vector<Particle>& all);
  void make_parts(const std::vector<Particle>& all, FluidBy fluid_by);
  void place(const std::vector<Particle>& all, const std::vector<std::int32_t>& work);
  [[nodiscard]] std::int32_t work_of_particle() const { return coupling_ ? Coupling::work_of_particle : 1; }
  void restore(const core::Checkpoint& checkpoint, bool same_run);
  [[nodiscard]] Clock checked_clock(const core::Checkpoint& checkpoint, bool same_run) const;
  void look_ahead(const std::optional<Verlet::Drift>& known = {});
  /// From the last list to the end of the next drift, s.
  [[nodiscard]] double time_of_next() const { return double(steps_ + 1 - marked_at_) * limits_.dt; }
  [[nodiscard]] bool list_goes_stale(double drift, double since) const;
  bool keeps_list();
  void adapt_skin();
  void set_skin(double skin);
  [[nodiscard]] bool may_shorten() const;
  void shorten_step();
  void set_step_for(double began, std::int64_t began_at, double speed);
  void rebuild();
  void let_in();
  void take_out();
  void list_pairs(KeptContacts kept);
  void find_forces(double dt);
  /// Time of the state, s.
  [[nodiscard]] double clock() const { return began_ + double(steps_ - began_at_) * limits_.dt; }
  [[noreturn]] void stop_in_trouble() const;
  void wrap();
  Verlet::Drift move(double dt);

  core::Scene scene_;
  std::shared_ptr<const core::Ranks> ranks_;
  core::Timers& timers_;
  Box box_;
  Materials materials_;
  PairLaws laws_;
  std::vector<Particle> start_;  ///< of all ranks; freed after distribution
  Speeds expected_;
  StepLimits limits_;
  OverlapForecast overlap_;
  Vector gravity_;
  FixedPoint force_unit_, torque_unit_, energy_unit_, momentum_unit_;
  // Optional parts; null: absent.
  std::unique_ptr<Feeding> feeding_;
  std::unique_ptr<Outflow> outflow_;
  std::unique_ptr<Ledger> ledger_;
  std::unique_ptr<JoinedWork> joined_work_;
  std::unique_ptr<AffineDrag> sheared_;  ///< drag of a sheared box
  std::unique_ptr<Coupling> coupling_;   ///< with the fluid
  std::vector<KeptPart*> kept_;          ///< the existing parts among those above
  Around around_;
  bool held_;                                      ///< the particles do not move
  static constexpr double thickest_skin = 5;       ///< of that at the start
  double skin_;                                    ///< of the present list, m
  std::optional<RelativeMotion> relative_motion_;  ///< absent: the particle that moves furthest ends the list
  double allowed_drift_ = 0;                       ///< displacement since the mark that the list allows, m
  Verlet verlet_;
  NeighbourSearch search_;
  PairForces pair_forces_;
  Exchange exchange_;
  Particles particles_;
  Contacts pairs_, walls_;
  double reported_ = 0;  ///< s
  double began_ = 0;     ///< time of the first step of the present length, s
  std::int64_t steps_ = 0, count_ = 0, marked_at_ = 0;
  std::int64_t began_at_ = 0;  ///< number of steps before it
  double met_ = 0;             ///< greatest speed of this rank's particles so far, m/s
  /// Finding of all ranks for the next step: its drift is too far for the list, a particle is too fast for its length,
  /// or there is an error.
  enum class Ahead { clear, stale, fast, trouble } ahead_ = Ahead::clear;
  std::int64_t hasty_ = -1;    ///< id of an owned particle that would move too far in it, or -1
  bool beyond_units_ = false;  ///< a particle is faster than the unit of energy allows
  double counted_speed_ = 0;   ///< speed of all mass for which the unit of energy is made, m/s
  std::uint64_t timed_ = 1;    ///< steps that the timing of this one represents: reading the clock is a system call
  Work work_;
};

}  // namespace polybed::dem
