// Options that take several words.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "app/studies.hpp"

namespace polybed::app {

/// The words of "a,b,c"; empty ones are left out.
[[nodiscard]] inline std::vector<std::string> comma_list(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

}  // namespace polybed::app
