// Limits on an explicit step: the time scales of the state, for comparison with the actual step.
#pragma once

#include <string>
#include <vector>

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// The shortest time scale of one process in this rank's block, s, and its place; infinite if the process is absent.
struct TimeScale {
  std::string process;
  double seconds;
  core::Index cell;
};

/// Convection (h/|U| of any phase), acoustics of the packed bed (h/c_s), its bulk viscosity (h2 rho_s/lambda), drag
/// (the fastest species, relaxing with the fluid that all of them drag along), viscosity (h2/nu), viscosity of the
/// solids (h2 phi rho_j/mu_s) and decay of the granular temperature, each if present, from fields of a finished
/// evaluation.
/// \param kinematic_viscosity  nu, m2/s, of the fluid's stress; 0: absent
/// \param split  the fast part of the drag is implicit: the drag's scale is for the rest
std::vector<TimeScale> time_scales(const Constants& constants, const Fields& fields, double kinematic_viscosity,
                                   bool split = false);

/// The longest step, s, for the pair of methods with implicit drag: the time in which a phase crosses a cell. In longer
/// steps fractions fall below 0 where a bubble opens (docs/record/cost.md); the error test covers the rest.
[[nodiscard]] double longest_split_step(const Constants& constants, const Fields& fields);

/// Share of its time scale above which a process, not the error test, is reported as the limit of explicit steps: third
/// order Runge-Kutta is stable up to 1.7 on the imaginary axis and 2.5 on the real one; steps settle below.
constexpr double limiting_share = 0.5;

/// The process with the shortest time scale; an infinite one without processes.
[[nodiscard]] TimeScale nearest_of(const std::vector<TimeScale>& scales);

/// One phrase for the step log: the process, and the cell of the column where it is shortest.
[[nodiscard]] std::string place_of(const TimeScale& scale, const core::Grid& grid);

}  // namespace polybed::tfm
