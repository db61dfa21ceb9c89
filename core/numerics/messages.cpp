#include "core/numerics/messages.hpp"

#include <algorithm>
#include <numeric>

#include "core/numerics/mpi.hpp"

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
  constexpr std::size_t longest = std::size_t(1) << 30;  // MPI counts bytes in an int: longer messages are split
  for (std::size_t r = 0; r < to_.size(); ++r)
    for (std::size_t left = std::size_t(from_[r]) * size; left > 0;) {
      const std::size_t bytes = std::min(left, longest);
      check_mpi(
          MPI_Irecv(in, int(bytes), MPI_BYTE, int(r), tag, communicator(ranks_.get()), &requests_->open.emplace_back()),
          "MPI_Irecv");
      in += bytes;
      left -= bytes;
    }
  for (std::size_t r = 0; r < to_.size(); ++r)
    for (std::size_t left = std::size_t(to_[r]) * size; left > 0;) {
      const std::size_t bytes = std::min(left, longest);
      check_mpi(MPI_Isend(out, int(bytes), MPI_BYTE, int(r), tag, communicator(ranks_.get()),
                          &requests_->open.emplace_back()),
                "MPI_Isend");
      out += bytes;
      left -= bytes;
    }
}

void Messages::finish() {
  check_mpi(MPI_Waitall(int(requests_->open.size()), requests_->open.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
  requests_->open.clear();
}

}  // namespace polybed::core
