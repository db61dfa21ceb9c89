// Plan of a calibration: the axes of its table and the scene of each box. The Python package chooses points and seeds.
#pragma once

#include <string>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"
#include "tfm/shear_regime.hpp"

namespace polybed::multiscale {

/// One box: its point in the table, and its random seed.
struct BoxPoint {
  core::BoxRegime regime = core::BoxRegime::dry;  ///< dry | wet | bed
  double phi = 0, stokes = 0, restitution = 0, friction = 0, share = 0;
  bool binary = false;  ///< two species, `share` the volume of the second; else one with the bed's mean size
  bool pushed = false;  ///< both species also pushed apart, to measure their exchange; its stress is not used
  int seed = 1;
};

/// Values of the axes, each increasing; stokes is only 0 for dry boxes, share only 0 for spheres of one size.
struct TableAxes {
  std::vector<double> phi, stokes, restitution, friction, share;
};

struct Plan {
  tfm::Regime regime;  ///< dry | wet | bed
  TableAxes axes;
  bool binary = false;  ///< boxes of two species
};

/// Requirements of the keys in [calibrate], whatever boxes follow from them.
[[nodiscard]] std::vector<core::Rule> calibrate_rules();

/// Throws core::CaseError for a scene that breaks these rules, and for boxes that cannot be run.
[[nodiscard]] Plan plan_of(const core::Scene& scene);

/// The scene of a box: a cube for `dry` and `wet`, a column for `bed`.
[[nodiscard]] core::Scene scene_of_box(const core::Scene& scene, const BoxPoint& point);

/// A column of particles of one size whose superficial velocity expands it to a solids fraction by the scene's drag
/// law: point.phi. It contains calibrate.particles spheres of the bed's mean size.
[[nodiscard]] core::Scene scene_of_bed(const core::Scene& scene, const BoxPoint& point);

/// Steps of a box times its particles, without the doublings.
[[nodiscard]] double particle_steps_of(const core::Scene& scene, const BoxPoint& point);

/// A name that changes with every input of the box's result.
[[nodiscard]] std::string box_hash(const core::Scene& scene, const BoxPoint& point);

/// Sauter diameter, m, and mean density by volume, kg/m3, of the solids of a scene.
struct MeanSphere {
  double diameter, density;
};
[[nodiscard]] MeanSphere mean_sphere(const std::vector<core::Species>& species, const std::vector<double>& share);

}  // namespace polybed::multiscale
