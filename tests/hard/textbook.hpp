// What textbooks do in place of the product's treatments.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/particles.hpp"
#include "fluid/flow.hpp"
#include "hard/hard_case.hpp"
#include "scenes/beads.hpp"

namespace polybed::hard {

/// Dry spheres as a textbook moves them; asked like scenes::Beads.
class TextbookSpheres {
 public:
  virtual ~TextbookSpheres() = default;
  virtual void steps(std::int64_t number) = 0;
  [[nodiscard]] virtual const dem::Place& place(std::int64_t id) const = 0;
  [[nodiscard]] virtual const dem::Motion& motion(std::int64_t id) const = 0;
  [[nodiscard]] virtual dem::Vector force(std::int64_t id) const = 0;
};

/// Spheres in a fluid as a textbook couples them; they do not touch.
class TextbookSuspension {
 public:
  virtual ~TextbookSuspension() = default;
  /// One of the fluid, those of the particles before it included.
  virtual void step() = 0;
  [[nodiscard]] virtual const dem::Particles& particles() const = 0;
  [[nodiscard]] virtual const core::Field& voidage() const = 0;
  [[nodiscard]] virtual const fluid::Flow& flow() const = 0;
};

/// Textbook treatments by name; unknown names throw std::invalid_argument.
namespace textbook {

/// A run of a continuum scene; null where the case itself is treated; `start` as in Trial::begin.
[[nodiscard]] std::unique_ptr<Run> run(const std::string& name, const core::Scene& scene, core::Timers& timers,
                                       const std::function<void(tfm::Model&)>& start);
/// Steps of scene.dem.fixed_step.
[[nodiscard]] std::unique_ptr<TextbookSpheres> spheres(const std::string& name, const core::Scene& scene,
                                                       const std::vector<scenes::Bead>& beads);
[[nodiscard]] std::unique_ptr<TextbookSuspension> suspension(const std::string& name, const core::Scene& scene,
                                                             const std::vector<scenes::Bead>& beads);
/// Net pressure at the bottom of a pipe of fluid alone after each of so many steps, Pa: `scene` as it is, at rest,
/// driven by its inlet, open at the top. \param step  s
[[nodiscard]] std::vector<double> sound(const std::string& name, const core::Scene& scene, double step, int steps);

}  // namespace textbook

}  // namespace polybed::hard
