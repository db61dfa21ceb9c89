// Requirements of the particle model on a scene.
#pragma once

#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::dem {

/// Requirements of the keys in [dem], from the effects that read them and in general.
[[nodiscard]] std::vector<core::Rule> key_rules();

/// Requirements of fed particles.
[[nodiscard]] std::vector<core::Rule> feed_rules();

/// Requirements of the initial particles; dem::Model rejects a scene that breaks one of these.
[[nodiscard]] std::vector<core::Rule> start_rules();

/// Requires a law of contact.
[[nodiscard]] core::Rule contact_rule();

/// Requirements of this model alone on a scene.
[[nodiscard]] const std::vector<core::Rule>& model_rules();

}  // namespace polybed::dem
