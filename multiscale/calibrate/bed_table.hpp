// The table of fluidised boxes: p_bed(phi), measured twice.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "multiscale/calibrate/box_result.hpp"

namespace polybed::multiscale {

struct BedTable {
  std::vector<double> phi, pressure, error;  ///< of the bed; over |rho_p - rho_f| g D, by slabs
  std::vector<double> balance;               ///< the same by the balance of forces
};

/// Means over the seeds of each point, in rising phi.
[[nodiscard]] BedTable bed_table(const Plan& plan, const std::vector<BoxResult>& boxes);

/// Throws core::NumericsError where the pressure does not rise, or where both measures differ by more than 5 % and
/// more than two standard errors.
void require_usable(const BedTable& table);

/// A file of regime "bed" for solids_stress = "table:FILE".
void write_bed_table(const std::filesystem::path& path, const BedTable& table, const std::string& created,
                     const std::string& case_hash);

/// One line per box for people.
[[nodiscard]] std::string bed_lines(const std::vector<BoxResult>& boxes);

}  // namespace polybed::multiscale
