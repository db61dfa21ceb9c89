// Copies records of particles and contacts to rows of a batch and back, four contacts at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/contacts/batch.hpp"
#include "dem/several.hpp"

namespace polybed::dem {

using FourPlaces = std::int64_t __attribute__((vector_size(32)));

/// Transposes a block of four rows.
[[gnu::always_inline]] inline void transpose(Four (&m)[4]) {
  const Four even_low = __builtin_shuffle(m[0], m[1], FourPlaces{0, 4, 2, 6});
  const Four odd_low = __builtin_shuffle(m[0], m[1], FourPlaces{1, 5, 3, 7});
  const Four even_high = __builtin_shuffle(m[2], m[3], FourPlaces{0, 4, 2, 6});
  const Four odd_high = __builtin_shuffle(m[2], m[3], FourPlaces{1, 5, 3, 7});
  m[0] = __builtin_shuffle(even_low, even_high, FourPlaces{0, 1, 4, 5});
  m[1] = __builtin_shuffle(odd_low, odd_high, FourPlaces{0, 1, 4, 5});
  m[2] = __builtin_shuffle(even_low, even_high, FourPlaces{2, 3, 6, 7});
  m[3] = __builtin_shuffle(odd_low, odd_high, FourPlaces{2, 3, 6, 7});
}

/// Whether all contacts in a batch have one pair of materials, as in a bed of one species.
[[nodiscard]] inline bool one_kind(const ContactBatch& b) {
  std::int32_t differs = 0;
  for (int c = 0; c < b.count; ++c) differs |= b.kind[c] ^ b.kind[0];
  return differs == 0;
}

/// Calls fill(constants of the contact's kind, contact) for each contact, and also beyond the last if that is faster.
template <class Constants, class Fill>
void fill_by_kind(const ContactBatch& b, const std::vector<Constants>& constants, Fill&& fill) {
  if (b.count > 0 && one_kind(b)) {
    const Constants k = constants[std::size_t(b.kind[0])];
    const int n = b.padded();
    POLYBED_INDEPENDENT
    for (int c = 0; c < n; ++c) fill(k, c);
    return;
  }
  for (int c = 0; c < b.count; ++c) fill(constants[std::size_t(b.kind[c])], c);
}

}  // namespace polybed::dem
