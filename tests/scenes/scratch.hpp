// A directory that lives as long as its object.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace polybed::scenes {

class Scratch {
 public:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / ("polybed-" + std::string(6, 'X'))).string();
    if (mkdtemp(pattern.data()) == nullptr) throw core::FileError("no scratch directory: " + pattern);
    path_ = pattern;
  }
  ~Scratch() {
    std::error_code ignored;  // what is left of it is in the way of nobody
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace polybed::scenes
