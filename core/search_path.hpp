// Search path of other programs: never the working directory, which can contain a stranger's files.
#pragma once

#include <string>
#include <string_view>

namespace polybed::core {

/// A search path without its relative and empty entries, which refer to the working directory. Never empty, since an
/// empty path does too: Debian's default, "/usr/bin:/bin", if nothing is left.
[[nodiscard]] std::string absolute_entries(std::string_view path);

/// Replaces this process's PATH by its absolute entries, for every program that it and its libraries start. Call it
/// before there are threads. Throws std::bad_alloc.
void search_absolute_path();

}  // namespace polybed::core
