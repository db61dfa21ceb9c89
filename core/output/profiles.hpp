// profiles.h5: lateral averages on the vertical axis, one row per output time.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/output/file.hpp"

namespace polybed::core {

/// Name of the dataset with the cross-section of each entry, m2, in a column whose diameter changes.
constexpr const char* area_of_slabs = "area";

class ProfileWriter {
 public:
  /// Starts profiles.h5 in an existing run directory, or continues it.
  /// \param height  y of each entry of a row, m
  /// \param names   of the datasets [time][y]: "phi_fine", "voidage", "u_fine", "p"
  /// \param resume_time  empty: a new file. Else s: removes later rows. Throws FileError, also if the file to continue
  /// has other heights or names.
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

/// The contents of profiles.h5.
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
