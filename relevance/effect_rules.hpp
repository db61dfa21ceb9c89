// Rules as effects state them. In a message the first {} is the law that the scene gives the role.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "core/case/rule.hpp"

namespace polybed::relevance {

/// Broken where the scene names a law of a role, other than "auto", and `wrong` holds.
/// \param rests_on  keys beside that of the role
[[nodiscard]] core::Rule rule_of(const std::string& role, const std::vector<std::string>& rests_on,
                                 const std::string& message, std::function<bool(const core::Scene&)> wrong);

/// The same of one law; the message has no gaps.
[[nodiscard]] core::Rule rule_of_law(const std::string& role, const std::string& law,
                                     const std::vector<std::string>& rests_on, const std::string& message,
                                     std::function<bool(const core::Scene&)> wrong);

/// Of what a fluid does.
[[nodiscard]] core::Rule needs_a_fluid(const std::string& role);

/// Of what the fluid of a sheared box, which moves with its flow, cannot do.
[[nodiscard]] core::Rule idle_in_a_sheared_box(const std::string& role);

/// In place of a law: any that the scene names.
inline constexpr std::nullopt_t any_law = std::nullopt;

/// Two rules, one at each role: a law of one cannot be with a law of another.
[[nodiscard]] std::vector<core::Rule> excludes(const std::string& role, const std::optional<std::string>& law,
                                               const std::string& other, const std::string& other_law,
                                               const std::string& why);

/// Lists as one.
[[nodiscard]] std::vector<core::Rule> joined(std::initializer_list<std::vector<core::Rule>> lists);

}  // namespace polybed::relevance
