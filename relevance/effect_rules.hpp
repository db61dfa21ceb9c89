// Rules of effects. In a message the first {} is the law that the scene gives the role.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "core/case/rule.hpp"

namespace polybed::relevance {

/// Broken if the scene names a law for a role, other than "auto", and `wrong` is true.
/// \param rests_on  keys besides the role's
[[nodiscard]] core::Rule rule_of(const std::string& role, const std::vector<std::string>& rests_on,
                                 const std::string& message, std::function<bool(const core::Scene&)> wrong);

/// The same for one law; the message has no gaps.
[[nodiscard]] core::Rule rule_of_law(const std::string& role, const std::string& law,
                                     const std::vector<std::string>& rests_on, const std::string& message,
                                     std::function<bool(const core::Scene&)> wrong);

/// For effects of a fluid.
[[nodiscard]] core::Rule needs_a_fluid(const std::string& role);

/// For effects in a gas. A fluid without known properties is covered by another rule. \param why  no liquid has it
[[nodiscard]] core::Rule refuses_a_liquid(const std::string& role, const std::string& why);

/// For effects excluded by a sheared box, whose fluid moves with its flow.
[[nodiscard]] core::Rule idle_in_a_sheared_box(const std::string& role);

/// Stands for any law that the scene names.
inline constexpr std::nullopt_t any_law = std::nullopt;

/// Two rules, one at each role: a law of one cannot be used with a law of another.
[[nodiscard]] std::vector<core::Rule> excludes(const std::string& role, const std::optional<std::string>& law,
                                               const std::string& other, const std::string& other_law,
                                               const std::string& why);

/// Joins lists into one.
[[nodiscard]] std::vector<core::Rule> joined(std::initializer_list<std::vector<core::Rule>> lists);

}  // namespace polybed::relevance
