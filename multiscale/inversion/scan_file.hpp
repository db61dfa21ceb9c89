// inversion.json as a comparison of both models takes it up.
#pragma once

#include <filesystem>
#include <optional>

#include "core/case/scene.hpp"
#include "multiscale/inversion/scan_report.hpp"

namespace polybed::multiscale {

/// Hash of a case without what the runs of a scan differ in: velocity, start, end and output.
[[nodiscard]] std::string hash_of_scanned(core::Scene scene);

/// What a scan by both models has found.
struct FoundInversion {
  std::filesystem::path file;
  ScanAgreement agreement;
  double tfm = 0, dem = 0;  ///< inversion velocities, m/s

  /// Whether a velocity is within 5 % of that of either model, where a smaller difference of the layers decides.
  [[nodiscard]] bool near(double velocity) const;
};

/// Reads a folder's inversion.json; empty if there is none there, or if it is not of both models or has not found both.
/// Throws core::FileError if the file is no such one, core::CaseError if it is of another case.
[[nodiscard]] std::optional<FoundInversion> read_inversion(const std::filesystem::path& directory,
                                                           const core::Scene& scene);

}  // namespace polybed::multiscale
