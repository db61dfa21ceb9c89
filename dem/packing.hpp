// Positions of the particles at the start.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Numbers of particles of each species: from the case, or from the volumes of the bed.
[[nodiscard]] std::vector<std::int64_t> particle_numbers(const core::Scene& scene, const Materials& materials);

/// Why the particles of a start other than a list do not fit in the column; empty if they do.
[[nodiscard]] std::string no_room_for(const core::Scene& scene, const Materials& materials, const Box& box);

/// Height, m, above all particles of a start other than a list: the top of a bed that is placed at a solids fraction,
/// else the box's.
[[nodiscard]] double start_height(const core::Scene& scene, const Materials& materials, const Box& box);

/// All particles of the scene, in the order of their ids, without overlap beyond a thousandth of a radius; reproducible
/// from bed.seed. Throws core::CaseError for numbers that do not fit.
[[nodiscard]] std::vector<Particle> start_particles(const core::Scene& scene, const Materials& materials,
                                                    const Box& box);

}  // namespace polybed::dem
