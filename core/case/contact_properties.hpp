// What two touching bodies are made of, as the case says it: by species, by pair, by default.
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
/// A species has its own modulus and Poisson ratio, else those of [dem]; a wall is made of those of [dem]. Of two
/// partners the means of their friction and restitution hold, as they do in the TFM's exchange and collisions. What
/// [[contact_pair]] says of the pair, in either order, goes before; its modulus and its Poisson ratio are those of both
/// partners. Throws CaseError at a name that is none.
[[nodiscard]] ContactProperties contact_properties(const Scene& scene, const std::string& a, const std::string& b);

}  // namespace polybed::core
