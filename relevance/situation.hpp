// The situations of particles in a scene, from the case alone: each species in each zone at each velocity and
// temperature in the scene's range. Effects are weighed in all of them.
#pragma once

#include <string>
#include <vector>

#include "closures/drag.hpp"
#include "core/case/scene.hpp"
#include "relevance/advised_drag.hpp"

namespace polybed::relevance {

enum class Zone { packed, bulk, wall, freeboard };
/// Name in cases and tables.
[[nodiscard]] std::string name_of(Zone zone);

/// A particle of one species somewhere in the column.
struct Situation {
  Zone zone{};
  std::string species;  ///< its name
  double diameter = 0, density = 0;
  double fluid_density = 0, viscosity = 0, temperature = 0;  ///< temperature 0: unknown
  double velocity = 0;                                       ///< superficial, U, m/s
  double voidage = 1;
  double slip = 0;   ///< w, m/s
  double f = 1;      ///< pure drag over Stokes
  double width = 0;  ///< L, m
  double shear = 0;  ///< 1/s
  double gravity = 0;

  [[nodiscard]] double reynolds() const { return fluid_density * velocity * diameter / viscosity; }
  [[nodiscard]] double particle_reynolds() const { return fluid_density * slip * diameter / viscosity; }
  /// tau_p, s.
  [[nodiscard]] double relaxation_time() const;
  /// F_ref, N: the buoyant weight, or the drag for neutrally buoyant particles.
  [[nodiscard]] double reference() const;
  /// t, s.
  [[nodiscard]] double time() const;
  /// beta, kg/(m3 s), for a bed of this species alone.
  [[nodiscard]] double exchange() const;
};

/// A species in a zone; fills in the slip U/eps, drag and shear from zone, velocity and voidage.
[[nodiscard]] Situation in_zone(Situation particle, Zone zone, double velocity, double voidage,
                                const closures::DragLaw& law);

/// The ranges in a scene.
struct Survey {
  std::vector<Situation> situations;
  std::vector<Situation> dry;                                ///< without a fluid: each species at rest on itself
  double least_velocity = 0, greatest_velocity = 0;          ///< superficial, m/s
  double solids_fraction = 0;                                ///< of the bed at its start
  double mean_fraction = 0;                                  ///< of the solids over the whole column
  double width = 0, height = 0, column_height = 0;           ///< m; height: of the settled bed
  double fluid_density = 0, viscosity = 0, temperature = 0;  ///< for the case itself; 0: unknown
  bool has_fluid = true, is_gas = false;
  std::vector<double> share;                                       ///< x_j
  double mixture_part = 0;                                         ///< greatest |f_j/f_mean - 1| of the bulk
  double greatest_slip_difference = 0, voidage_of_difference = 1;  ///< between two species, |U_j - U_k|, m/s
  DragScene drag_scene{};
  AdvisedDrag drag;  ///< the laws used to balance the forces

  double cell = 0;                  ///< least spacing of the run's grid, m; 0: none
  double clump_acceleration = 0;    ///< greatest for a packed clump of one species, m/s2
  double greatest_packed_slip = 0;  ///< over all velocities through the packed bed, carried or not, m/s

  /// The situations for weighing forces between particles.
  [[nodiscard]] const std::vector<Situation>& touching() const { return has_fluid ? situations : dry; }
};

/// Throws core::CaseError if the fluid is unknown at a required temperature.
[[nodiscard]] Survey survey(const core::Scene& scene);

/// The situations of one zone and species at given voidages, for a test or a table of scenes.
[[nodiscard]] std::vector<Situation> only_zones(const std::vector<Situation>& all,
                                                const std::vector<std::string>& zones);

}  // namespace polybed::relevance
