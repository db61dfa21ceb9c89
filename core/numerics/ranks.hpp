// The processes that share a column, and what they tell each other. A column on one process has no Ranks at all, and
// every function below then returns what it is given.
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
  /// All processes of this program; null if it is one. Starts MPI if nobody has.
  [[nodiscard]] static std::shared_ptr<const Ranks> of_program();

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] int rank() const { return rank_; }
  /// The communicator as a number, for core/numerics/mpi.hpp.
  [[nodiscard]] int handle() const { return handle_; }

 private:
  Ranks(int handle, int count, int rank) : handle_(handle), count_(count), rank_(rank) {}
  int handle_, count_, rank_;
};

/// Whether this process is the one that speaks: the first, or the only one.
[[nodiscard]] bool is_first(const Ranks* ranks);

// Collective from here on: every rank of the column calls, and all get the same answer.

/// Sum of terms of all ranks, with the same bits on any number of them.
[[nodiscard]] double sum_of_ranks(const Ranks* ranks, std::span<const double> terms);
[[nodiscard]] double sum_of_ranks(const Grid& grid, std::span<const double> terms);
/// Sum, greatest and least of one number of each rank.
[[nodiscard]] double sum_of_ranks(const Grid& grid, double value);
[[nodiscard]] double greatest_of_ranks(const Grid& grid, double value);
[[nodiscard]] double least_of_ranks(const Grid& grid, double value);
[[nodiscard]] double greatest_of_ranks(const Ranks* ranks, double value);
/// Sums, entry by entry, in place.
void add_over_ranks(const Ranks* ranks, std::span<std::int64_t> values);
void add_over_ranks(const Ranks* ranks, std::span<double> values);
void add_over_ranks(const Grid& grid, std::span<double> values);
/// Whether something holds on every rank.
[[nodiscard]] bool on_all_ranks(const Grid& grid, bool holds);
/// Whether something holds on any rank.
[[nodiscard]] bool on_any_rank(const Ranks* ranks, bool holds);
/// The lowest rank with the greatest value.
[[nodiscard]] int rank_of_greatest(const Grid& grid, double value);
[[nodiscard]] int rank_of_greatest(const Ranks* ranks, double value);
/// What a rank says.
[[nodiscard]] std::string said_by(const Grid& grid, int rank, const std::string& text);
[[nodiscard]] std::string said_by(const Ranks* ranks, int rank, const std::string& text);
/// Numbers of the first rank for all; all give the same length.
void take_from_first(const Ranks* ranks, std::span<double> values);

/// Work that the first rank does for all, on files: its FileError, NumericsError or CaseError is thrown on every rank,
/// so that none waits for one that has given up.
void on_first(const Ranks* ranks, const std::function<void()>& work);

/// Work that every rank does for itself: what the lowest rank that failed has thrown is thrown on every rank. The work
/// may hold one collective call at its end, but none that a rank can miss by failing before it.
void on_all(const Ranks* ranks, const std::function<void()>& work);

}  // namespace polybed::core
