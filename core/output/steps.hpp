// Steps of a run on the disk: NAME.h5, NAME/000001.h5 and so on, and NAME.xdmf.
//
// The numbers of step 7 are in a file of their own, NAME/000007.h5, which is put in place complete and never changed
// again. NAME.h5 links to it, so that readers find step/000007 in NAME.h5. Both files and the XDMF are replaced by
// renaming, in this order. A run killed at any moment leaves all earlier steps readable, and a reader of an active run
// never meets a half-written file.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/output/file.hpp"

namespace polybed::core {

/// Name of a step's group and file, counted from 0: "000001" for the first.
[[nodiscard]] std::string step_name(std::size_t step);

/// The stored steps.
struct StepTimes {
  std::vector<double> time;   ///< s
  std::vector<double> count;  ///< the numbers in StepSeries::count_name; empty without one
};

/// The name of a series of steps, and its contents besides the steps.
struct StepSeries {
  std::string name;                             ///< "fields"
  FileKind kind;                                ///< of NAME.h5
  std::function<void(OutputFile&)> head;        ///< writes the part that NAME.h5 contains once: the grid
  std::function<bool(const OutputFile&)> fits;  ///< whether the head of a NAME.h5 is the same
  std::string head_name;                        ///< name of the head, for the message if not: "grid"
  std::string count_name;  ///< a dataset of one number per step in NAME.h5, "particles"; empty: none
  std::function<std::string(const StepTimes&)> xdmf;
};

class StepWriter {
 public:
  /// Starts the series in an existing run directory, or continues it.
  /// \param resume_time  empty: removes what an earlier run left. Else s: removes later steps. Throws FileError, also
  /// if the series to continue has another head.
  StepWriter(std::filesystem::path run_directory, StepSeries series, std::optional<double> resume_time);

  /// Stores a step, whose content is the group /step; complete on the disk when it returns.
  /// \param count  for this step, if the series counts something
  void add(const OutputFile& content, double time_s, std::size_t count = 0);
  /// Adds a step whose file, at step_path, is in place.
  void add_written(double time_s, std::size_t count = 0);

  [[nodiscard]] const std::vector<double>& times() const { return stored_.time; }

 private:
  void begin();
  void go_on(double resume_time);
  void write_description() const;
  [[nodiscard]] std::filesystem::path index_path() const;
  [[nodiscard]] std::filesystem::path path_of(std::size_t step) const;

  std::filesystem::path directory_;
  StepSeries series_;
  std::optional<OutputFile> index_;
  StepTimes stored_;
};

/// Path of a step's file.
[[nodiscard]] std::filesystem::path step_path(const std::filesystem::path& run_directory, const std::string& name,
                                              std::size_t step);

}  // namespace polybed::core
