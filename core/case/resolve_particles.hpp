// What the keys that the particle model reads say of each other.
#pragma once

#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::core {

/// Direction of gravity, ends of the column, a scene without a fluid, shear, the place of a list of particles. Fills in
/// Column::down and the path of the list. Returns what is wrong; column.size must have been read into the scene.
/// \param wrong  keys with problems of their own: what rests on them is not checked
[[nodiscard]] std::vector<std::string> resolve_particles(Scene& scene, const std::string& case_name,
                                                         const WrongKeys& wrong);

}  // namespace polybed::core
