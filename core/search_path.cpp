#include "core/search_path.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace polybed::core {

std::string absolute_entries(std::string_view path) {
  std::string kept;
  while (!path.empty()) {
    const std::string_view entry = path.substr(0, path.find(':'));
    path.remove_prefix(std::min(entry.size() + 1, path.size()));
    if (!entry.starts_with('/')) continue;
    if (!kept.empty()) kept += ':';
    kept += entry;
  }
  return kept.empty() ? "/usr/bin:/bin" : kept;
}

void search_absolute_path() {
  const char* path = std::getenv("PATH");
  if (::setenv("PATH", absolute_entries(path == nullptr ? "" : path).c_str(), 1) != 0) throw std::bad_alloc();
}

}  // namespace polybed::core
