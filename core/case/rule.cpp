#include "core/case/rule.hpp"

#include "core/error.hpp"

namespace polybed::core {

void refuse(const std::vector<SceneFault>& faults) {
  std::string text;
  for (const SceneFault& fault : faults) text += (text.empty() ? "" : "\n") + fault.message;
  if (!text.empty()) throw CaseError(text);
}

}  // namespace polybed::core
