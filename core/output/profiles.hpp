// profiles.h5: lateral averages on the vertical axis, one row per output time.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/output/file.hpp"

namespace polybed::core {

/// Of a column whose diameter changes, the cross-section of each entry, m2.
constexpr const char* area_of_slabs = "area";

class ProfileWriter {
 public:
  /// Starts profiles.h5 in a run directory that exists, or goes on with it.
  /// \param height  y of each entry of a row, m
  /// \param names   of the datasets [time][y]: "phi_fine", "voidage", "u_fine", "p"
  /// \param resume_time  empty: a new file. Else s: rows later than that are removed.
  /// Throws FileError, also if the file that it goes on with has other heights or names.
  ProfileWriter(const std::filesystem::path& run_directory, std::vector<double> height, std::vector<std::string> names,
                std::optional<double> resume_time = std::nullopt);

  /// Adds a row to each dataset, in the order of the names; complete on the disk when it returns.
  /// Throws NumericsError, and writes nothing, if a value is not finite.
  void write_row(double time_s, std::span<const std::vector<double>> rows);

 private:
  void begin();
  void go_on(double resume_time);

  std::filesystem::path path_;
  std::vector<double> height_;
  std::vector<std::string> names_;
  std::optional<OutputFile> file_;
};

/// All of profiles.h5.
struct Profiles {
  std::vector<double> time;    ///< s
  std::vector<double> height;  ///< m
  std::vector<std::string> names;
  std::vector<DataSet> values;  ///< [time][y], in the order of the names

  /// A profile by name; throws FileError if there is none.
  [[nodiscard]] const DataSet& of(const std::string& name) const;
};

[[nodiscard]] Profiles read_profiles(const std::filesystem::path& run_directory);

}  // namespace polybed::core
