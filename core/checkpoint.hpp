// The whole state of a run, to the bit, in one file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace polybed::core {

struct Checkpoint {
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, double> numbers;
  std::map<std::string, std::int64_t> integers;
  std::map<std::string, std::string> texts;
};

}  // namespace polybed::core
