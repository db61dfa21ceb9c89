// Particles that leave the box: counted while their contacts still exist, then removed.
#include "dem/outflow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/numerics/messages.hpp"
#include "core/output/checkpoint.hpp"
#include "dem/measures.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

Outflow::Outflow(const Box& box, const Materials& materials, std::vector<Opening> exits)
    : number(materials.species().size(), 0),
      number_at(exits.size(), number),
      box_(box),
      exits_(std::move(exits)),
      greatest_diameter_(materials.greatest_diameter()) {}

/// The one that a leaving particle is beyond, and nearest to across it; the number of exits if it is beyond none.
std::size_t Outflow::exit_of(const Place& place) const {
  double least = std::numeric_limits<double>::infinity();
  std::size_t found = exits_.size();
  for (std::size_t n = 0; n < exits_.size(); ++n) {
    const Opening& exit = exits_[n];
    if (!(exit.outward(place.x) > exit.outward(exit.place))) continue;
    if (exit.about) {  // the opposite side is as far from the axis
      const double along = place.x[std::size_t(exit.axis)] - (*exit.about)[exit.axis == 0 ? 0 : 1];
      if (!(exit.side == 0 ? along < 0 : along > 0)) continue;
    }
    double aside = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == std::size_t(exit.axis)) continue;
      double d = place.x[k] - exit.middle[k];
      if (box_.periodic[k]) d -= box_.size[k] * std::round(d / box_.size[k]);
      aside = std::max(aside, std::abs(d) - exit.half[k]);
    }
    if (aside >= least) continue;
    least = aside;
    found = n;
  }
  return found;
}

std::int64_t Outflow::all() const { return std::accumulate(number.begin(), number.end(), std::int64_t(0)); }

/// The force of a leaving particle on one that stays still acts for half a step: this is not undone and is part of the
/// integration error in the ledger.
std::int64_t Outflow::count_leaving(const Model& model) {
  const Particles& particles = model.particles();
  std::vector<std::int64_t> leave((1 + exits_.size()) * number.size(), 0);  // in all, then through each exit
  for (std::size_t i = 0; i < particles.owned; ++i) {
    if (!takes(particles.place[i])) continue;
    const auto j = std::size_t(particles.species[i]);
    ++leave[j];
    if (const std::size_t exit = exit_of(particles.place[i]); exit < exits_.size())
      ++leave[(1 + exit) * number.size() + j];
  }
  core::add_over_ranks(model.ranks(), leave);
  const std::int64_t leaving =
      std::accumulate(leave.begin(), leave.begin() + std::ptrdiff_t(number.size()), std::int64_t(0));
  if (leaving == 0) return 0;
  std::array<EnergySum, 1> taken{energy_leaving(model)};
  add_over_ranks(model.ranks(), taken);
  energy.add(taken[0]);
  for (std::size_t j = 0; j < number.size(); ++j) {
    number[j] += leave[j];
    for (std::size_t n = 0; n < exits_.size(); ++n) number_at[n][j] += leave[(1 + n) * number.size() + j];
  }
  steps += leaving * model.steps();
  return leaving;
}

/// Removes ghosts too; the lists of pairs and all indices of particles are then invalid.
void Outflow::take_out(Particles& particles) {
  std::size_t staying = 0;
  for (std::size_t i = 0; i < particles.owned; ++i)
    if (!takes(particles.place[i])) particles.set(staying++, particles.at(i));
  particles.resize(staying);
  particles.owned = staying;
}

void Outflow::write(core::Checkpoint& checkpoint, const Particles&, const core::Ranks*) const {
  std::vector<double>& stored = checkpoint.arrays["outflow"];
  stored.assign(number.begin(), number.end());
  for (const std::vector<std::int64_t>& one : number_at) stored.insert(stored.end(), one.begin(), one.end());
  checkpoint.integers["outflow_steps"] = steps;
  checkpoint.integers["outflow_energy"] = energy.whole();
  checkpoint.integers["outflow_energy_part"] = energy.part();
}

/// Without openings in the checkpoint's run, or at the start of another run, none has left.
void Outflow::read(const Restored& from) {
  const std::size_t count = (1 + exits_.size()) * number.size();
  std::vector<std::int64_t> numbers(count + 3, 0);
  const core::Checkpoint& checkpoint = from.checkpoint;
  core::on_first(from.ranks, [&] {
    if (!from.same_run || !checkpoint.arrays.contains("outflow")) return;
    const std::vector<double>& stored = checkpoint.array("outflow");
    if (stored.size() != count ||
        std::any_of(stored.begin(), stored.end(), [](double n) { return !(n >= 0 && n < 9e15); }))
      core::refuse_checkpoint("outflow is not a number of particles of each species");
    for (std::size_t j = 0; j < stored.size(); ++j) numbers[j] = std::int64_t(stored[j]);
    numbers.end()[-3] = checkpoint.count("outflow_steps");
    numbers.end()[-2] = checkpoint.integer("outflow_energy");
    numbers.end()[-1] = checkpoint.integer("outflow_energy_part");
  });
  // Others have zeros: the sum is the first rank's value.
  core::add_over_ranks(from.ranks, numbers);
  std::copy_n(numbers.begin(), number.size(), number.begin());
  for (std::size_t n = 0; n < exits_.size(); ++n)
    std::copy_n(numbers.begin() + std::ptrdiff_t((1 + n) * number.size()), number.size(), number_at[n].begin());
  steps = numbers.end()[-3];
  energy = EnergySum(numbers.end()[-2], numbers.end()[-1]);
}

}  // namespace polybed::dem
