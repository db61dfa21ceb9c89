// Fluidised boxes.
#include "core/error.hpp"
#include "multiscale/calibrate/bed_scene.hpp"
#include "multiscale/calibrate/box_result.hpp"

namespace polybed::multiscale {

core::Scene scene_of_bed(const core::Scene&, const BoxPoint&) {
  throw core::CaseError("calibrate.regime = \"bed\": not in this version");
}

BoxResult run_bed_box(const core::Scene&, const BoxPoint&) {
  throw core::CaseError("calibrate.regime = \"bed\": not in this version");
}

}  // namespace polybed::multiscale
