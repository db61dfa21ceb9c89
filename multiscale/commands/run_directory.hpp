// What a run of either model does with its case and its directory.
#pragma once

#include <filesystem>
#include <string>

#include "core/checkpoint.hpp"
#include "core/scene.hpp"
#include "multiscale/commands/options.hpp"

namespace polybed::multiscale {

/// The case of a run, with what its command line overrides.
[[nodiscard]] core::Scene read_scene(const RunOptions& options);

/// Makes the run directory; throws core::CaseError if it holds a run that is neither to be resumed nor replaced,
/// core::FileError if there is nothing to resume from.
void check_directory(const std::filesystem::path& directory, const RunOptions& options);

/// The checkpoint to go on from. One that is damaged gives way to the one before it, under its name, so that the next
/// one written does not push that out.
[[nodiscard]] core::Checkpoint read_newest_checkpoint(const std::filesystem::path& directory);

/// A run that begins anew and is killed at once must not be resumed from the run it replaces.
void remove_checkpoints(const std::filesystem::path& directory);

/// What must be the same for a checkpoint to fit: the case without its end and its output times.
[[nodiscard]] std::string physics_hash(core::Scene scene);

/// Throws core::CaseError if a checkpoint is of another case.
void require_same_case(const core::Checkpoint& checkpoint, const core::Scene& scene,
                       const std::filesystem::path& directory);

}  // namespace polybed::multiscale
