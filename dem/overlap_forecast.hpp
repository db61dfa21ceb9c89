// Expected overlap of contacts at the expected speeds, and the stiffness that keeps them within dem.max_overlap.
#pragma once

#include <string>

#include "core/case/scene.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/effects.hpp"

namespace polybed::dem {

/// Rounds a positive value up to two digits, so that a recommendation suffices.
[[nodiscard]] double rounded_up(double value);

/// The entry of a case that makes a contact between two species, or one and "wall", `factor` times as stiff, with the
/// number rounded up to two digits: dem.youngs_modulus = "1.3 MPa"; empty if a case does not accept it.
[[nodiscard]] std::string stiffer(const core::Scene& scene, const std::string& a, const std::string& b, double factor);

/// The stiffest value that a case accepts: Young's modulus, Pa, or with linear springs their stiffness, N/m.
[[nodiscard]] double stiffest(const core::Scene& scene);

/// Factor on the stiffness of a contact that reduces its overlap to `allowed`: (overlap/allowed)^p, where the stored
/// energy scales with overlap^p, 5/2 for Hertz and 2 for linear springs. No unit.
[[nodiscard]] double stiffening(const NormalLaw& law, int kind, double overlap, double allowed);

struct OverlapForecast {
  std::string pair;       ///< of species, or a species and the wall, with the deepest contact for its size
  double overlap = 0;     ///< m
  double share = 0;       ///< over the smaller diameter
  double stiffening = 0;  ///< factor on all stiffnesses that reduces it to four fifths of dem.max_overlap
  std::string warning;    ///< stiffness that is too low and a sufficient one; empty: none
};

/// The target of a large particle: a bed of smaller ones that share its mass, or a single one on a wall.
enum class Met { bed, single };

/// The deepest expected contact: in each pair the heavier particle arrives at the given speed and hits the other, which
/// its neighbours support, closures::mass_on_a_contact, or a wall alone, which absorbs all of its mass. Beds reached
/// 0.4 to 1.04 of it, see docs/guide/particles.md: the recommendation keeps a fifth of dem.max_overlap in reserve.
/// Attractions increase the overlap until the spring absorbs their work.
/// \param speed  of impacts, m/s
[[nodiscard]] OverlapForecast overlap_forecast(const core::Scene& scene, const Materials& materials,
                                               const PairLaws& laws, double speed, Met met = Met::bed);

}  // namespace polybed::dem
