// What a scene says of a role of [effects], in place of comparing words.
#pragma once

#include <string>

#include "core/case/scene.hpp"

namespace polybed::core {

/// Of a word that [effects] may give a role: that it takes the role out.
[[nodiscard]] bool is_off(const std::string& law);
/// That it names a law: neither takes the role out nor leaves it to the chooser.
[[nodiscard]] bool is_law(const std::string& law);

/// Whether a scene gives a role a law, or leaves it to the chooser.
[[nodiscard]] inline bool acts(const Scene& scene, const std::string& role) { return !is_off(law_of(scene, role)); }
/// Whether it names the law itself.
[[nodiscard]] inline bool names_law(const Scene& scene, const std::string& role) { return is_law(law_of(scene, role)); }

}  // namespace polybed::core
