#include "dem/ledger.hpp"

namespace polybed::dem {

namespace {

using Row = ContactBatch::Row;

/// Energy lost by dashpots along the normal, J; the memory moves on.
POLYBED_ALL_VECTOR_WIDTHS void lose_by_dashpot(ContactBatch& b, int m, double dt, Row& lost) {
  for (int c = 0; c < b.padded(); ++c) {
    const double dashpot = b.normal[c] - b.elastic[c];
    lost[c] = -0.5 * (b.memory[m][c] + dashpot) * b.speed[c] * dt;
    b.memory[m][c] = dashpot;
  }
}

/// Adds the work against a force and a velocity, or a moment and a spin, less what its spring has stored.
POLYBED_ALL_VECTOR_WIDTHS void lose_by_work(ContactBatch& b, int m, const Row* load, const Row* rate, const Row& stored,
                                            double dt, Row& lost) {
  for (int c = 0; c < b.padded(); ++c) {
    double power = 0;
    for (int k = 0; k < 3; ++k) {
      power += (b.memory[m + k][c] + load[k][c]) * rate[k][c];
      b.memory[m + k][c] = load[k][c];
    }
    lost[c] += -0.5 * power * dt - (stored[c] - b.memory[m + 3][c]);
    b.memory[m + 3][c] = stored[c];
  }
}

std::int64_t units_of(const Row& lost, const Row& counted, int count, double per_unit) {
  std::int64_t sum = 0;
  for (int c = 0; c < count; ++c) sum += std::int64_t(counted[c] * lost[c] * per_unit);
  return sum;
}

}  // namespace

void Ledger::act(ContactBatch& batch, const Row& counted, double dt) {
  alignas(64) Row lost = {};
  int place = place_;
  lose_by_dashpot(batch, place++, dt, lost);
  if (laws_.tangential) {
    alignas(64) Row stored = {};
    laws_.tangential->energy(batch, stored);
    lose_by_work(batch, place, batch.tangential, batch.velocity, stored, dt, lost);
    place += 4;
  }
  if (laws_.rolling) {
    alignas(64) Row stored = {}, spin[3];
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < ContactBatch::width; ++c) spin[k][c] = batch.spin_i[k][c] - batch.spin_j[k][c];
    laws_.rolling->add_energy(batch, stored);
    lose_by_work(batch, place, batch.moment, spin, stored, dt, lost);
  }
  if (laws_.cohesion) laws_.cohesion->add_loss(batch, lost);
  units_ += units_of(lost, counted, batch.count, unit_.per_unit);
}

}  // namespace polybed::dem
