// What the particle model asks of a scene.
#pragma once

#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::dem {

/// What the keys of [dem] require, of the effects that read them and whatever effects there are.
[[nodiscard]] std::vector<core::Rule> key_rules();

/// What particles that are fed require.
[[nodiscard]] std::vector<core::Rule> feed_rules();

/// What the particles at their start require; dem::Model refuses a scene that breaks one of these.
[[nodiscard]] std::vector<core::Rule> start_rules();

/// That there is a law of contact.
[[nodiscard]] core::Rule contact_rule();

/// What this model alone asks of a scene.
[[nodiscard]] const std::vector<core::Rule>& model_rules();

}  // namespace polybed::dem
