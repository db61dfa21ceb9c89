// The scene of a fluidised box: particles in a stream, periodic to the sides, that carries them.
#pragma once

#include "multiscale/calibrate/plan.hpp"

namespace polybed::multiscale {

/// A column of particles of one size whose superficial velocity expands it to a solids fraction by the scene's law of
/// drag: point.phi. Spheres of the bed's mean size, as many as calibrate.particles.
[[nodiscard]] core::Scene scene_of_bed(const core::Scene& scene, const BoxPoint& point);

}  // namespace polybed::multiscale
