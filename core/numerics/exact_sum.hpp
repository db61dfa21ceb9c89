// Sums with the same bits for any order of the terms and any number of ranks. Each term is split into two parts, each a
// whole multiple of a unit so large that additions are exact (Rump, Ogita and Oishi, SIAM J. Sci. Comput. 31 (2008)
// 189, algorithm 3.2).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

#include "core/numerics/mpi.hpp"
#include "core/vectors.hpp"

namespace polybed::core {

namespace exact {

constexpr std::size_t lanes = 4;  ///< of AVX2: g++ 12 compares lane by lane what fills more than one register
using Lanes = double __attribute__((vector_size(lanes * sizeof(double))));

[[gnu::always_inline]] inline Lanes lanes_of(const double* from) {
  Lanes values;
  std::memcpy(&values, from, sizeof values);
  return values;
}

[[gnu::always_inline]] inline Lanes magnitude(const Lanes& values) {
  using Bits = std::int64_t __attribute__((vector_size(lanes * sizeof(std::int64_t))));
  return std::bit_cast<Lanes>(std::bit_cast<Bits>(values) & std::numeric_limits<std::int64_t>::max());
}

// The terms, computed from the entries of one, two or three arrays. The second part is left out where the first has
// enough digits, as for the search directions of an iteration.
struct Itself {
  static constexpr bool both_parts = true;
  [[gnu::always_inline]] static Lanes of(const Lanes& x) { return x; }
};
struct Product {
  static constexpr bool both_parts = false;
  [[gnu::always_inline]] static Lanes of(const Lanes& x, const Lanes& y) { return x * y; }
};
struct WeightedSquare {
  static constexpr bool both_parts = true;
  [[gnu::always_inline]] static Lanes of(const Lanes& x, const Lanes& w) { return (x * w) * (x * w); }
};
/// The square where the mask is 1, else 0.
struct MaskedSquare {
  static constexpr bool both_parts = true;
  [[gnu::always_inline]] static Lanes of(const Lanes& x, const Lanes& w, const Lanes& mask) {
    return mask * ((x * w) * (x * w));
  }
};

/// Independent accumulators: one alone waits for the latency of each operation.
constexpr std::size_t chains = 4;

/// Calls act with the terms, some at a time, and the accumulator to which they belong; zeros fill up the last call.
template <class Term, class Act, class... Array>
[[gnu::always_inline]] inline void for_all(std::size_t n, Act&& act, const Array*... array) {
  std::size_t i = 0;
  for (; i + chains * lanes <= n; i += chains * lanes) {
#pragma GCC unroll 4
    for (std::size_t c = 0; c < chains; ++c) act(c, Term::of(lanes_of(array + i + c * lanes)...));
  }
  for (; i + lanes <= n; i += lanes) act(0, Term::of(lanes_of(array + i)...));
  if (i == n) return;
  const auto rest = [&](const double* from) {
    std::array<double, lanes> padded{};
    std::copy_n(from + i, n - i, padded.begin());
    return lanes_of(padded.data());
  };
  act(0, Term::of(rest(array)...));
}

/// The greatest magnitude; NaN is ignored.
template <class Term, class... Array>
double greatest_of(std::size_t n, const Array*... array) {
  std::array<Lanes, chains> most{};
  for_all<Term>(
      n,
      [&](std::size_t c, const Lanes& term) {
        const Lanes size = magnitude(term);
        most[c] = size > most[c] ? size : most[c];
      },
      array...);
  double greatest = 0;
  for (const Lanes& of_chain : most)
    for (std::size_t k = 0; k < lanes; ++k) greatest = std::max(greatest, of_chain[k]);
  return greatest;
}

/// Sums of the two parts of the terms: each term rounded to the last place of `first`, and the rest rounded to the last
/// place of `second`. Both numbers are 1.5 times a power of 2.
template <class Term, class... Array>
std::array<double, 2> parts_of(std::size_t n, double first, double second, const Array*... array) {
  std::array<Lanes, chains> of_first{}, of_second{};
  for_all<Term>(
      n,
      [&](std::size_t c, const Lanes& term) {
        const Lanes part = (first + term) - first;
        of_first[c] += part;
        if constexpr (Term::both_parts) of_second[c] += (second + (term - part)) - second;
      },
      array...);
  std::array<double, 2> sums{};
  for (std::size_t c = 0; c < chains; ++c)
    for (std::size_t k = 0; k < lanes; ++k) {
      sums[0] += of_first[c][k];
      sums[1] += of_second[c][k];
    }
  return sums;
}

}  // namespace exact

/// Sum over the processes of a communicator. Term, one of the structs above, computes a term from entries of the
/// arrays. For a million terms the first part has 31 binary digits below the greatest term, both parts together 63.
/// Returns NaN if a term is NaN or infinite. Collective.
/// \param of_all  upper bound on the terms of all processes, at most 2^24, the same on all  \param n  terms here
template <class Term, class... Array>
[[nodiscard]] double exact_sum(MPI_Comm all, std::size_t of_all, std::size_t n, const Array*... array) {
  const auto reduce = [all](std::span<double> values, MPI_Op operation) {
    if (all != MPI_COMM_SELF)
      check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, operation, all),
                "MPI_Allreduce");
  };
  double greatest = in_vectors<&exact::greatest_of<Term, Array...>>(n, array...);
  reduce(std::span(&greatest, 1), MPI_MAX);
  if (std::isinf(greatest)) return std::numeric_limits<double>::quiet_NaN();
  constexpr int digits = std::numeric_limits<double>::digits;
  const int carries = int(std::bit_width(of_all)) + 1, above = greatest > 0 ? std::ilogb(greatest) + 1 : -digits;
  const double first = std::ldexp(1.5, above + carries), second = std::ldexp(1.5, above + 2 * carries - digits);
  std::array<double, 2> sums = in_vectors<&exact::parts_of<Term, Array...>>(n, first, second, array...);
  reduce(sums, MPI_SUM);
  return sums[0] + sums[1];
}

}  // namespace polybed::core
