// What the particle model reads from a scene: its box, gravity, units of force, skin and speeds.
#pragma once

#include "core/scene.hpp"
#include "dem/box.hpp"
#include "dem/effects.hpp"
#include "dem/materials.hpp"

namespace polybed::dem {

/// The column as a box of particles. A 2-D column is periodic in its depth.
[[nodiscard]] Box box_of(const core::Scene& scene);

/// m/s2.
[[nodiscard]] Vector gravity_of(const core::Scene& scene);

/// m, how much nearer than contact two surfaces may be before the list of pairs must know them: as the case gives it,
/// or a tenth of the least diameter.
[[nodiscard]] double skin_of(const core::Scene& scene, const Materials& materials);

/// m/s, that particles are expected to reach: as the case gives it, or that of a fall through the box, of the particles
/// at the start and of the shear; of particles at rest that nothing moves, what dem.fixed_step is made for. Throws
/// core::CaseError if nothing tells it.
[[nodiscard]] double greatest_speed(const core::Scene& scene, const Box& box, const std::vector<Particle>& start);

/// Unit of forces: at the overlap allowed, on as many contacts as the largest particle has room for.
[[nodiscard]] FixedPoint force_unit(const core::Scene& scene, const Materials& materials, const PairLaws& laws);
[[nodiscard]] FixedPoint torque_unit(const FixedPoint& force, const Materials& materials);

/// Throws core::CaseError if a particle could touch another and its image: periodic directions need room for two of
/// the largest and twice the reach. T: so does the thesis, whose depth for system B is too small by a hair.
/// \param greatest_diameter  m  \param reach  of forces beyond contact, m
/// \param skin  of the list of neighbours, m: a sheared box needs room for it, too, as its list has but one image
void require_room_for_images(const Box& box, double greatest_diameter, double reach, double skin);

}  // namespace polybed::dem
