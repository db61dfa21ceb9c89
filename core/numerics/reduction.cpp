#include "core/numerics/reduction.hpp"

#include <algorithm>

#include "core/numerics/mpi.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::core {

namespace {

template <class Number>
void join(MPI_Comm all, const std::vector<std::span<Number>>& places, MPI_Datatype type, MPI_Op operation) {
  std::vector<Number> values;
  for (const std::span<Number>& place : places) values.insert(values.end(), place.begin(), place.end());
  if (values.empty()) return;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), type, operation, all), "MPI_Allreduce");
  auto next = values.begin();
  for (const std::span<Number>& place : places) {
    std::copy_n(next, place.size(), place.begin());
    next += std::ptrdiff_t(place.size());
  }
}

}  // namespace

void Reduction::over(const Ranks* ranks) const {
  if (ranks == nullptr) return;
  join(communicator(ranks), greatest_, MPI_DOUBLE, MPI_MAX);
  join(communicator(ranks), sums_, MPI_DOUBLE, MPI_SUM);
  join(communicator(ranks), counts_, MPI_INT64_T, MPI_SUM);
}

}  // namespace polybed::core
