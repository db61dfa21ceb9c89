#include "dem/settling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "closures/sphere.hpp"
#include "closures/terminal_velocity.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/numerics/ranks.hpp"
#include "dem/measures.hpp"
#include "dem/model.hpp"
#include "dem/packing.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

namespace {

/// Restitution while the bed comes to rest: far from 1, and not so low that the dashpot limits the step.
constexpr double dull = 0.3;
constexpr double at_rest = 1e-6;
constexpr double falls = 100;
constexpr std::int64_t steps_to_a_stop = 64;  ///< as often as a run asks whether the user wants to stop

core::Scene falling(core::Scene scene, double step) {
  scene.bed.start = {core::StartKind::mixed};
  scene.dem.fixed_step = step;
  scene.dem.opening.reset();
  scene.inlet.superficial_velocity.clear();
  scene.jets.clear();
  core::set_restitution(scene, dull);
  for (core::ContactPair& pair : scene.contact_pairs) pair.restitution.reset();
  return scene;
}

/// Energy that lifts each particle by its radius, J.
double lifting_energy(const Model& model) {
  double energy = 0;
  for (std::size_t i = 0; i < model.particles().owned; ++i)
    energy += model.particles().place[i].radius / model.particles().motion[i].inverse_mass;
  const Vector g = model.gravity();
  std::array<double, 1> sum{energy * std::hypot(g[0], g[1], g[2])};
  core::add_over_ranks(model.ranks(), sum);
  return sum[0];
}

}  // namespace

double settling_time(const core::Scene& scene, const Materials& materials, const Box& box) {
  constexpr double until_rest = 2.2, in_fluid = 1.5;  // of the falls below, measured
  const double height = start_height(scene, materials, box), g = scene.column.gravity;
  const double dry = until_rest * std::sqrt(2 * height / g);
  if (!scene.fluid.present()) return dry;
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  double slowest = std::numeric_limits<double>::infinity(), solids = 0;
  const std::vector<std::int64_t> numbers = particle_numbers(scene, materials, box);
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    const Species& s = materials.species()[j];
    solids += double(numbers[j]) * closures::sphere_volume(s.radius) / (box.size[0] * box.size[2]);
    if (numbers[j] > 0)
      slowest = std::min(slowest, closures::settling_velocity(2 * s.radius, s.density - fluid.density, fluid.density,
                                                              fluid.viscosity, g));
  }
  constexpr double hindrance = 3;  // exponent of Richardson and Zaki between their 2.4 and 4.65
  const double drop = std::max(0.0, height - solids / scene.bed.solids_fraction);
  return in_fluid * (dry + drop / (slowest * std::pow(1 - solids / height, hindrance)));
}

core::Checkpoint settled(const core::Scene& scene, double step, const std::shared_ptr<const core::Ranks>& ranks) {
  if (!(scene.column.gravity > 0))
    throw core::StartError(
        "bed.start = \"settled\": without column.gravity nothing settles; use \"random\" or \"mixed\"");
  core::Timers timers;
  Model model(falling(scene, step), timers, ranks);
  const double fall = std::sqrt(2 * scene.column.size[1] / scene.column.gravity);
  const double rest = at_rest * lifting_energy(model);
  const auto often = std::int64_t(std::ceil(0.05 * fall / step));
  while (model.time() < falls * fall) {
    for (std::int64_t n = 0; n < often; ++n) {
      if (n % steps_to_a_stop == 0) core::on_all(ranks.get(), [] { core::stop_if_wanted("the bed settled"); });
      model.step(falls * fall);
    }
    const Totals totals = totals_of(model);
    if (totals.kinetic > rest) continue;  // a bead may spin on for seconds about its point of contact
    model.restart();
    return model.checkpoint();
  }
  throw core::NumericsError(fmt::format(
      "bed.start = \"settled\": the bed has not come to rest in {:.3g} s; start from \"mixed\" and look at it",
      falls * fall));
}

}  // namespace polybed::dem
