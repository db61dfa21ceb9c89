// How a table of the solids stress runs along the solids fraction, as the two-fluid model reads it.
#pragma once

#include <string>
#include <vector>

#include "tfm/solids_table.hpp"

namespace polybed::multiscale {

/// Where the pressure of a table does not rise with phi, on a grid ten times finer than its knots, from 0 to 0.02
/// below jamming: at fixed temperature (dry) or at fixed shear rate (wet). Empty if it rises everywhere.
[[nodiscard]] std::vector<std::string> falls_of(const tfm::SolidsTable& table);

/// Solids fractions up to which the pressure at fixed shear rate without drag falls in a dry table, as a dilute gas
/// does; 0 if it rises everywhere. Told, not refused.
[[nodiscard]] double falls_in_shear_up_to(const tfm::SolidsTable& table);

/// a(phi) of chi_eff = chi_CS (1 + a S) from the pressure of a dry table; one per point.
[[nodiscard]] std::vector<double> structure_coefficients(const tfm::SolidsTable& table);

}  // namespace polybed::multiscale
