// Where the particles are at the start.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Numbers of particles of each species: as the case gives them, or from the volumes of the bed.
[[nodiscard]] std::vector<std::int64_t> particle_numbers(const core::Scene& scene, const Materials& materials);

/// Why the particles of a start that is not a list have no room in the column; empty if they have.
[[nodiscard]] std::string no_room_for(const core::Scene& scene, const Materials& materials, const Box& box);

/// m, below which the particles of a start that is not a list are: of a bed that is placed at a solids fraction its
/// top, else that of the box.
[[nodiscard]] double start_height(const core::Scene& scene, const Materials& materials, const Box& box);

/// The scene's particles, all of them, in the order of their ids, without overlap beyond a thousandth of a radius;
/// reproducible from bed.seed. Throws core::CaseError for numbers that do not fit.
[[nodiscard]] std::vector<Particle> start_particles(const core::Scene& scene, const Materials& materials,
                                                    const Box& box);

}  // namespace polybed::dem
