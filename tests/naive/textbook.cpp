// The textbook treatments of this program: linked in the place of the product's answer, which is none.
#include "multiscale/stability/textbook.hpp"

#include "naive/particles.hpp"
#include "naive/sound.hpp"
#include "naive/spheres.hpp"
#include "naive/treatments.hpp"

namespace polybed {

namespace {

class Treatments final : public stability::Textbook {
 public:
  [[nodiscard]] std::unique_ptr<stability::Run> run(const std::string& name, const core::Scene& scene,
                                                    core::Timers& timers,
                                                    const std::function<void(tfm::Model&)>& start) const override {
    return naive::make_run(name, scene, timers, start);
  }
  [[nodiscard]] std::unique_ptr<stability::TextbookSpheres> spheres(
      const std::string& name, const core::Scene& scene, const std::vector<verification::Bead>& beads) const override {
    return std::make_unique<naive::Spheres>(name, scene, beads);
  }
  [[nodiscard]] std::unique_ptr<stability::TextbookSuspension> suspension(
      const std::string& name, const core::Scene& scene, const std::vector<verification::Bead>& beads) const override {
    return std::make_unique<naive::ParticleRun>(name, scene, naive::particles_of(scene, beads),
                                                scene.dem.fixed_step.value());
  }
  [[nodiscard]] std::vector<double> sound(const std::string& name, const core::Scene& scene, double step,
                                          int steps) const override {
    return naive::bottom_pressures(name, scene, step, steps);
  }
};

}  // namespace

const stability::Textbook* stability::textbook() {
  static const Treatments treatments;
  return &treatments;
}

}  // namespace polybed
