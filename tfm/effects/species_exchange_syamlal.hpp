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
  static void set_cells(SyamlalExchange& of, const Fields& fields, core::Index begin, core::Index end);
  static void set_pair(const SyamlalExchange& of, Fields& fields, std::size_t j, std::size_t k, std::size_t pair,
                       core::Index begin, core::Index end);

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  std::vector<closures::SpeciesPair> pairs_;
  double contact_;                         ///< C_s, s/m2
  core::Field surface_, contact_of_cell_;  ///< work space: sum phi_m/D_m, 1/m; C_s p_s/phi^2
};

}  // namespace polybed::tfm
