// Values that follow from the keys of a case.
#pragma once

#include <cstdint>
#include <string>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::core {

/// Largest diameter of all species, m.
[[nodiscard]] double largest_diameter(const Scene& scene);

/// Total volume of the spheres of a species, m3.
[[nodiscard]] double volume_of(std::int64_t number, const Species& species);

/// Fills in the values that follow from sound keys: axes of the column, direction of gravity, materials of the species,
/// shares and height from numbers of particles or from layers, the paths of a list and of laws, defaults of output, one
/// time for each event.
/// \param case_name  name of the case file; a list or a law can lie in the same folder
/// \param wrong      keys with errors, which are not used; keys that cannot be filled in are added
void resolve(Scene& scene, const std::string& case_name, WrongKeys& wrong);

}  // namespace polybed::core
