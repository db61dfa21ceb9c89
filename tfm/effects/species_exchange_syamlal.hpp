// Slot Exchange, solids with solids: collisions and contact between species after Syamlal and Gera.
#pragma once

#include "closures/species_exchange_syamlal.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

class SyamlalExchange : public SolidsExchange {
 public:
  SyamlalExchange(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                  Fields& fields);
  void evaluate(Fields& fields) override;

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  std::vector<closures::SpeciesPair> pairs_;
  double contact_;  ///< C_s, s/m2
};

}  // namespace polybed::tfm
