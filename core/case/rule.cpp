#include "core/case/rule.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace polybed::core {

std::vector<std::string> Rule::faults(const Scene& scene) const {
  std::vector<std::string> texts;
  const Broken found = broken(scene);
  for (const Broken::Words& words : found.faults()) {
    std::string text = message;
    std::size_t from = 0;
    for (const std::string& word : words) {
      const std::size_t gap = text.find("{}", from);
      if (gap == std::string::npos) break;
      text.replace(gap, 2, word);
      from = gap + word.size();
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

std::vector<std::string> faults_of(std::span<const Rule> rules, const Scene& scene) {
  std::vector<std::string> all;
  for (const Rule& rule : rules)
    for (std::string& fault : rule.faults(scene)) all.push_back(std::move(fault));
  return all;
}

void refuse(std::span<const Rule> rules, const Scene& scene) {
  if (const std::vector<std::string> faults = faults_of(rules, scene); !faults.empty())
    throw CaseError(fmt::format("{}", fmt::join(faults, "\n")));
}

}  // namespace polybed::core
