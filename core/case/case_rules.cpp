#include "core/case/case_rules.hpp"

namespace polybed::core {

std::span<const Rule> case_rules() {
  static const std::vector<Rule> all = [] {
    std::vector<Rule> rules;
    for (const auto& part : {column_rules(), opening_rules(), bed_rules(), idle_rules()})
      rules.insert(rules.end(), part.begin(), part.end());
    return rules;
  }();
  return all;
}

}  // namespace polybed::core
