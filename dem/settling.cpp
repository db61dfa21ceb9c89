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
#include "dem/invariants.hpp"
#include "dem/measures.hpp"
#include "dem/model.hpp"
#include "dem/packing.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/effects/contact.hpp"
#include "relevance/effects/rolling.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

namespace {

/// Restitution while the bed settles: far below 1, but high enough that the dashpot does not limit the step.
constexpr double dull = 0.3;
constexpr double at_rest = 1e-6;
constexpr double of_fall = 0.05;              ///< between two checks of the bed
constexpr double longest_wait = 20;           ///< over the expected time; actual: 0.7 to 1.9
constexpr std::int64_t steps_to_a_stop = 64;  ///< as often as a run checks for a stop by the user

bool rolls_without_spring(const core::Scene& scene) {
  return relevance::effects::rolling.has(scene, relevance::effects::without_spring);
}

/// A constant rolling moment changes sign with the spin from step to step and keeps a bed creeping. The spring with the
/// same greatest moment lets it rest, and a bed at rest under it needs no more. An arm of half a radius makes it as
/// stiff as the step allows.
void roll_with_spring(core::Scene& scene) {
  constexpr double greatest_arm = 0.5, damping = 0.3;  // over R*; over the critical one
  scene.effects[relevance::effects::rolling.role] = relevance::effects::with_spring;
  scene.dem.rolling_friction = std::min(scene.dem.rolling_friction, greatest_arm);
  scene.dem.rolling_damping = damping;
}

core::Scene falling(core::Scene scene, double step) {
  if (rolls_without_spring(scene)) roll_with_spring(scene);
  scene.bed.start = {core::StartKind::mixed};
  scene.dem.fixed_step = step;
  scene.dem.opening.reset();
  scene.column.outlet = core::Outlet::screen;
  scene.inlet.superficial_velocity.clear();
  scene.jets.clear();
  scene.feeds.clear();
  scene.discharges.clear();
  core::set_restitution(scene, dull);
  for (core::ContactPair& pair : scene.contact_pairs) pair.restitution.reset();
  return scene;
}

/// Removes numbers from the memory of each contact. \param place  index of the first
void forget(core::Checkpoint& checkpoint, std::size_t place, std::size_t count) {
  constexpr std::size_t ids = 2;
  std::int64_t& size = checkpoint.integers.at("memory_size");
  const std::size_t width = ids + std::size_t(size), from = ids + place;
  size -= std::int64_t(count);
  const auto contacts = checkpoint.arrays.find("contacts");  // on the first rank
  if (contacts == checkpoint.arrays.end()) return;
  std::vector<double> kept;
  for (std::size_t n = 0; n < contacts->second.size(); ++n)
    if (n % width < from || n % width >= from + count) kept.push_back(contacts->second[n]);
  contacts->second = std::move(kept);
}

/// m/s, at which a species settles alone, or rises; infinite without a fluid, or where it does neither.
double speed_alone(const core::Scene& scene, const core::Species& species) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (!scene.fluid.present()) return none;
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const double excess = std::abs(species.density - fluid.density);
  return excess > 0 ? closures::settling_velocity(species.diameter, excess, fluid.density, fluid.viscosity,
                                                  scene.column.gravity, relevance::shape_of(scene, species))
                    : none;
}

/// Energy that lifts each particle by its radius, or its energy when it settles alone if that is less: in a viscous
/// fluid a bed moves with little energy all the way down. J.
double energy_of_fall(const core::Scene& scene, const Model& model) {
  double energy = 0;
  const std::vector<std::int64_t> number = numbers_of(model);
  for (std::size_t j = 0; j < number.size(); ++j) {
    const Species& species = model.materials().species()[j];
    const double alone = speed_alone(scene, scene.species[j]);
    energy += double(number[j]) * species.mass * std::min(scene.column.gravity * species.radius, 0.5 * alone * alone);
  }
  return energy;
}

