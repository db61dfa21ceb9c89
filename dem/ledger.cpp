#include "dem/ledger.hpp"

namespace polybed::dem {

namespace {

/// Energy lost in each contact, in whole units; the memory moves on.
POLYBED_ALL_VECTOR_WIDTHS std::int64_t count(ContactBatch& b, int m, const ContactBatch::Row& stored,
                                             const ContactBatch::Row& counted, bool tangential, double dt,
                                             double per_unit) {
  std::int64_t sum = 0;
  for (int c = 0; c < b.count; ++c) {
    const double dashpot = b.normal[c] - b.elastic[c];
    double lost = -0.5 * (b.memory[m][c] + dashpot) * b.speed[c] * dt;
    b.memory[m][c] = dashpot;
    if (tangential) {
      double power = 0;
      for (int k = 0; k < 3; ++k) {
        power += (b.memory[m + 1 + k][c] + b.tangential[k][c]) * b.velocity[k][c];
        b.memory[m + 1 + k][c] = b.tangential[k][c];
      }
      lost += -0.5 * power * dt - (stored[c] - b.memory[m + 4][c]);
      b.memory[m + 4][c] = stored[c];
    }
    sum += std::int64_t(counted[c] * lost * per_unit);
  }
  return sum;
}

}  // namespace

void Ledger::act(ContactBatch& batch, const ContactBatch::Row& counted, double dt) {
  alignas(64) ContactBatch::Row stored = {};
  if (laws_.tangential) laws_.tangential->energy(batch, stored);
  units_ += count(batch, place_, stored, counted, laws_.tangential != nullptr, dt, unit_.per_unit);
}

}  // namespace polybed::dem
