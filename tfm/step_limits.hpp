// What limits an explicit step: the time scales of the state, to be held against the step that was taken.
#pragma once

#include <string>
#include <vector>

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// The shortest time scale of one process in this rank's block, s, and where it is; infinite where the process is
/// absent.
struct TimeScale {
  std::string process;
  double seconds;
  core::Index cell;
};

/// Convection (h/|U| of any phase), acoustics of the packed bed (h/c_s), its bulk viscosity (h2 rho_s/lambda), drag
/// (the fastest of the species, relaxing with the fluid that all of them drag along), viscosity (h2/nu), that of the
/// solids (h2 phi rho_j/mu_s) and decay of the granular temperature, each where it is present, from fields of a
/// finished evaluation.
/// \param kinematic_viscosity  nu, m2/s, of the fluid's stress; 0: absent
/// \param split  the fast part of the drag is taken implicitly: the drag's scale is that of the rest
std::vector<TimeScale> time_scales(const Constants& constants, const Fields& fields, double kinematic_viscosity,
                                   bool split = false);

/// The longest step, s, of the pair of methods that takes the drag implicitly: the time in which a phase crosses
/// a cell, beyond which fractions fall below 0 where a bubble opens (docs/record/cost.md); the error test sees the
/// rest.
[[nodiscard]] double longest_split_step(const Constants& constants, const Fields& fields);

/// Share of its time scale beyond which a process, not the error test, is taken to limit an explicit step:
/// third order Runge-Kutta is stable up to 1.7 on the imaginary axis and 2.5 on the real one, and steps settle below.
constexpr double limiting_share = 0.5;

/// The process with the shortest time scale; one that takes for ever for none.
[[nodiscard]] TimeScale nearest_of(const std::vector<TimeScale>& scales);

/// One phrase for the step log: the process, and the cell of the column where it is shortest.
[[nodiscard]] std::string place_of(const TimeScale& scale, const core::Grid& grid);

}  // namespace polybed::tfm
