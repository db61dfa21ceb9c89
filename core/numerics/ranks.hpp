// The processes that share a column, and their communication. A column on one process has no Ranks, and every function
// below then returns its argument.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace polybed::core {

struct Grid;

class Ranks {
 public:
  /// All processes of this program; null if there is only one. Starts MPI if it does not run yet.
  [[nodiscard]] static std::shared_ptr<const Ranks> of_program();

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] int rank() const { return rank_; }
  /// The communicator as a number, for core/numerics/mpi.hpp.
  [[nodiscard]] int handle() const { return handle_; }

 private:
  Ranks(int handle, int count, int rank) : handle_(handle), count_(count), rank_(rank) {}
  int handle_, count_, rank_;
};

/// Whether this process prints: it is the first, or the only one.
[[nodiscard]] bool is_first(const Ranks* ranks);

// Collective from here on: every rank of the column calls, and all get the same result.

/// Sum of the terms on all ranks, with the same bits on any number of ranks.
[[nodiscard]] double sum_of_ranks(const Ranks* ranks, std::span<const double> terms);
[[nodiscard]] double sum_of_ranks(const Grid& grid, std::span<const double> terms);
/// Sum, greatest and least of one number per rank.
[[nodiscard]] double sum_of_ranks(const Grid& grid, double value);
[[nodiscard]] double greatest_of_ranks(const Grid& grid, double value);
[[nodiscard]] double least_of_ranks(const Grid& grid, double value);
[[nodiscard]] double greatest_of_ranks(const Ranks* ranks, double value);
/// Sums entry by entry, in place.
void add_over_ranks(const Ranks* ranks, std::span<std::int64_t> values);
void add_over_ranks(const Ranks* ranks, std::span<double> values);
/// Likewise the greatest of each entry.
void greatest_over_ranks(const Ranks* ranks, std::span<double> values);
void add_over_ranks(const Grid& grid, std::span<double> values);
/// Whether a condition is true on every rank.
[[nodiscard]] bool on_all_ranks(const Grid& grid, bool holds);
/// Whether a condition is true on any rank.
[[nodiscard]] bool on_any_rank(const Ranks* ranks, bool holds);
/// The lowest rank that has the greatest value.
[[nodiscard]] int rank_of_greatest(const Grid& grid, double value);
[[nodiscard]] int rank_of_greatest(const Ranks* ranks, double value);
/// The text of one rank, on all ranks.
[[nodiscard]] std::string said_by(const Grid& grid, int rank, const std::string& text);
[[nodiscard]] std::string said_by(const Ranks* ranks, int rank, const std::string& text);
/// Copies numbers from the first rank to all; all pass the same length.
void take_from_first(const Ranks* ranks, std::span<double> values);

/// Runs work on files on the first rank for all. Its FileError, NumericsError or CaseError is thrown on every rank, so
/// that no rank waits for a failed one.
void on_first(const Ranks* ranks, const std::function<void()>& work);

/// Runs work on every rank and throws the error of the lowest failed rank on every rank. The work can contain one
/// collective call at its end, but none that a rank could miss by failing before it.
void on_all(const Ranks* ranks, const std::function<void()>& work);

}  // namespace polybed::core
