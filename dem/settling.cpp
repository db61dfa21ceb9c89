#include "dem/settling.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "dem/measures.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

namespace {

/// Restitution while the bed comes to rest: far from 1, and not so low that the dashpot limits the step.
constexpr double dull = 0.3;
constexpr double at_rest = 1e-6;
constexpr double falls = 100;

core::Scene falling(core::Scene scene, double step) {
  scene.bed.start = "mixed";
  scene.dem.fixed_step = step;
  scene.dem.opening.reset();
  scene.dem.restitution = dull;
  for (core::Species& s : scene.species) s.restitution = dull;
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

core::Checkpoint settled(const core::Scene& scene, double step, const std::shared_ptr<const core::Ranks>& ranks) {
  if (!(scene.column.gravity > 0))
    throw core::CaseError(
        "bed.start = \"settled\": without column.gravity nothing settles; use \"random\" or \"mixed\"");
  core::Timers timers;
  Model model(falling(scene, step), timers, ranks);
  const double fall = std::sqrt(2 * scene.column.size[1] / scene.column.gravity);
  const double rest = at_rest * lifting_energy(model);
  const auto often = std::int64_t(std::ceil(0.05 * fall / step));
  while (model.time() < falls * fall) {
    for (std::int64_t n = 0; n < often; ++n) model.step(falls * fall);
    const Totals totals = totals_of(model);
    if (totals.kinetic + totals.rotational > rest) continue;
    model.restart();
    return model.checkpoint();
  }
  throw core::NumericsError(fmt::format(
      "bed.start = \"settled\": the bed has not come to rest in {:.3g} s; start from \"mixed\" and look at it",
      falls * fall));
}

}  // namespace polybed::dem
