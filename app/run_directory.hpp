// The run directory for commands that run a case, with any model: its path, whether it can be written, and the
// checkpoint to resume from.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/options.hpp"
#include "app/studies.hpp"
#include "core/case/scene.hpp"
#include "core/output/checkpoint.hpp"
#include "core/output/directory.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::app {

/// The case on the command line, with --set and --until applied, for models that are to run it.
[[nodiscard]] core::Scene read_scene(const RunOptions& options, const Models& models);

/// runs/<case name>-<model>; a case.toml is named by its folder.
[[nodiscard]] std::filesystem::path default_run_directory(const std::filesystem::path& case_path,
                                                          const std::string& model);

/// Output directory of this model's run: -o DIR, or else the default.
[[nodiscard]] std::filesystem::path run_directory(const RunOptions& options, const std::string& model);

/// Creates and locks a run's directory for the lifetime of the result. Throws as core::OutputDirectory does, CaseError
/// if it contains a run that is neither resumed nor replaced, FileError if there is nothing to resume from.
[[nodiscard]] std::unique_ptr<const core::OutputDirectory> take_directory(const std::filesystem::path& directory,
                                                                          const RunOptions& options);

/// Whether a run can continue from the directory.
[[nodiscard]] bool has_checkpoint(const std::filesystem::path& directory);

[[nodiscard]] std::filesystem::path checkpoint_path(const std::filesystem::path& directory);

/// The checkpoint to resume from. If it is corrupt, returns the previous one and renames it, so that the next
/// checkpoint does not replace it. Throws if it is for another case; forces on particles can be added.
/// \param model  "tfm" or "dem"
[[nodiscard]] core::Checkpoint read_checkpoint_of(const std::filesystem::path& directory, const core::Scene& scene,
                                                  const std::string& model);

/// Adds the identity of the case to a checkpoint.
void add_case(core::Checkpoint& checkpoint, const core::Scene& scene);

}  // namespace polybed::app
