// MPI around what needs it, and how ranks end together.
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "app/process.hpp"
#include "core/numerics/mpi_start.hpp"
#include "core/print.hpp"

namespace polybed::app {

class MpiSession {
 public:
  MpiSession() {
    core::open_mpi();
    MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  }
  ~MpiSession() { core::close_mpi(); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  [[nodiscard]] bool first() const { return rank_ == 0; }

  /// An error that all ranks have met is told once. One that the others do not know of would leave them waiting for
  /// ever: after some seconds it is told by the rank that met it, which ends them all.
  void agree_on(Ending& ending) const {
    if (ranks_ == 1 || ending.code == 0) return;
    MPI_Request all_here = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &all_here);
    for (int tenths = 0, done = 0; tenths < 50; ++tenths) {
      MPI_Test(&all_here, &done, MPI_STATUS_IGNORE);
      if (done != 0) {
        if (!first()) ending.message.clear();
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    core::print(stderr, "rank {}: {}\n", rank_, ending.message);
    MPI_Abort(MPI_COMM_WORLD, ending.code);
  }

 private:
  int ranks_ = 1, rank_ = 0;
};

}  // namespace polybed::app
