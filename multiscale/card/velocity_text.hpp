// Velocities, heights and masses of a bed in words, for the lines of a card.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "multiscale/card/bed_of_case.hpp"

namespace polybed::multiscale {

/// A range, with the prefix for the greater value; one value if both read the same.
[[nodiscard]] std::string range_text(double low, double high, const char* unit);

/// So many digits, or all before the point: without a power of ten unless a number is tiny.
[[nodiscard]] std::string plain(double value, int digits);
/// A quantity with the prefix that gives it one to three digits before the point.
[[nodiscard]] std::string with_prefix(double value, const char* unit);

/// "40 mm/s", or for a case with inlet.flow_rate "40 mm/s (407 l/h)": the flow through its inlet. Likewise a range.
/// \param area  of the inlet, m2; 0: the case gives a velocity
[[nodiscard]] std::string velocity_text(double velocity, double area);
[[nodiscard]] std::string velocities_text(double low, double high, double area);

/// " (407 l/h)", empty for an area of 0.
[[nodiscard]] std::string flow_text(double velocity, double area);

/// kg or less.
[[nodiscard]] std::string mass_text(double mass);
[[nodiscard]] std::string masses_text(const std::vector<std::pair<std::string, double>>& masses);

/// "a, b"
[[nodiscard]] std::string each(const std::vector<std::string>& parts);

/// The range of the laws derived from such beds, with their names; empty without any.
/// \param most  for heights the column's, above which a law gives none; empty for velocities
[[nodiscard]] std::string by_others(const BedOfCase& bed, std::optional<double> ByLaw::*number,
                                    std::optional<double> most);

/// Minimum fluidisation, terminal velocities and, in a gas, Geldart's classes. \param in_full  also by other laws, at
/// other packings and by the other formulas of the shape
void add_velocities(const BedOfCase& bed, bool in_full, std::vector<std::string>& lines);

}  // namespace polybed::multiscale
