// From boxes to a table: means over seeds, their errors, and whether the table may be used.
#pragma once

#include <string>
#include <vector>

#include "fluid/solids_table.hpp"
#include "multiscale/calibrate/box_result.hpp"

namespace polybed::multiscale {

/// Greatest residual of a fit that may be used, and greatest standard error of its points.
inline constexpr double greatest_residual = 0.05;
/// Solids fractions from which on one can be left out and read from the others.
inline constexpr std::size_t least_to_leave_one_out = 4;

/// The table of sheared boxes in the order of a plan. Its curves pass through the means of the seeds, so that they are
/// tested where a solids fraction is left out of them. left_out: greatest |curve/point - 1| of p and mu there;
/// residual: the same less two standard errors of both together; 0 where there are too few.
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

/// Standard error over value of p or mu at every point, whichever is more.
[[nodiscard]] std::vector<double> relative_errors(const fluid::SolidsTable& table);

[[nodiscard]] double greatest_error(const fluid::SolidsTable& table);

/// Seeds from which on a plan wants its points known: points that scatter get more of them, so many at most.
inline constexpr int seeds_of_a_trusted_table = int(seeds_that_tell), most_seeds = 10;

/// Of a plan of seeds_of_a_trusted_table or more: a seed more at every point whose standard error is above
/// greatest_residual and that has fewer than most_seeds. Returns whether there is such a point.
[[nodiscard]] bool add_seeds(Plan& plan, const fluid::SolidsTable& table);

/// Throws core::NumericsError with what is wrong with a table: where its pressure falls, its residual, or, with several
/// seeds, a point whose standard error is above greatest_residual.
void require_usable(const fluid::SolidsTable& table);

/// a(phi) of chi_eff = chi_CS (1 + a S) from the pressure of a dry table; one per point.
[[nodiscard]] std::vector<double> structure_coefficients(const fluid::SolidsTable& table);

}  // namespace polybed::multiscale
