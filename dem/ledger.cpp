#include "dem/ledger.hpp"

namespace polybed::dem {

namespace {

/// What one call needs beside the batch.
struct Account {
  int place;  ///< of the memory
  bool tangential, synchronised;
  double dt, elastic_share, per_unit;
};

/// Energy lost in each contact, in whole units; the memory moves on.
POLYBED_ALL_VECTOR_WIDTHS std::int64_t count(ContactBatch& b, const ContactBatch::Row& stored,
                                             const ContactBatch::Row& counted, const Account& account) {
  const int m = account.place;
  const double half = -0.5 * account.dt;
  std::int64_t sum = 0;
  for (int c = 0; c < b.count; ++c) {
    const double dashpot = b.normal[c] - b.elastic[c];
    double before = b.memory[m][c] * b.speed[c], now = dashpot * b.speed[c], gained = 0;
    if (account.tangential) {
      for (int k = 0; k < 3; ++k) {
        before += b.memory[m + 1 + k][c] * b.velocity[k][c];
        now += b.tangential[k][c] * b.velocity[k][c];
        b.memory[m + 1 + k][c] = b.tangential[k][c];
      }
      gained = stored[c] - b.memory[m + 4][c];
      b.memory[m + 4][c] = stored[c];
    }
    const double due = account.synchronised ? b.memory[m][c] : half * before;
    const double lost = due + half * now - gained;
    b.memory[m][c] = account.synchronised ? half * now : dashpot;
    const bool ended = b.normal[c] == 0;
    b.memory[m + 5][c] = (ended ? account.elastic_share * b.elastic[c] * b.overlap[c] : half * now) + stored[c];
    sum += std::int64_t(counted[c] * lost * account.per_unit);
  }
  return sum;
}

}  // namespace

Ledger::Ledger(const PairLaws& laws, int place, bool synchronised, FixedPoint unit)
    : laws_(laws), place_(place), synchronised_(synchronised), unit_(unit) {
  // Force is a power of overlap, the same for all pairs: one overlap tells the share.
  constexpr double overlap = 1e-6;
  elastic_share_ = laws.normal->energy(0, overlap) / (laws.normal->force_at(0, overlap) * overlap);
}

void Ledger::act(ContactBatch& batch, const ContactBatch::Row& counted, double dt) {
  alignas(64) ContactBatch::Row stored = {};
  if (laws_.tangential) laws_.tangential->energy(batch, stored);
  const Account account{place_, laws_.tangential != nullptr, synchronised_, dt, elastic_share_, unit_.per_unit};
  units_ += count(batch, stored, counted, account);
}

void Ledger::part(const Contacts& contacts, std::span<const std::int32_t> before, std::size_t owned) {
  contacts.each_parted(before, [&](std::int32_t pair) {
    if (std::size_t(contacts.pairs[std::size_t(pair)].first) < owned)
      units_ += std::int64_t(contacts.memory_of(pair)[place_ + 5] * unit_.per_unit);
  });
}

}  // namespace polybed::dem
