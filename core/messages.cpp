#include "core/messages.hpp"

#include <numeric>

#include "core/mpi.hpp"

namespace polybed::core {

struct Messages::Requests {
  std::vector<MPI_Request> open;
};

Messages::Messages(std::shared_ptr<const Ranks> ranks, std::vector<int> to)
    : ranks_(std::move(ranks)), to_(std::move(to)), from_(to_.size(), 0), requests_(std::make_unique<Requests>()) {
  if (!ranks_) return;
  check_mpi(MPI_Alltoall(to_.data(), 1, MPI_INT, from_.data(), 1, MPI_INT, communicator(ranks_.get())), "MPI_Alltoall");
  incoming_ = std::accumulate(from_.begin(), from_.end(), std::size_t(0));
}

Messages::~Messages() = default;

void Messages::start_bytes(const std::byte* out, std::byte* in, std::size_t size) {
  constexpr int tag = 17;
  for (std::size_t r = 0; r < to_.size(); ++r) {
    if (from_[r] > 0) {
      const int bytes = int(std::size_t(from_[r]) * size);
      check_mpi(
          MPI_Irecv(in, bytes, MPI_BYTE, int(r), tag, communicator(ranks_.get()), &requests_->open.emplace_back()),
          "MPI_Irecv");
      in += bytes;
    }
  }
  for (std::size_t r = 0; r < to_.size(); ++r) {
    if (to_[r] > 0) {
      const int bytes = int(std::size_t(to_[r]) * size);
      check_mpi(
          MPI_Isend(out, bytes, MPI_BYTE, int(r), tag, communicator(ranks_.get()), &requests_->open.emplace_back()),
          "MPI_Isend");
      out += bytes;
    }
  }
}

void Messages::finish() {
  check_mpi(MPI_Waitall(int(requests_->open.size()), requests_->open.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
  requests_->open.clear();
}

}  // namespace polybed::core
