// Slot Exchange, solids with solids: collisions of two species as sheared boxes of both have measured them.
#pragma once

#include <string>

#include "closures/species_exchange_kinetic.hpp"
#include "closures/stress_table.hpp"
#include "fluid/solids_table.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// K_12 = R(phi) beta_12 + C_s p_f phi_1 phi_2/phi^2, beta_12 of closures/species_exchange_kinetic.hpp at the granular
/// temperatures and the drift of the cell, R the ratio that a dry table of two species holds, at the restitution,
/// friction and share of the whole bed. p_f is the pressure of friction alone: collisions are in R. Beyond the table R
/// of its edge is held. Where both species are present, solids fractions outside the table and drifts, over the root of
/// the mean temperature, faster than those at which all of it was measured are counted.
class TableExchange : public SolidsExchange {
 public:
  /// Needs a granular temperature, which the stress of the solids has to have made. \param file  of the table
  /// Throws core::CaseError if there is none, the case has not two species or the table holds no exchange.
  TableExchange(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                const fluid::SolidsTable& table, const std::string& file, Fields& fields);
  void evaluate(Fields& fields) override;
  [[nodiscard]] std::optional<ClosureUse> use() const override { return use_; }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  closures::MonotoneCurve ratio_;
  double restitution_ = 0, fastest_ = 0;  ///< fastest_: |U_1 - U_2|/sqrt(theta) of the boxes
  double contact_;                        ///< C_s, s/m2
  ClosureUse use_;
};

}  // namespace polybed::tfm
