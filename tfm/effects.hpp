// The effects of the continuum model, by their slot in the equations. Effects that a scene does not need are not
// created: they have no fields, no timer and no branch in a loop.
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

/// Number of closure evaluations, and of those outside the stated range.
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
  /// For an exchange with a limited range; empty if it is valid everywhere.
  [[nodiscard]] virtual std::optional<ClosureUse> use() const { return {}; }
};

/// Slot Stress, of the fluid: adds to the fluid's acceleration.
class FluidStress {
 public:
  virtual ~FluidStress() = default;
  virtual void add(Fields& fields) = 0;
  /// mu/rho_f, m2/s: limits an explicit step.
  [[nodiscard]] virtual double kinematic_viscosity() const = 0;
};

/// Slot Stress, of the solids: owns and fills fields.stress.
class StressEffect {
 public:
  virtual ~StressEffect() = default;
  virtual void evaluate(Fields& fields) = 0;
  /// Greatest solids fraction that the stress allows for the whole bed's composition.
  [[nodiscard]] virtual double max_packing() const = 0;
  /// The same for a composition: shares of the species, as in closures.
  [[nodiscard]] virtual double packing_of(std::span<const double> share) const = 0;
  /// Greatest excess of phi over the maximum packing of a cell in the block; 0 if there is none.
  [[nodiscard]] virtual double packing_above(const Fields& fields) const = 0;
  /// Pressure, Pa, of solids at rest at a solids fraction, for the whole bed's composition.
  [[nodiscard]] virtual double pressure_at(double solids_fraction) const = 0;
  /// Pressure, Pa, in the topmost cell of a settled bed: from its solids fraction, unless packed solids below support
  /// more of its upper half, which weighs `half_weight` minus buoyancy, Pa.
  [[nodiscard]] virtual double pressure_on_top(double solids_fraction, [[maybe_unused]] double half_weight) const {
    return pressure_at(solids_fraction);
  }
  /// Solids fraction at which the stress has a pressure, Pa, for the whole bed's composition.
  [[nodiscard]] virtual double solids_fraction_at(double pressure) const = 0;
  /// For a stress with a limited range; empty if it is valid everywhere.
  [[nodiscard]] virtual std::optional<ClosureUse> use() const { return {}; }
};

/// Slot Stress, shear viscosity of the solids: creates stress.viscosity and strain, and adds to the viscosity.
class SolidsViscosity {
 public:
  virtual ~SolidsViscosity() = default;
  virtual void add(Fields& fields) = 0;
};

/// Slot Stress, collisions of the solids: adds to stress.pressure, slope and viscosity. If the granular temperature is
/// an unknown (slot Scalar), also computes the local part of its rate.
class CollisionalStress {
 public:
  virtual ~CollisionalStress() = default;
  virtual void add(Fields& fields) = 0;
  /// For a stress with a limited range; empty if it is valid everywhere.
  [[nodiscard]] virtual std::optional<ClosureUse> use() const { return {}; }
};

/// Slot Force: adds the force along an axis to fields.force.on_solids, on the faces where solids move.
class ForceEffect {
 public:
  virtual ~ForceEffect() = default;
  virtual void add(int axis, Fields& fields) = 0;
};

/// Slot Inertia: the response of velocities to forces and pressure. Owns and fills fields.inertia.
class InertiaEffect {
 public:
  virtual ~InertiaEffect() = default;
  /// Called while the accelerations of all phases contain only their convection.
  virtual void keep_convection(Fields& fields) = 0;
  /// Converts the accelerations that forces would give each phase alone into the coupled ones; sets the responses to
  /// the pressure.
  virtual void couple(Fields& fields) = 0;
  /// Sets the mobility B of the volume flux. Collective.
  virtual void set_mobility(Fields& fields) = 0;
};

/// Partial slip of the solids along walls.
class SolidsWall {
 public:
  virtual ~SolidsWall() = default;
  /// Sets the ghosts of the solids' velocities along walls; needs the viscosity with ghosts.
  virtual void fill_ghosts(Fields& fields) = 0;
};

/// tfm.solids_wall = "johnson_jackson". Throws core::StartError if the solids have no viscosity.
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
  std::vector<std::unique_ptr<ForceEffect>> forces;  ///< on individual particles
  std::unique_ptr<InertiaEffect> inertia;
  std::unique_ptr<SolidsWall> solids_wall;
  std::unique_ptr<fluid::Compressible> compressible;  ///< null for an incompressible fluid
  std::vector<std::string> warnings;                  ///< conditions of the scene outside an effect's measured range
};

struct Maker;  // tfm/effects/maker.hpp

/// All effects of this model, in the order of creation and of listings.
[[nodiscard]] const std::vector<const Maker*>& effects();

/// The valid entries of [effects], and the requirements of listed effects and of the keys of [tfm].
[[nodiscard]] std::vector<core::Role> roles();
[[nodiscard]] std::vector<core::Rule> rules(const std::vector<const Maker*>& list = effects());

/// Creates the effects in a scene and the fields that they own. Throws core::CaseError if a scene breaks a rule of the
/// effects, or if a table is for another regime.
Effects make_effects(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields, const std::vector<const Maker*>& list = effects());

}  // namespace polybed::tfm
