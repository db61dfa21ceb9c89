// Forces of the fluid besides drag, buoyancy and added mass: lift, spin, history, Brownian motion. Each is a separate
// effect, called once per step with its own loop; one that a scene leaves out costs nothing.
//
// The fluid loses what they give a particle: a force acts for half a step before its next evaluation and half a step
// after it, and both halves enter the impulse for the fluid's next step.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/coupling/fluid_motion.hpp"
#include "dem/coupling/gather.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/side_rows.hpp"

namespace polybed::dem {

/// The owned particles and their loads so far.
struct SideView {
  const Particles& particles;
  std::span<FluidLoad> loads;
  std::span<const Vector> vorticity;  ///< curl U_f at each particle, 1/s; empty unless an effect needs it
};

/// Slot Force: acts on each particle in addition to its drag.
class SideForce {
 public:
  virtual ~SideForce() = default;
  [[nodiscard]] virtual bool needs_vorticity() const { return false; }
  /// Whether it adds to the inertia of particles.
  [[nodiscard]] virtual bool has_inertia() const { return false; }
  /// Number of values that it stores per particle.
  [[nodiscard]] virtual std::size_t memory_size() const { return 0; }
  /// Called at the start of a run.
  virtual void begin(const SideView&, SideRows&) {}
  /// Called after each step of the fluid.
  virtual void end_interval(const SideView&, SideRows&) {}
  /// Adds its force on each particle to SideRows::force, and its inertia to the load.
  virtual void add(const SideView& view, SideRows& rows) = 0;
  /// Changes spins in a step of the particles. \param vorticity  as in SideView
  virtual void turn(std::span<const Vector> /*vorticity*/, Particles&, FluidMotion&) {}
};

class SideForces {
 public:
  /// The effects in a scene. \param density, viscosity  of the fluid, kg/m3, Pa s
  /// \param dt, interval  step of the particles and of the fluid, s
  SideForces(const core::Scene& scene, const Materials& materials, double density, double viscosity, double dt,
             double interval, const std::vector<const Maker*>& list = dem::effects());

  [[nodiscard]] bool present() const { return !effects_.empty(); }
  [[nodiscard]] bool needs_vorticity() const { return needs_vorticity_; }
  [[nodiscard]] bool has_inertia() const;

  // The following functions add the forces to loads at the same places; they do nothing without an effect.

  /// At the start of a run: clears memories.
  void begin(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads);
  /// Within a step of the particles, after their first half kick.
  void find(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads);
  /// After the fluid's step: replaces the force; no time passes.
  void refresh(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads);
  /// A fixed bed receives the force for a whole step.
  void hold(std::vector<FluidLoad>& loads) const;
  /// At the end of a step: spins.
  void turn(Particles& particles, FluidMotion& motion);

  /// Stored data of the owned particles; empty rows without an effect.
  [[nodiscard]] SideRows& rows() { return rows_; }
  [[nodiscard]] const SideRows& rows() const { return rows_; }

 private:
  void replace(const SideView& view);
  [[nodiscard]] std::size_t memory_end() const;
  [[nodiscard]] SideView look(const Particles& particles, const Gather& gather, std::vector<FluidLoad>& loads);
  void add_impulse(std::span<FluidLoad> loads, double time) const;

  std::vector<std::unique_ptr<SideForce>> effects_;
  SideRows rows_;
  bool needs_vorticity_ = false;
  std::vector<Vector> vorticity_;
  double dt_;
};

}  // namespace polybed::dem
