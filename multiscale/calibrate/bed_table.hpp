// The table of fluidised boxes: p_bed(phi), measured twice.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fluid/solids_table.hpp"
#include "multiscale/calibrate/box_result.hpp"

namespace polybed::multiscale {

struct BedTable {
  std::vector<double> phi, velocity;           ///< of the bed, and the superficial velocity that held it there, m/s
  std::vector<double> pressure, error;         ///< by slabs, over |rho_p - rho_f| g D, and one standard error
  std::vector<double> balance, balance_error;  ///< the same by the balance of forces
  std::vector<double> temperature;             ///< theta/(|rho_p - rho_f| g D/rho_p)
  std::vector<double> seeds;

  /// by the balance over by slabs, less 1.
  [[nodiscard]] double difference(std::size_t n) const { return balance[n] / pressure[n] - 1; }
};

/// Means over the seeds of each point, in rising phi; an error is that of the boxes or of their scatter, whichever is
/// more. \param weight  |rho_p - rho_f| g D/rho_p, m2/s2
[[nodiscard]] BedTable bed_table(const Plan& plan, const std::vector<BoxResult>& boxes, double weight);

/// Throws core::NumericsError where the pressure does not rise, or where both measures differ by more than 5 % and
/// more than two standard errors.
void require_usable(const BedTable& table);

/// A file of regime "bed" for solids_stress = "table:FILE".
void write_bed_table(const std::filesystem::path& path, const BedTable& table, const std::string& created,
                     const std::string& case_hash);

/// Puts p_bed of such a file beside the stress of sheared boxes: the two-fluid model adds both.
void take_bed(fluid::SolidsTable& table, const std::filesystem::path& path);

/// One line per box, and one per row of the table, for people.
[[nodiscard]] std::string bed_lines(const std::vector<BoxResult>& boxes);
[[nodiscard]] std::string bed_rows(const BedTable& table);

}  // namespace polybed::multiscale
