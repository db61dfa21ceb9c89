// The program: the only place that exits.
#include <optional>

#include "app/command_line.hpp"
#include "app/process.hpp"
#include "core/print.hpp"

using namespace polybed;

int main(int argc, char** argv) {
  std::optional<app::MpiSession> mpi;
  app::Ending ending = app::guarded([&] { return app::run(argc, argv, mpi); });
  if (mpi) mpi->agree_on(ending);
  if (!ending.message.empty()) core::print(stderr, "{}\n", ending.message);
  return ending.code;
}
