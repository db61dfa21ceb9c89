#include "core/case/rule.hpp"

#include "core/error.hpp"

namespace polybed::core {

std::string Rule::fault(const Scene& scene) const {
  const Broken words = broken(scene);
  if (!words) return "";
  std::string text = message;
  std::size_t from = 0;
  for (const std::string& word : *words) {
    const std::size_t gap = text.find("{}", from);
    if (gap == std::string::npos) break;
    text.replace(gap, 2, word);
    from = gap + word.size();
  }
  return text;
}

void refuse(std::span<const Rule> rules, const Scene& scene) {
  std::string text;
  for (const Rule& rule : rules)
    if (const std::string fault = rule.fault(scene); !fault.empty()) text += (text.empty() ? "" : "\n") + fault;
  if (!text.empty()) throw CaseError(text);
}

}  // namespace polybed::core
