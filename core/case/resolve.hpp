// What follows from the keys of a case.
#pragma once

#include <cstdint>
#include <string>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::core {

/// Of all species, m.
[[nodiscard]] double largest_diameter(const Scene& scene);

/// Of spheres of a species, m3.
[[nodiscard]] double volume_of(std::int64_t number, const Species& species);

/// Fills in what follows from sound keys: axes of the column, direction of gravity, materials of the species, shares
/// and height of particles that are counted or of layers, the place of a list, defaults of output, one time for each
/// event.
/// \param case_name  of the file beside which a list may lie
/// \param wrong      keys that nothing follows from; what cannot be filled in is added
void resolve(Scene& scene, const std::string& case_name, WrongKeys& wrong);

}  // namespace polybed::core
