#include "core/case/contact_properties.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace polybed::core {

namespace {

struct Body {
  ElasticProperties elastic;
  double restitution, friction;
};

Body body_of(const Scene& scene, const std::string& name) {
  const ElasticProperties common{scene.dem.youngs_modulus.value_or(least_modulus), scene.dem.poisson_ratio};
  if (name == "wall") return {common, scene.material.restitution, scene.material.friction};
  const auto found =
      std::find_if(scene.species.begin(), scene.species.end(), [&](const Species& s) { return s.name == name; });
  if (found == scene.species.end()) throw CaseError("no species '" + name + "'");
  return {{found->youngs_modulus.value_or(common.youngs_modulus), found->poisson_ratio.value_or(common.poisson_ratio)},
          found->restitution,
          found->friction};
}

bool is_between(const ContactPair& pair, const std::string& a, const std::string& b) {
  if (pair.between.size() != 2) return false;
  return (pair.between[0] == a && pair.between[1] == b) || (pair.between[0] == b && pair.between[1] == a);
}

}  // namespace

ContactProperties contact_properties(const Scene& scene, const std::string& a, const std::string& b) {
  const Body first = body_of(scene, a), second = body_of(scene, b);
  ContactProperties contact{first.elastic, second.elastic, 0.5 * (first.restitution + second.restitution),
                            0.5 * (first.friction + second.friction)};
  for (const ContactPair& pair : scene.contact_pairs) {
    if (!is_between(pair, a, b)) continue;
    for (ElasticProperties* partner : {&contact.first, &contact.second}) {
      partner->youngs_modulus = pair.youngs_modulus.value_or(partner->youngs_modulus);
      partner->poisson_ratio = pair.poisson_ratio.value_or(partner->poisson_ratio);
    }
    contact.restitution = pair.restitution.value_or(contact.restitution);
    contact.friction = pair.friction.value_or(contact.friction);
  }
  return contact;
}

}  // namespace polybed::core
