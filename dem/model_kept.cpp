// The particle model in checkpoints: writes and restores its complete state.
#include <algorithm>

#include "core/error.hpp"
#include "dem/invariants.hpp"
#include "dem/kept_sums.hpp"
#include "dem/model.hpp"
#include "dem/parallel/ordered_rows.hpp"
#include "dem/scene.hpp"
#include "dem/step_limits.hpp"

namespace polybed::dem {

core::Checkpoint Model::checkpoint() const {
  core::Checkpoint checkpoint = checkpoint_but_rows();
  checkpoint.arrays["particles"] = on_first(particle_rows(particles_, ranks_), ranks_);
  checkpoint.arrays["contacts"] = on_first(contact_rows(pairs_, walls_, particles_, ranks_), ranks_);
  return checkpoint;
}

std::vector<core::BlockData> Model::rows() const {
  std::vector<core::BlockData> rows = particle_rows(particles_, ranks_);
  for (core::BlockData& block : contact_rows(pairs_, walls_, particles_, ranks_)) rows.push_back(std::move(block));
  return rows;
}

core::Checkpoint Model::checkpoint_but_rows() const {
  core::Checkpoint checkpoint;
  checkpoint.integers["memory_size"] = pairs_.memory_size;
  const std::vector<std::int64_t> numbers = numbers_of(*this);
  checkpoint.arrays[core::particle_numbers].assign(numbers.begin(), numbers.end());
  write_clock(
      {double(steps_), limits_.dt, reported_, began_, double(began_at_), limits_.greatest_speed,
       core::greatest_of_ranks(ranks_.get(), met_), box_.strain_before + box_.shear_rate * clock(), box_.strain_before},
      checkpoint);
  write_sum(checkpoint, ranks_.get(), "dissipated", counted_energy().dissipated);
  for (const KeptPart* part : kept_) part->write(checkpoint, particles_, ranks_.get());
  return checkpoint;
}

void Model::start_from(const core::Checkpoint& checkpoint) {
  restore(checkpoint, false);
  // Walls and materials can differ from the checkpoint's: contacts and their forces are recomputed.
  std::fill(particles_.load.begin(), particles_.load.end(), Load{});
  find_forces(0);
  if (ledger_) ledger_->begin_from_other();
  if (joined_work_) joined_work_->begin_from_other();
  if (coupling_) coupling_->begin_from_other(particles_);
}

/// On the first rank: checks data besides particles and contacts against this model.
Clock Model::checked_clock(const core::Checkpoint& checkpoint, bool same_run) const {
  core::require_numbers(checkpoint);
  const Clock clock = read_clock(checkpoint, limits_.greatest_speed, box_.shear_rate);
  const double dt = step_limits(scene_, materials_, laws_, clock.speed).dt;
  if (checkpoint.integer("memory_size") != pairs_.memory_size || (same_run && clock.dt != dt))
    throw core::FileError("the checkpoint is of another law of contact or another time step");
  if (box_.shear_rate == 0 && clock.strain != 0)
    throw core::FileError(
        "the checkpoint is of a sheared box, whose faces do not meet at rest: give column.shear_rate");
  if (!same_run) return clock;
  require_clock(clock);
  for (const KeptPart* part : kept_) part->require(checkpoint);
  return clock;
}

void Model::restore(const core::Checkpoint& checkpoint, bool same_run) {
  Clock first;
  core::on_first(ranks_.get(), [&] { first = checked_clock(checkpoint, same_run); });
  KeptState state = read_state(checkpoint, first, {materials_, box_, pairs_.memory_size}, ranks_.get());
  const Clock& clock = state.clock;
  box_.strain_before = same_run ? clock.strain_before : clock.strain;
  if (same_run) {
    steps_ = std::int64_t(clock.steps);
    reported_ = clock.time;
    set_step_for(clock.began, std::int64_t(clock.began_at), clock.speed);
    met_ = clock.greatest_met;
  }
  place(state.particles, work_of(state, work_of_particle()));
  for (KeptPart* part : kept_) part->read({checkpoint, ranks_.get(), particles_, state.particles, same_run});
  if (coupling_ && feeding_) coupling_->see(feeding_->arrivals());
  set_skin(skin_of(scene_, materials_));
  list_pairs({state.contacts, pairs_.memory_size});
}

}  // namespace polybed::dem
