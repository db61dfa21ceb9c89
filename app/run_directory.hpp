// The run directory as the commands that run a case treat it, whatever the model: which it is, whether it may be
// written, and which checkpoint in it a run goes on from.
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

/// The case of the command line, with --set and --until taken into it, for models that are to run it.
[[nodiscard]] core::Scene read_scene(const RunOptions& options, const Models& models);

/// runs/<case name>-<model>, where a case.toml is called by its folder.
[[nodiscard]] std::filesystem::path default_run_directory(const std::filesystem::path& case_path,
                                                          const std::string& model);

/// Where a run of this model writes: -o DIR, or else the default.
[[nodiscard]] std::filesystem::path run_directory(const RunOptions& options, const std::string& model);

/// Makes and takes the directory of a run for as long as what is returned lives. Throws as core::OutputDirectory does,
/// and CaseError if there is a run that is neither resumed nor replaced, FileError if there is nothing to resume from.
[[nodiscard]] std::unique_ptr<const core::OutputDirectory> take_directory(const std::filesystem::path& directory,
                                                                          const RunOptions& options);

/// Whether a run can go on from what is there.
[[nodiscard]] bool has_checkpoint(const std::filesystem::path& directory);

[[nodiscard]] std::filesystem::path checkpoint_path(const std::filesystem::path& directory);

/// The checkpoint to go on from. One that is damaged gives way to the one before it, under its name, so that
/// the next one written does not push that out. Throws if it is of another case; forces on particles may be added.
/// \param model  "tfm" or "dem"
[[nodiscard]] core::Checkpoint read_checkpoint_of(const std::filesystem::path& directory, const core::Scene& scene,
                                                  const std::string& model);

/// Says in a checkpoint of which case it is.
void add_case(core::Checkpoint& checkpoint, const core::Scene& scene);

}  // namespace polybed::app
