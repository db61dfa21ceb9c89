// Material properties of two touching bodies, from the case: by species, by pair, or by default.
#pragma once

#include <string>

#include "core/case/scene.hpp"

namespace polybed::core {

struct ElasticProperties {
  double youngs_modulus;  ///< Pa
  double poisson_ratio;
};

struct ContactProperties {
  ElasticProperties first, second;
  double restitution, friction;
};

/// The properties of a contact of two species, or of a species and "wall".
///
/// The modulus and Poisson ratio of a species are its own, else those in [dem]; a wall uses those in [dem]. Friction
/// and restitution are the means of the two partners, as in the TFM's exchange and collisions. A [[contact_pair]] of
/// the two, in either order, takes precedence; its modulus and Poisson ratio apply to both partners. Throws CaseError
/// for an unknown name.
[[nodiscard]] ContactProperties contact_properties(const Scene& scene, const std::string& a, const std::string& b);

}  // namespace polybed::core
