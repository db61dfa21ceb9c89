// Sums that have the same bits in whatever order their terms come and on however many ranks they lie: each term is cut
// into two parts, each a whole number of a unit so large that adding them rounds nothing (Rump, Ogita and Oishi, SIAM
// J. Sci. Comput. 31 (2008) 189, algorithm 3.2).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "core/numerics/mpi.hpp"
#include "core/vectors.hpp"

namespace polybed::core {

namespace exact {

constexpr std::size_t block = 1024;  ///< terms that are made at a time; they stay in the nearest cache
constexpr std::size_t lanes = 8;

/// The greatest magnitude; of no number it takes no notice.
inline double greatest_of(const double* term, std::size_t n) {
  std::array<double, lanes> most{};
  for (std::size_t i = 0; i < n; ++i) most[i % lanes] = std::max(most[i % lanes], std::abs(term[i]));
  return *std::max_element(most.begin(), most.end());
}

/// Adds what each term leaves on the grid of the first number, and what the rest leaves on that of the second, which
/// are 1.5 times a power of 2.
inline void add_parts_of(const double* term, std::size_t n, double first, double second, double* sums) {
  std::array<double, lanes> of_first{}, of_second{};
  const auto add = [&](std::size_t i, std::size_t k) {
    const double part = (first + term[i]) - first, rest = term[i] - part;
    of_first[k] += part;
    of_second[k] += (second + rest) - second;
  };
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) add(i + k, k);
  for (; i < n; ++i) add(i, 0);
  for (std::size_t k = 0; k < lanes; ++k) {
    sums[0] += of_first[k];
    sums[1] += of_second[k];
  }
}

}  // namespace exact

/// Sum of terms over the processes of a communicator; wrong by less than 2^-45 of the greatest for a million terms. Not
/// a number if a term is none or infinite. Collective.
/// \param of_all  an upper bound of the number of terms on all processes, at most 2^24, the same on all
/// \param count   terms here  \param make  writes the terms [begin, begin + n) to an array: make(begin, n, array); twice
template <class Make>
[[nodiscard]] double exact_sum(MPI_Comm all, std::size_t of_all, std::size_t count, Make&& make) {
  std::array<double, exact::block> terms;
  const auto in_blocks = [&](auto&& body) {
    for (std::size_t begin = 0; begin < count; begin += exact::block) {
      const std::size_t n = std::min(exact::block, count - begin);
      make(begin, n, terms.data());
      body(n);
    }
  };
  const auto reduce = [all](std::span<double> values, MPI_Op operation) {
    if (all != MPI_COMM_SELF)
      check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, operation, all),
                "MPI_Allreduce");
  };
  double greatest = 0;
  in_blocks([&](std::size_t n) { greatest = std::max(greatest, in_vectors<exact::greatest_of>(terms.data(), n)); });
  reduce(std::span(&greatest, 1), MPI_MAX);
  if (std::isinf(greatest)) return std::numeric_limits<double>::quiet_NaN();
  constexpr int digits = std::numeric_limits<double>::digits;
  const int carries = int(std::bit_width(of_all)) + 1, above = greatest > 0 ? std::ilogb(greatest) + 1 : -digits;
  const double first = std::ldexp(1.5, above + carries), second = std::ldexp(1.5, above + 2 * carries - digits);
  std::array<double, 2> sums{};
  in_blocks([&](std::size_t n) { in_vectors<exact::add_parts_of>(terms.data(), n, first, second, sums.data()); });
  reduce(sums, MPI_SUM);
  return sums[0] + sums[1];
}

}  // namespace polybed::core
