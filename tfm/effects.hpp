// The effects of the continuum model, by the slot they fill in the equations. What a scene does not call for is not
// made: it has no fields, no timer and no branch in a loop.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/case/registry.hpp"
#include "core/case/rule.hpp"
#include "core/case/scene.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/compressible.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// How often closures were asked outside the range they are stated for.
struct ClosureUse {
  std::string name;
  std::uint64_t evaluations = 0, guarded = 0;
};

/// Slot Exchange, fluid with solids: fills solids.exchange (b_j) in all owned cells, ghosts included.
class FluidExchange {
 public:
  virtual ~FluidExchange() = default;
  virtual void evaluate(Fields& fields) = 0;
  [[nodiscard]] virtual ClosureUse use() const = 0;
};

/// Slot Exchange, solids with solids: owns and fills fields.species_exchange.
class SolidsExchange {
 public:
  virtual ~SolidsExchange() = default;
  virtual void evaluate(Fields& fields) = 0;
  /// Of an exchange with a range; empty of one that holds everywhere.
  [[nodiscard]] virtual std::optional<ClosureUse> use() const { return {}; }
};

/// Slot Stress, of the fluid: adds to the fluid's acceleration.
class FluidStress {
 public:
  virtual ~FluidStress() = default;
  virtual void add(Fields& fields) = 0;
  /// mu/rho_f, m2/s: what limits an explicit step.
  [[nodiscard]] virtual double kinematic_viscosity() const = 0;
};

/// Slot Stress, of the solids: owns and fills fields.stress.
class StressEffect {
 public:
  virtual ~StressEffect() = default;
  virtual void evaluate(Fields& fields) = 0;
  /// Greatest solids fraction that the stress allows for the whole bed's composition.
  [[nodiscard]] virtual double max_packing() const = 0;
  /// The same for a composition: shares of the species as closures see them.
  [[nodiscard]] virtual double packing_of(std::span<const double> share) const = 0;
  /// How far phi lies above the maximum packing of its cell, where in the block that is furthest; 0 if nowhere.
  [[nodiscard]] virtual double packing_above(const Fields& fields) const = 0;
  /// Pressure, Pa, of solids at rest at a solids fraction, for the whole bed's composition.
  [[nodiscard]] virtual double pressure_at(double solids_fraction) const = 0;
  /// Pressure, Pa, of the topmost cell of a settled bed: that of its solids fraction, unless packed solids below hold
  /// more of its upper half, which weighs `half_weight` less buoyancy, Pa.
  [[nodiscard]] virtual double pressure_on_top(double solids_fraction, [[maybe_unused]] double half_weight) const {
    return pressure_at(solids_fraction);
  }
  /// Solids fraction at which the stress carries a pressure, Pa, for the whole bed's composition.
  [[nodiscard]] virtual double solids_fraction_at(double pressure) const = 0;
  /// Of a stress with a range; empty of one that holds everywhere.
  [[nodiscard]] virtual std::optional<ClosureUse> use() const { return {}; }
};

/// Slot Stress, shear viscosity of the solids: makes stress.viscosity and strain, and adds to the first.
class SolidsViscosity {
 public:
  virtual ~SolidsViscosity() = default;
  virtual void add(Fields& fields) = 0;
};

/// Slot Stress, collisions of the solids: adds to stress.pressure, slope and viscosity; where the granular temperature
/// is an unknown (slot Scalar) also finds the local part of its rate.
class CollisionalStress {
 public:
  virtual ~CollisionalStress() = default;
  virtual void add(Fields& fields) = 0;
  /// Of a stress with a range; empty of one that holds everywhere.
  [[nodiscard]] virtual std::optional<ClosureUse> use() const { return {}; }
};

/// Slot Force: adds the force along an axis to fields.force.on_solids, on the faces where solids move.
class ForceEffect {
 public:
  virtual ~ForceEffect() = default;
  virtual void add(int axis, Fields& fields) = 0;
};

/// Slot Inertia: what forces and the pressure do to velocities. Owns and fills fields.inertia.
class InertiaEffect {
 public:
  virtual ~InertiaEffect() = default;
  /// Called while the accelerations of all phases are their convection alone.
  virtual void keep_convection(Fields& fields) = 0;
  /// Turns the accelerations that forces would give each phase alone into those that they have together; sets the
  /// responses to the pressure.
  virtual void couple(Fields& fields) = 0;
  /// Sets the mobility B of the volume flux. Collective.
  virtual void set_mobility(Fields& fields) = 0;
};

/// What walls do to solids that slip along them, where that is neither nothing nor all.
class SolidsWall {
 public:
  virtual ~SolidsWall() = default;
  /// Sets the ghosts of the solids' velocities along walls; the viscosity, with ghosts, must be known.
  virtual void fill_ghosts(Fields& fields) = 0;
};

/// tfm.solids_wall = "johnson_jackson". Throws core::StartError where the solids have no viscosity.
[[nodiscard]] std::unique_ptr<SolidsWall> johnson_jackson_wall(const core::Scene& scene, const Constants& constants,
                                                               const fluid::Boundaries& boundaries, Fields& fields);

/// The effects that are on; null where absent.
struct Effects {
  std::unique_ptr<FluidExchange> drag;
  std::unique_ptr<SolidsExchange> species_exchange;
  std::unique_ptr<FluidStress> fluid_stress;
  std::unique_ptr<StressEffect> solids_stress;
  std::unique_ptr<SolidsViscosity> solids_viscosity;
  std::unique_ptr<CollisionalStress> collisions;
  std::vector<std::unique_ptr<ForceEffect>> forces;  ///< on single particles
  std::unique_ptr<InertiaEffect> inertia;
  std::unique_ptr<SolidsWall> solids_wall;
  std::unique_ptr<fluid::Compressible> compressible;  ///< of an incompressible fluid: null
  std::vector<std::string> warnings;                  ///< where the scene is not what an effect was measured for
};

struct Maker;  // tfm/effects/maker.hpp

/// All effects of this model, in the order in which they are made and listed.
[[nodiscard]] const std::vector<const Maker*>& effects();

/// What [effects] may name, and what the effects of a list and the keys of [tfm] require.
[[nodiscard]] std::vector<core::Role> roles();
[[nodiscard]] std::vector<core::Rule> rules(const std::vector<const Maker*>& list = effects());

/// Makes the effects that a scene names and the fields they own; throws core::CaseError for a scene that breaks a rule
/// of the effects, or a table that is of another regime.
Effects make_effects(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields, const std::vector<const Maker*>& list = effects());

}  // namespace polybed::tfm
