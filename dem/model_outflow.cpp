// Particles that leave the box: counted while their contacts are still known, then taken out.
#include <algorithm>
#include <array>
#include <numeric>

#include "core/numerics/messages.hpp"
#include "dem/measures.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

/// Collective, before anything is moved. A force on a particle that stays, from one that leaves, still acts for the
/// half step that is due: what that does is not taken back, and is part of the integration's error in the ledger.
void Model::count_leaving() {
  std::vector<std::int64_t> number(outflow_->number.size(), 0);
  for (std::size_t i = 0; i < particles_.owned; ++i)
    if (outflow_->takes(particles_.place[i])) ++number[std::size_t(particles_.species[i])];
  core::add_over_ranks(ranks_.get(), number);
  const std::int64_t leaving = std::accumulate(number.begin(), number.end(), std::int64_t(0));
  if (leaving == 0) return;
  std::array<EnergySum, 1> energy{energy_leaving(*this)};
  add_over_ranks(ranks_.get(), energy);
  outflow_->energy.add(energy[0]);
  for (std::size_t j = 0; j < number.size(); ++j) outflow_->number[j] += number[j];
  outflow_->steps += leaving * steps_;
  count_ -= leaving;
}

/// Ghosts go as well; the lists of pairs and all that is told by places in them are void then.
void Model::take_out() {
  std::size_t staying = 0;
  for (std::size_t i = 0; i < particles_.owned; ++i)
    if (!outflow_->takes(particles_.place[i])) particles_.set(staying++, particles_.at(i));
  particles_.resize(staying);
  particles_.owned = staying;
}

void Model::write_outflow(core::Checkpoint& checkpoint) const {
  std::vector<double>& number = checkpoint.arrays["outflow"];
  for (const std::int64_t n : outflow_->number) number.push_back(double(n));
  checkpoint.integers["outflow_steps"] = outflow_->steps;
  checkpoint.integers["outflow_energy"] = outflow_->energy.whole();
  checkpoint.integers["outflow_energy_part"] = outflow_->energy.part();
}

/// Only the first rank's checkpoint is read; of a run without an opening none has left.
void Model::read_outflow(const core::Checkpoint& checkpoint) {
  std::vector<std::int64_t> numbers(outflow_->number.size() + 3, 0);
  core::on_first(ranks_.get(), [&] {
    if (!checkpoint.arrays.contains("outflow")) return;
    const std::vector<double>& stored = checkpoint.array("outflow");
    if (stored.size() != outflow_->number.size() ||
        std::any_of(stored.begin(), stored.end(), [](double n) { return !(n >= 0 && n < 9e15); }))
      core::refuse_checkpoint("outflow is not a number of particles of each species");
    for (std::size_t j = 0; j < stored.size(); ++j) numbers[j] = std::int64_t(stored[j]);
    numbers.end()[-3] = checkpoint.count("outflow_steps");
    numbers.end()[-2] = checkpoint.integer("outflow_energy");
    numbers.end()[-1] = checkpoint.integer("outflow_energy_part");
  });
  // Others have zeros: a sum is what the first has.
  core::add_over_ranks(ranks_.get(), numbers);
  std::copy_n(numbers.begin(), outflow_->number.size(), outflow_->number.begin());
  outflow_->steps = numbers.end()[-3];
  outflow_->energy = EnergySum(numbers.end()[-2], numbers.end()[-1]);
}

}  // namespace polybed::dem
