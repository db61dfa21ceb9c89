// Shape of a solids stress table along the solids fraction, as the two-fluid model reads it.
#pragma once

#include <string>
#include <vector>

#include "tfm/solids_table.hpp"

namespace polybed::multiscale {

/// The ranges where a table's pressure does not increase with phi, on a grid ten times finer than its knots, from 0 to
/// 0.02 below jamming: at fixed temperature (dry) or at fixed shear rate (wet). Empty if it increases everywhere.
[[nodiscard]] std::vector<std::string> falls_of(const tfm::SolidsTable& table);

/// Solids fraction up to which the pressure of a dry table at fixed shear rate without drag decreases, as for a dilute
/// gas; 0 if it increases everywhere. Reported, not rejected.
[[nodiscard]] double falls_in_shear_up_to(const tfm::SolidsTable& table);

/// a(phi) in chi_eff = chi_CS (1 + a S) from the pressure of a dry table; one per point.
[[nodiscard]] std::vector<double> structure_coefficients(const tfm::SolidsTable& table);

}  // namespace polybed::multiscale
