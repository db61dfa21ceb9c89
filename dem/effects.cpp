#include "dem/effects.hpp"

#include "core/start_error.hpp"

namespace polybed::dem {

PairLaws make_pair_laws(const core::Scene& scene, const Materials& materials, const std::vector<const Maker*>& list) {
  core::refuse(rules(list), scene);
  PairLaws laws;
  std::function<std::unique_ptr<NormalLaw>(const MakeNormal&)> around_normal;
  for_each_called<MakePair>(list, scene, [&](MakePair make, const std::string& law) {
    make({scene, materials, law, laws, around_normal});
  });
  if (!laws.normal)
    throw core::StartError("effects.contact: particles need a law of contact: hertz_mindlin, hertz or linear");
  return laws;
}

}  // namespace polybed::dem
