// Points that a table was not fitted to, run and held against it.
#pragma once

#include <string>
#include <vector>

#include "fluid/solids_table.hpp"
#include "multiscale/calibrate/box_result.hpp"

namespace polybed::multiscale {

/// Three points between the knots of a table: the middle of its first, middle and last distance in phi; of a wet table
/// between two Stokes numbers, in the logarithm. One seed that the plan has not.
[[nodiscard]] std::vector<BoxPoint> points_between(const fluid::SolidsTable& table, const Plan& plan);

/// What a table says of a box against what the box says.
struct Deviation {
  BoxPoint point;
  double pressure = 0, viscosity = 0;              ///< box over table, less 1
  double pressure_error = 0, viscosity_error = 0;  ///< standard errors of box and table together, relative
};
[[nodiscard]] Deviation deviation(const fluid::SolidsTable& table, const BoxResult& box);

/// For people, with how many standard errors each is.
[[nodiscard]] std::string deviation_lines(const std::vector<Deviation>& deviations);

}  // namespace polybed::multiscale
