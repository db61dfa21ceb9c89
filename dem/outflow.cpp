// Particles that leave the box: counted while their contacts still exist, then removed.
#include "dem/outflow.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/numerics/messages.hpp"
#include "core/output/checkpoint.hpp"
#include "dem/measures.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

Outflow::Outflow(const Box& box, const Materials& materials)
    : number(materials.species().size(), 0), box_(box), greatest_diameter_(materials.greatest_diameter()) {}

std::int64_t Outflow::all() const { return std::accumulate(number.begin(), number.end(), std::int64_t(0)); }

/// The force of a leaving particle on one that stays still acts for half a step: this is not undone and is part of the
/// integration error in the ledger.
std::int64_t Outflow::count_leaving(const Model& model) {
  const Particles& particles = model.particles();
  std::vector<std::int64_t> leave(number.size(), 0);
  for (std::size_t i = 0; i < particles.owned; ++i)
    if (takes(particles.place[i])) ++leave[std::size_t(particles.species[i])];
  core::add_over_ranks(model.ranks(), leave);
  const std::int64_t leaving = std::accumulate(leave.begin(), leave.end(), std::int64_t(0));
  if (leaving == 0) return 0;
  std::array<EnergySum, 1> taken{energy_leaving(model)};
  add_over_ranks(model.ranks(), taken);
  energy.add(taken[0]);
  for (std::size_t j = 0; j < number.size(); ++j) number[j] += leave[j];
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
  checkpoint.arrays["outflow"].assign(number.begin(), number.end());
  checkpoint.integers["outflow_steps"] = steps;
  checkpoint.integers["outflow_energy"] = energy.whole();
  checkpoint.integers["outflow_energy_part"] = energy.part();
}

/// Without openings in the checkpoint's run, or at the start of another run, none has left.
void Outflow::read(const Restored& from) {
  std::vector<std::int64_t> numbers(number.size() + 3, 0);
  const core::Checkpoint& checkpoint = from.checkpoint;
  core::on_first(from.ranks, [&] {
    if (!from.same_run || !checkpoint.arrays.contains("outflow")) return;
    const std::vector<double>& stored = checkpoint.array("outflow");
    if (stored.size() != number.size() ||
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
  steps = numbers.end()[-3];
  energy = EnergySum(numbers.end()[-2], numbers.end()[-1]);
}

}  // namespace polybed::dem
