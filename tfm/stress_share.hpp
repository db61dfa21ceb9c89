// How the solids pressure on a face is shared among species.
#pragma once

#include <algorithm>
#include <array>

#include "tfm/fraction_face.hpp"
#include "tfm/mixture.hpp"

namespace polybed::tfm {

/// Of the force -grad p_s on a face each species bears x_j, its share of the solids in the more packed of the two
/// cells, carried to the face by a limited slope: what presses is what is packed, and a species that is only in the
/// other cell is not thrown off, nor the rest drawn in by the fluid that takes its place. Per mass that is
///
///   factor_j / (phi rho_j),  factor_j = phi (x_j/m_j) / sum_k phi_k (x_k/m_k),  m_j = phi_j + 1e-4 X_j,
///
/// with phi_j at the face as means of both cells, so that the force is -grad p_s whole. Where composition is even
/// across the face all factors are 1. They stay finite as phi_j -> 0, and do not see a species cut in two.
class StressShare {
 public:
  static constexpr std::size_t most_species = 15;  ///< as the case file allows

  StressShare(const Constants& constants, const Fields& fields) : constants_(constants), fields_(fields) {}

  /// Factors of all species on the face between c - s and c, the second of which is pressed on more if `rise` > 0.
  const std::array<double, most_species>& at(core::Index c, core::Index s, double rise) {
    double all = 0, pressed = 0;
    for (std::size_t j = 0; j < constants_.species(); ++j) {
      const double* q = fields_.solids.fraction[j].data();
      const double phi = 0.5 * (std::max(q[c - s], 0.0) + std::max(q[c], 0.0));
      const double seen = phi + composition_floor * constants_.bed_share[j];
      factor_[j] = seen > 0 ? LimitedFractionFace::at(fields_.share[j].data(), c, s, -rise) / seen : 0;
      all += phi;
      pressed += phi * factor_[j];
    }
    for (std::size_t j = 0; j < constants_.species(); ++j) factor_[j] = pressed > 0 ? all * factor_[j] / pressed : 1;
    return factor_;
  }

 private:
  const Constants& constants_;
  const Fields& fields_;
  std::array<double, most_species> factor_{};
};

}  // namespace polybed::tfm
