#include "core/case/contact_properties.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace polybed::core {

namespace {

struct Material {
  ElasticProperties elastic;
  double restitution, friction;
};

Material material_of(const Scene& scene, const std::string& name) {
  const Dem& dem = scene.dem;
  const Material common{{dem.youngs_modulus.value_or(least_modulus), dem.poisson_ratio}, dem.restitution, dem.friction};
  if (name == "wall") return common;
  const auto found =
      std::find_if(scene.species.begin(), scene.species.end(), [&](const Species& s) { return s.name == name; });
  if (found == scene.species.end()) throw CaseError("no species '" + name + "'");
  return {{found->youngs_modulus.value_or(common.elastic.youngs_modulus),
           found->poisson_ratio.value_or(common.elastic.poisson_ratio)},
          found->restitution.value_or(common.restitution),
          found->friction.value_or(common.friction)};
}

bool is_between(const ContactPair& pair, const std::string& a, const std::string& b) {
  if (pair.between.size() != 2) return false;
  return (pair.between[0] == a && pair.between[1] == b) || (pair.between[0] == b && pair.between[1] == a);
}

}  // namespace

ContactProperties contact_properties(const Scene& scene, const std::string& a, const std::string& b) {
  const Material first = material_of(scene, a), second = material_of(scene, b);
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
