// The textbook treatments by the names under which the hard cases ask for them.
#include "hard/textbook.hpp"

#include "hard/naive/particles.hpp"
#include "hard/naive/sound.hpp"
#include "hard/naive/spheres.hpp"
#include "hard/naive/treatments.hpp"

namespace polybed::hard::textbook {

std::unique_ptr<Run> run(const std::string& name, const core::Scene& scene, core::Timers& timers,
                         const std::function<void(tfm::Model&)>& start) {
  return naive::make_run(name, scene, timers, start);
}

std::unique_ptr<TextbookSpheres> spheres(const std::string& name, const core::Scene& scene,
                                         const std::vector<scenes::Bead>& beads) {
  return std::make_unique<naive::Spheres>(name, scene, beads);
}

std::unique_ptr<TextbookSuspension> suspension(const std::string& name, const core::Scene& scene,
                                               const std::vector<scenes::Bead>& beads) {
  return std::make_unique<naive::ParticleRun>(name, scene, naive::particles_of(scene, beads),
                                              scene.dem.fixed_step.value());
}

std::vector<double> sound(const std::string& name, const core::Scene& scene, double step, int steps) {
  return naive::bottom_pressures(name, scene, step, steps);
}

}  // namespace polybed::hard::textbook
