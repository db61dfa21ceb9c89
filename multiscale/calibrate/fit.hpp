// From boxes to a table: means over seeds, their errors, and whether the table may be used.
#pragma once

#include <string>
#include <vector>

#include "fluid/solids_table.hpp"
#include "multiscale/calibrate/box_result.hpp"

namespace polybed::multiscale {

/// Greatest residual of a fit that may be used.
inline constexpr double greatest_residual = 0.05;
/// Solids fractions from which on one can be left out and read from the others.
inline constexpr std::size_t least_to_leave_one_out = 4;

/// The table of sheared boxes in the order of a plan. Residual: greatest |box/fit - 1| of p and mu, less two standard
/// errors of the box; 0 where each point has one box. left_out: |left out/fit - 1| of p where a solids fraction is
/// taken from the others; 0 where there are too few.
[[nodiscard]] fluid::SolidsTable fitted(const Plan& plan, const std::vector<BoxResult>& boxes);

/// lambda of p = mu_f gamma V (1 + lambda St): slope over intercept of p/(mu_f gamma V) in St, the median over the
/// solids fractions of a wet table with several Stokes numbers, at its first friction and share; 0 where it would not
/// be positive.
[[nodiscard]] double fitted_inertia(const fluid::SolidsTable& table, const std::vector<double>& pressure);

/// Where the pressure of a table does not rise with phi, on a grid ten times finer than its knots, from 0 to 0.02
/// below jamming: at fixed temperature (dry) or at fixed shear rate (wet). Empty if it rises everywhere.
[[nodiscard]] std::vector<std::string> falls_of(const fluid::SolidsTable& table);

/// Solids fractions up to which the pressure at fixed shear rate without drag falls in a dry table, as a dilute gas
/// does; 0 if it rises everywhere. Told, not refused.
[[nodiscard]] double falls_in_shear_up_to(const fluid::SolidsTable& table);

/// Throws core::NumericsError with what is wrong with a table: where its pressure falls, or its residual.
void require_usable(const fluid::SolidsTable& table);

/// a(phi) of chi_eff = chi_CS (1 + a S) from the pressure of a dry table; one per point.
[[nodiscard]] std::vector<double> structure_coefficients(const fluid::SolidsTable& table);

}  // namespace polybed::multiscale
