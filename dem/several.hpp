// Several numbers in a record at once.
#pragma once

#include <array>
#include <cstdint>

#include "dem/particles.hpp"

namespace polybed::dem {

/// Four numbers in one register, or two halves of it: element k of four records, or elements k to k + 3 of one. Without
/// the attribute, code for any processor aligns it to 16 bytes and AVX code expects 32. Template arguments drop it.
using Four = double __attribute__((vector_size(32), aligned(32)));

/// Four numbers in place, at any multiple of 8 bytes. A memcpy would copy through memory in two halves, and the
/// processor cannot forward two stores to the load that follows.
using FourInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));

[[gnu::always_inline]] inline void get_four(const void* from, Four& four) {
  four = *static_cast<const FourInMemory*>(from);
}
[[gnu::always_inline]] inline void put_four(const Four& four, void* to) { *static_cast<FourInMemory*>(to) = four; }

/// Four whole numbers in place, at any multiple of 8 bytes.
using WholeInMemory = std::int64_t __attribute__((vector_size(32), aligned(8), may_alias));
/// Adds to four whole numbers, each truncated.
[[gnu::always_inline]] inline void add_whole(const Four& four, std::int64_t* to) {
  *static_cast<WholeInMemory*>(static_cast<void*>(to)) += __builtin_convertvector(four, WholeInMemory);
}

/// A vector and the next number in its record.
[[gnu::always_inline]] inline Four four_at(const Vector& first_three) {
  return *static_cast<const FourInMemory*>(static_cast<const void*>(first_three.data()));
}
/// Adds to a vector without changing the next number.
[[gnu::always_inline]] inline void add_three(const Four& change, Vector& to) {
  using Places = std::int64_t __attribute__((vector_size(32)));
  const Four before = four_at(to), sum = before + change;
  put_four(__builtin_shuffle(sum, before, Places{0, 1, 2, 7}), to.data());
}
[[gnu::always_inline]] inline Four to_four(const std::array<std::int64_t, 3>& whole) {
  return Four{double(whole[0]), double(whole[1]), double(whole[2]), 0};
}

/// Two numbers in one register.
using Two = double __attribute__((vector_size(16)));
using TwoInMemory = double __attribute__((vector_size(16), aligned(8), may_alias));

}  // namespace polybed::dem
