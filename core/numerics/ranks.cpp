#include "core/numerics/ranks.hpp"

#include <exception>
#include <new>

#include "core/error.hpp"
#include "core/numerics/exact_sum.hpp"
#include "core/numerics/mpi.hpp"
#include "core/numerics/mpi_start.hpp"

namespace polybed::core {

std::shared_ptr<const Ranks> Ranks::of_program() {
  open_mpi();
  int count = 1, rank = 0;
  check_mpi(MPI_Comm_size(MPI_COMM_WORLD, &count), "MPI_Comm_size");
  check_mpi(MPI_Comm_rank(MPI_COMM_WORLD, &rank), "MPI_Comm_rank");
  if (count == 1) return nullptr;
  return std::shared_ptr<const Ranks>(new Ranks(MPI_Comm_c2f(MPI_COMM_WORLD), count, rank));
}

bool is_first(const Ranks* ranks) { return ranks == nullptr || ranks->rank() == 0; }

namespace {

double reduced(const Grid& grid, double value, MPI_Op operation) {
  if (!grid.ranks) return value;
  double result = 0;
  check_mpi(MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, operation, communicator(grid)), "MPI_Allreduce");
  return result;
}

}  // namespace

double sum_of_ranks(const Ranks* ranks, std::span<const double> terms) {
  std::int64_t count = std::int64_t(terms.size());
  add_over_ranks(ranks, std::span(&count, 1));
  return exact_sum<exact::Itself>(communicator(ranks), std::size_t(count), terms.size(), terms.data());
}
double sum_of_ranks(const Grid& grid, std::span<const double> terms) { return sum_of_ranks(grid.ranks.get(), terms); }
double sum_of_ranks(const Grid& grid, double value) { return reduced(grid, value, MPI_SUM); }
double greatest_of_ranks(const Grid& grid, double value) { return reduced(grid, value, MPI_MAX); }
double least_of_ranks(const Grid& grid, double value) { return reduced(grid, value, MPI_MIN); }
bool on_all_ranks(const Grid& grid, bool holds) { return reduced(grid, holds ? 1 : 0, MPI_MIN) > 0; }

bool on_any_rank(const Ranks* ranks, bool holds) {
  if (ranks == nullptr) return holds;
  int here = holds ? 1 : 0, anywhere = 0;
  check_mpi(MPI_Allreduce(&here, &anywhere, 1, MPI_INT, MPI_MAX, communicator(ranks)), "MPI_Allreduce");
  return anywhere != 0;
}

void add_over_ranks(const Ranks* ranks, std::span<double> values) {
  if (ranks == nullptr) return;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, MPI_SUM, communicator(ranks)),
            "MPI_Allreduce");
}

void add_over_ranks(const Ranks* ranks, std::span<std::int64_t> values) {
  if (ranks == nullptr) return;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_INT64_T, MPI_SUM, communicator(ranks)),
            "MPI_Allreduce");
}

void greatest_over_ranks(const Ranks* ranks, std::span<double> values) {
  if (ranks == nullptr) return;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, MPI_MAX, communicator(ranks)),
            "MPI_Allreduce");
}

double greatest_of_ranks(const Ranks* ranks, double value) {
  double greatest = value;
  if (ranks != nullptr)
    check_mpi(MPI_Allreduce(&value, &greatest, 1, MPI_DOUBLE, MPI_MAX, communicator(ranks)), "MPI_Allreduce");
  return greatest;
}

void add_over_ranks(const Grid& grid, std::span<double> values) { add_over_ranks(grid.ranks.get(), values); }

int rank_of_greatest(const Ranks* ranks, double value) {
  if (ranks == nullptr) return 0;
  struct {
    double value;
    int rank;
  } here{value, ranks->rank()}, result{};
  check_mpi(MPI_Allreduce(&here, &result, 1, MPI_DOUBLE_INT, MPI_MAXLOC, communicator(ranks)), "MPI_Allreduce");
  return result.rank;
}
int rank_of_greatest(const Grid& grid, double value) { return rank_of_greatest(grid.ranks.get(), value); }

namespace {

std::string broadcast(MPI_Comm all, int from, int rank, const std::string& text) {
  int length = int(text.size());
  check_mpi(MPI_Bcast(&length, 1, MPI_INT, from, all), "MPI_Bcast");
  std::string result = rank == from ? text : std::string(std::size_t(length), ' ');
  check_mpi(MPI_Bcast(result.data(), length, MPI_CHAR, from, all), "MPI_Bcast");
  return result;
}

}  // namespace

std::string said_by(const Ranks* ranks, int rank, const std::string& text) {
  return ranks != nullptr ? broadcast(communicator(ranks), rank, ranks->rank(), text) : text;
}
std::string said_by(const Grid& grid, int rank, const std::string& text) {
  return said_by(grid.ranks.get(), rank, text);
}

void take_from_first(const Ranks* ranks, std::span<double> values) {
  if (ranks == nullptr) return;
  check_mpi(MPI_Bcast(values.data(), int(values.size()), MPI_DOUBLE, 0, communicator(ranks)), "MPI_Bcast");
}

namespace {

/// The outcome of work, in a form that can be sent to another rank.
struct Ending {
  enum Outcome : int { fine, file, numerics, wrong_case, memory, stopped };
  int outcome = fine;
  std::string message;
};

Ending ending_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const NumericsError& error) {
    return {Ending::numerics, error.what()};
  } catch (const CaseError& error) {
    return {Ending::wrong_case, error.what()};
  } catch (const Stopped& error) {
    return {Ending::stopped, error.what()};
  } catch (const std::bad_alloc& error) {
    return {Ending::memory, error.what()};
  } catch (const std::exception& error) {
    return {Ending::file, error.what()};
  }
  return {};
}

/// Throws the error of one rank on every rank.
void share(const Ranks& ranks, int from, Ending ending) {
  check_mpi(MPI_Bcast(&ending.outcome, 1, MPI_INT, from, communicator(&ranks)), "MPI_Bcast");
  if (ending.outcome == Ending::fine) return;
  const std::string message = broadcast(communicator(&ranks), from, ranks.rank(), ending.message);
  if (ending.outcome == Ending::numerics) throw NumericsError(message);
  if (ending.outcome == Ending::wrong_case) throw CaseError(message);
  if (ending.outcome == Ending::stopped) throw Stopped(message);
  if (ending.outcome == Ending::memory) throw std::bad_alloc();
  throw FileError(message);
}

}  // namespace

void on_first(const Ranks* ranks, const std::function<void()>& work) {
  if (ranks == nullptr) return work();
  share(*ranks, 0, is_first(ranks) ? ending_of(work) : Ending{});
}

void on_all(const Ranks* ranks, const std::function<void()>& work) {
  if (ranks == nullptr) return work();
  const Ending ending = ending_of(work);
  int mine = ending.outcome == Ending::fine ? ranks->count() : ranks->rank(), lowest = 0;
  check_mpi(MPI_Allreduce(&mine, &lowest, 1, MPI_INT, MPI_MIN, communicator(ranks)), "MPI_Allreduce");
  if (lowest < ranks->count()) share(*ranks, lowest, ending);
}

}  // namespace polybed::core
