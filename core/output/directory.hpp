// The directories that the program writes: marked as its own, locked while a process writes, and what may be removed
// there.
//
// The mark, a file called .polybed, is the lock too: the kernel releases it with the process that has it, however that
// ends. A directory without the mark belongs to the user, and nothing in it is ever replaced or removed.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/output/descriptor.hpp"

namespace polybed::core {

class OutputDirectory {
 public:
  /// Makes the directory if there is none, marks it, and keeps other processes from it while this object lives. Throws
  /// CaseError if it contains files and has no mark; FileError if it cannot be written, or if another process writes
  /// it.
  explicit OutputDirectory(const std::filesystem::path& path);
  /// Removes the directories that it has made if nothing was written there: a case that is refused leaves none.
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< the deepest first
  Descriptor mark_;
};

/// Makes and marks a directory as OutputDirectory does, without the lock: for what is written beside a run that goes
/// on.
void mark_directory(const std::filesystem::path& path);

/// Removes what an earlier run has left in a directory of the program: files and steps by the one list of their names,
/// and folders of steps that are empty then. run.json stays, as the next run replaces it. Throws FileError.
/// \param kept  names of the list that stay
void remove_results(const std::filesystem::path& directory, std::span<const std::string_view> kept = {});

}  // namespace polybed::core
