// The shipped cases as texts: what changed ones are made of.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace polybed::core {

struct ShippedCase {
  std::string path, text;
};

/// Of a folder of cases, in the order of their names: each role, each way to give a bed and each kind of boundary
/// stands in one of them.
inline std::vector<ShippedCase> shipped_cases(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::filesystem::exists(entry.path() / "case.toml")) paths.insert(entry.path() / "case.toml");
  std::vector<ShippedCase> result;
  for (const std::filesystem::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    result.push_back({path.string(), {std::istreambuf_iterator<char>(file), {}}});
  }
  return result;
}

}  // namespace polybed::core
