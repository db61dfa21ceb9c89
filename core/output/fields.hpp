// fields.h5 and fields.xdmf: the values of every cell at each output time. core/output/steps.hpp describes how the
// files stay complete.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/numerics/field.hpp"
#include "core/numerics/grid.hpp"
#include "core/output/file.hpp"
#include "core/output/steps.hpp"

namespace polybed::core {

/// A cell field to be stored.
struct FieldName {
  std::string name;     ///< "voidage", "phi_fine", "u_fluid"
  bool vector = false;  ///< one component per dimension of the grid
  bool sum = false;     ///< of other stored fields: only for ParaView, in single precision
};

/// The values of one field: a padded field per component, as core/numerics/grid.hpp lays it out.
using FieldValues = std::vector<std::span<const double>>;

/// Means of a face field over the two faces of each owned cell: a velocity at cell centres, padded, ghosts zero. At
/// joined sides the first face replaces the last one; a block's last face must have been fetched.
[[nodiscard]] FaceField cell_means(const Grid& grid, const FaceField& faces);

/// Collective if the grid is a block of a column: every rank has a writer, and each writes its block.
class FieldWriter {
 public:
  /// Starts fields.h5 in an existing run directory, or continues it.
  /// \param resume_time  empty: removes what an earlier run left. Else s: removes later steps. Throws FileError, also
  /// if the file to continue has another grid.
  FieldWriter(const std::filesystem::path& run_directory, const Grid& grid, std::vector<FieldName> names,
              std::optional<double> resume_time = std::nullopt);

  /// Stores all fields at a time, in the order of the names; complete on the disk when it returns. Throws NumericsError
  /// with field and cell, and writes nothing, if a value is not finite.
  void write_step(double time_s, std::span<const FieldValues> values);

  [[nodiscard]] const std::vector<double>& times() const { return times_; }

 private:
  void write_file(const std::filesystem::path& path, double time_s, std::span<const FieldValues> values) const;

  std::filesystem::path directory_;
  Grid grid_;
  std::vector<FieldName> names_;
  std::optional<StepWriter> steps_;  ///< on the first rank
  std::vector<double> times_;
};

}  // namespace polybed::core
