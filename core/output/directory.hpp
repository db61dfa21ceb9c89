// The output directories of the program: marked as its own, locked while a process writes. Defines the files that it
// can remove there.
//
// The mark, a file called .polybed, is also the lock: the kernel releases it with the process, however that ends. A
// directory without the mark belongs to the user, and nothing in it is ever replaced or removed.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/output/descriptor.hpp"

namespace polybed::core {

class OutputDirectory {
 public:
  /// Creates the directory if needed, marks it, and locks out other processes while this object exists. Throws
  /// CaseError if the directory contains files and has no mark; FileError if it cannot be written or another process
  /// writes it.
  explicit OutputDirectory(const std::filesystem::path& path);
  /// Removes the directories that it has created if nothing was written there: a rejected case leaves none.
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< the deepest first
  Descriptor mark_;
};

/// Creates and marks a directory as OutputDirectory does, without the lock: for files written next to an active run.
void mark_directory(const std::filesystem::path& path);

/// Removes the results of an earlier run from a directory of the program: files and steps by the list of their names,
/// and folders of steps that are then empty. run.json stays, as the next run replaces it. Throws FileError.
/// \param kept  names in the list that stay
void remove_results(const std::filesystem::path& directory, std::span<const std::string_view> kept = {});

}  // namespace polybed::core
