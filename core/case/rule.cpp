#include "core/case/rule.hpp"

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

void refuse(std::span<const Rule> rules, const Scene& scene) {
  std::string text;
  for (const Rule& rule : rules)
    for (const std::string& fault : rule.faults(scene)) text += (text.empty() ? "" : "\n") + fault;
  if (!text.empty()) throw CaseError(text);
}

}  // namespace polybed::core