/// Factor on the time for beads with little friction, whose supports yield again and again. Measured on a bed of 300:
/// 4.7 without friction, 2.1 with 0.01, 1 with 0.1.
double sliding(const core::Scene& scene, const Materials& materials) {
  constexpr double without_friction = 3.7, fades = 0.012;
  double friction = std::numeric_limits<double>::infinity();
  for (int i = 0; i < int(materials.species().size()); ++i)
    friction = std::min(friction, materials.kinds()[std::size_t(materials.kind(i, i))].friction);
  if (relevance::effects::contact.has(scene, relevance::effects::frictionless)) friction = 0;
  return 1 + without_friction * std::exp(-friction / fades);
}

}  // namespace

double settling_time(const core::Scene& scene, const Materials& materials, const Box& box) {
  constexpr double until_rest = 2.2, in_fluid = 1.5;  // in units of the falls below, measured
  const double height = start_height(scene, materials, box), g = scene.column.gravity;
  const double dry = until_rest * sliding(scene, materials) * std::sqrt(2 * height / g);
  if (!scene.fluid.present()) return dry;
  const double density = relevance::fluid_constants(scene.fluid).density;
  const std::vector<std::int64_t> numbers = particle_numbers(scene, materials);
  double solids = 0;
  for (std::size_t j = 0; j < numbers.size(); ++j)
    solids +=
        double(numbers[j]) * closures::sphere_volume(materials.species()[j].radius) / scene.column.cross_section();
  constexpr double hindrance = 3;  // exponent of Richardson and Zaki, between its limits 2.4 and 4.65
  double slowest = 0;
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    const Species& s = materials.species()[j];
    if (numbers[j] == 0 || s.density == density) continue;
    const double room = s.density > density ? height : box.size[1];  // lighter solids rise to the top of the column
    const double way = std::max(0.0, room - scene.column.filled_height(solids / scene.bed.solids_fraction));
    const double clear = 1 - solids / scene.column.even_height(room);
    slowest = std::max(slowest, way / (speed_alone(scene, scene.species[j]) * std::pow(clear, hindrance)));
  }
  return in_fluid * (dry + slowest);
}

core::Checkpoint settled(const core::Scene& scene, double step, const std::shared_ptr<const core::Ranks>& ranks,
                         const std::function<void(const Settling&)>& see) {
  if (!(scene.column.gravity > 0))
    throw core::StartError(
        "bed.start = \"settled\": without column.gravity nothing settles; use \"random\" or \"mixed\"");
  core::Timers timers;
  Model model(falling(scene, step), timers, ranks);
  const double fall = std::sqrt(2 * scene.column.size[1] / scene.column.gravity);
  const double rest = at_rest * energy_of_fall(scene, model);
  const auto often = std::int64_t(std::ceil(of_fall * fall / step));
  Settling state{0, settling_time(scene, model.materials(), model.box()), 0};
  const double most = std::max(longest_wait * state.expected, 2 * of_fall * fall);
  Totals totals;
  while (model.time() < most) {
    for (std::int64_t n = 0; n < often; ++n) {
      if (n % steps_to_a_stop == 0) core::on_all(ranks.get(), [] { core::stop_if_wanted("the bed settled"); });
      model.step(1e300);
    }
    totals = totals_of(model);
    if (totals.kinetic <= rest) {  // a bead can spin on for seconds about its point of contact
      model.restart();
      core::Checkpoint checkpoint = model.checkpoint();
      const PairLaws& laws = model.laws();
      if (rolls_without_spring(scene)) {
        const int spring = laws.rolling->memory_size();
        forget(checkpoint, std::size_t(laws.contact_memory() - spring), std::size_t(spring));
      }
      return checkpoint;
    }
    state.time = model.time();
    state.over_rest = totals.kinetic / rest;
    if (see) see(state);
  }
  throw core::NumericsError(fmt::format(
      "bed.start = \"settled\": the bed has not come to rest in {:.3g} s, {:g} times the time expected: its energy of "
      "motion is {:.3g} times that of rest, and the fastest particle moves at {:.3g} m/s; start from \"mixed\" and "
      "look "
      "at it",
      model.time(), longest_wait, state.over_rest, totals.greatest_speed));
}

}  // namespace polybed::dem
