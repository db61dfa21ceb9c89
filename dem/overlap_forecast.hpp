// How deep contacts will be at the speeds to expect, and how stiff they must be to stay within dem.max_overlap.
#pragma once

#include <string>

#include "core/case/scene.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/effects.hpp"

namespace polybed::dem {

/// To two digits, not below the value, which is above 0: what is advised must do.
[[nodiscard]] double rounded_up(double value);

/// What to write into a case so that a contact between two species, or one and "wall", is `factor` times as stiff, with
/// the number rounded up to two digits: dem.youngs_modulus = "1.3 MPa"; empty if a case does not accept it.
[[nodiscard]] std::string stiffer(const core::Scene& scene, const std::string& a, const std::string& b, double factor);

/// The stiffest that a case accepts: Young's modulus, Pa, or with linear springs their stiffness, N/m.
[[nodiscard]] double stiffest(const core::Scene& scene);

/// How much stiffer a contact must be for its overlap to become `allowed`: (overlap/allowed)^p, where the energy stored
/// goes with overlap^p, 5/2 after Hertz and 2 of linear springs. No unit.
[[nodiscard]] double stiffening(const NormalLaw& law, int kind, double overlap, double allowed);

struct OverlapForecast {
  std::string pair;       ///< of species, or a species and the wall, whose contact is the deepest for its size
  double overlap = 0;     ///< m
  double share = 0;       ///< over the smaller diameter
  double stiffening = 0;  ///< factor on all stiffnesses that brings it to four fifths of dem.max_overlap
  std::string warning;    ///< what is too soft and what would do; empty: nothing
};

/// What a large particle meets: a bed of smaller ones that share its mass, or a single one on a wall.
enum class Met { bed, single };

/// The deepest contact to expect: of each pair the heavier one comes at the speed given and meets the other held by its
/// neighbours, closures::mass_on_a_contact, or by a wall alone, which takes all of its mass. Met in beds were 0.4 to
/// 1.04 of it, see docs/guide/particles.md: what is advised keeps a fifth of dem.max_overlap in reserve. Attractions
/// pull them further in, as far as their work goes into the spring.
/// \param speed  of impacts, m/s
[[nodiscard]] OverlapForecast overlap_forecast(const core::Scene& scene, const Materials& materials,
                                               const PairLaws& laws, double speed, Met met = Met::bed);

}  // namespace polybed::dem
