// Several numbers in a record at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
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

/// A number of each of four particles, for x, y and z. A copy of the bytes would go through memory in halves, as above.
struct FourVectors {
  Four x{}, y{}, z{};

  FourVectors() = default;
  [[gnu::always_inline]] FourVectors(const Four& x, const Four& y, const Four& z) : x(x), y(y), z(z) {}
  [[gnu::always_inline]] FourVectors(const FourVectors& other) : FourVectors(other.x, other.y, other.z) {}
  [[gnu::always_inline]] FourVectors& operator=(const FourVectors& other) {
    x = other.x;
    y = other.y;
    z = other.z;
    return *this;
  }
};
/// act for each component.
template <class Act, class... Of>
[[gnu::always_inline]] inline FourVectors each(const Act& act, const Of&... of) {
  return {act(of.x...), act(of.y...), act(of.z...)};
}
[[gnu::always_inline]] inline FourVectors operator+(const FourVectors& a, const FourVectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline FourVectors operator-(const FourVectors& a, const FourVectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline FourVectors operator*(const FourVectors& a, const auto& b) {
  return {a.x * b, a.y * b, a.z * b};
}
[[gnu::always_inline]] inline Four sum_of(const FourVectors& a) { return a.x + a.y + a.z; }

/// Four particles in a row, or at the end of a row fewer: the last one is then read again, and written once.
struct FullGroup {
  std::size_t first;
  static constexpr std::size_t count = 4;
  std::size_t operator[](std::size_t k) const { return first + k; }
};
struct PartGroup {
  std::size_t first, count;
  std::size_t operator[](std::size_t k) const { return first + std::min(k, count - 1); }
};
template <class Act>
[[gnu::always_inline]] inline void for_each_group(std::size_t count, const Act& act) {
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) act(FullGroup{i});
  if (i < count) act(PartGroup{i, count - i});
}

/// Four numbers of each of four particles: one row per number.
struct FourRecords {
  FourVectors of;
  Four next;  ///< the number behind a vector

  /// Exchanges rows and particles.
  [[gnu::always_inline]] void turn() {
    using Places = std::int64_t __attribute__((vector_size(32)));
    constexpr Places even{0, 4, 2, 6}, odd{1, 5, 3, 7}, low{0, 1, 4, 5}, high{2, 3, 6, 7};
    const Four a = __builtin_shuffle(of.x, of.y, even), b = __builtin_shuffle(of.x, of.y, odd);
    const Four c = __builtin_shuffle(of.z, next, even), d = __builtin_shuffle(of.z, next, odd);
    of = {__builtin_shuffle(a, c, low), __builtin_shuffle(b, d, low), __builtin_shuffle(a, c, high)};
    next = __builtin_shuffle(b, d, high);
  }
};
/// \param at  address of the first number for a particle
template <class Group, class At>
[[gnu::always_inline]] inline FourRecords get_records(const Group& group, const At& at) {
  FourRecords r;
  get_four(at(group[0]), r.of.x);
  get_four(at(group[1]), r.of.y);
  get_four(at(group[2]), r.of.z);
  get_four(at(group[3]), r.next);
  r.turn();
  return r;
}
template <class Group, class At>
[[gnu::always_inline]] inline void put_records(const Group& group, FourRecords r, const At& at) {
  r.turn();
  put_four(r.of.x, at(group[0]));
  if (group.count > 1) put_four(r.of.y, at(group[1]));
  if (group.count > 2) put_four(r.of.z, at(group[2]));
  if (group.count > 3) put_four(r.next, at(group[3]));
}

/// Rounds whole numbers, given by their bits. Processors before AVX-512 have no instruction for it: each half becomes a
/// mantissa, and the sum of both rounds once.
[[gnu::always_inline]] inline Four from_whole(const Four& bits) {
  using Bits = std::uint64_t __attribute__((vector_size(32)));
  const auto whole = reinterpret_cast<Bits>(bits);
  const auto low = reinterpret_cast<Four>((whole & 0xffffffff) | 0x4330000000000000);  // 2^52 + low half
  const auto high = reinterpret_cast<Four>((whole >> 32) ^ 0x4530000080000000);        // 2^84 + 2^63 + high half
  return (high - (0x1p84 + 0x1p63 + 0x1p52)) + low;
}

/// Forces and torques on four particles, in whole units.
struct FourLoads {
  FourVectors force, torque;
};
template <class Group>
[[gnu::always_inline]] inline FourLoads get_loads(const Group& group, const Load* loads) {
  const auto round = [](const Four& bits) { return from_whole(bits); };
  const FourRecords forces = get_records(group, [&](std::size_t i) { return loads[i].force.data(); });
  const FourRecords last = get_records(group, [&](std::size_t i) { return loads[i].force.data() + 2; });
  return {each(round, forces.of), each(round, FourVectors{forces.next, last.of.z, last.next})};
}

/// Four particles in motion.
struct FourMotions {
  FourVectors v;
  Four inverse_mass;
  FourVectors w;
  Four inverse_inertia, y;  ///< y: of the place
  FourLoads load;
};

/// Two numbers in one register.
using Two = double __attribute__((vector_size(16)));
using TwoInMemory = double __attribute__((vector_size(16), aligned(8), may_alias));

}  // namespace polybed::dem
