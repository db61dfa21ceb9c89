// Scenes of a few particles given one by one: hard cases and verification tests start from them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/timers.hpp"
#include "dem/measures.hpp"
#include "dem/model.hpp"
#include "scenes/scratch.hpp"

namespace polybed::scenes {

constexpr double rigid = std::numeric_limits<double>::infinity();  ///< Young's modulus of a wall that does not yield
constexpr double pi = std::numbers::pi;

/// A particle at the start.
struct Bead {
  std::string species;
  dem::Vector x, v{}, w{};
};

/// Young's modulus, Pa, Poisson ratio, density, kg/m3.
struct Material {
  double youngs_modulus, poisson_ratio, density;
};

inline core::Species sphere(const std::string& name, double radius, const Material& material) {
  core::Species species;
  species.name = name;
  species.diameter = 2 * radius;
  species.density = material.density;
  species.youngs_modulus = material.youngs_modulus;
  species.poisson_ratio = material.poisson_ratio;
  return species;
}

/// One species in a box, m, without gravity; closed by rigid walls unless the test says otherwise.
inline core::Scene dry_box(double radius, const Material& material, dem::Vector size) {
  core::Scene scene;
  scene.title = "particles";
  scene.column.dimensions = 3;
  scene.column.size = size;
  scene.column.cells = {1, 1, 1};
  scene.column.gravity = 0;
  scene.fluid.name = "none";
  scene.species = {sphere("a", radius, material)};
  scene.effects = {{"contact", "hertz_mindlin"}};
  scene.dem.youngs_modulus = rigid;
  scene.dem.poisson_ratio = 0.3;
  scene.dem.greatest_speed = 1;
  return scene;
}

/// A model of particles given one by one, which go the way of a case: through the file of a list.
class Beads {
 public:
  Beads(const core::Scene& scene, const std::vector<Bead>& beads)
      : scene_(written(scene, beads)), model(scene_, timers) {}
  Beads(const Beads&) = delete;
  Beads& operator=(const Beads&) = delete;

  void steps(std::int64_t number) {
    for (std::int64_t n = 0; n < number; ++n) model.step(1e300);
  }
  /// To the step nearest to a time, s.
  void until(double time) { steps(std::llround(time / dt()) - model.steps()); }
  /// Steps as long as a condition holds; more than `most` are a failure.
  void run_while(const std::function<bool()>& condition, std::int64_t most = 10'000'000) {
    for (std::int64_t n = 0; condition(); ++n) {
      if (n >= most) throw std::runtime_error("never came to its end");
      model.step(1e300);
    }
  }
  [[nodiscard]] double dt() const { return model.limits().dt; }
  /// By its place in the list.
  [[nodiscard]] const dem::Place& place(std::int64_t id) const { return model.particles().place[index(id)]; }
  [[nodiscard]] const dem::Motion& motion(std::int64_t id) const { return model.particles().motion[index(id)]; }
  [[nodiscard]] dem::Vector force(std::int64_t id) const {
    return in_units(model.particles().load[index(id)].force, false);
  }
  [[nodiscard]] dem::Vector torque(std::int64_t id) const {
    return in_units(model.particles().load[index(id)].torque, true);
  }

 private:
  [[nodiscard]] std::size_t index(std::int64_t id) const {
    const dem::Particles& p = model.particles();
    for (std::size_t i = 0; i < p.owned; ++i)
      if (p.id[i] == id) return i;
    throw std::out_of_range("no such particle");
  }
  [[nodiscard]] dem::Vector in_units(const std::array<std::int64_t, 3>& units, bool torque) const {
    const double unit = torque ? model.unit_of_torque().unit : model.unit_of_force().unit;
    return {double(units[0]) * unit, double(units[1]) * unit, double(units[2]) * unit};
  }
  core::Scene written(core::Scene scene, const std::vector<Bead>& beads) {
    std::ofstream file(folder_.path() / "beads.csv");
    file << "species,x,y,z,vx,vy,vz,wx,wy,wz\n";
    for (const Bead& b : beads)
      file << fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", b.species,
                          b.x[0], b.x[1], b.x[2], b.v[0], b.v[1], b.v[2], b.w[0], b.w[1], b.w[2]);
    scene.bed.start = {core::StartKind::list, (folder_.path() / "beads.csv").string()};
    return scene;
  }

  Scratch folder_;
  core::Scene scene_;
  core::Timers timers;

 public:
  dem::Model model;
};

/// delta_m, F_m and t_c of an elastic impact after Hertz, from the numbers of the problem alone.
struct HertzImpact {
  double overlap, force, duration;
};
inline HertzImpact hertz_impact(double reduced_modulus, double reduced_radius, double reduced_mass, double speed) {
  const double k = 4.0 / 3 * reduced_modulus * std::sqrt(reduced_radius);
  const double overlap = std::pow(5 * reduced_mass * speed * speed / (4 * k), 0.4);
  return {overlap, k * std::pow(overlap, 1.5), 2.9432751843 * overlap / speed};
}

inline double mass_of(double radius, double density) { return 4.0 / 3 * pi * radius * radius * radius * density; }

}  // namespace polybed::scenes
