// The program: the only place that exits.
#include <optional>

#include "core/print.hpp"
#include "multiscale/command_line/command_line.hpp"
#include "multiscale/command_line/process.hpp"

using namespace polybed;

int main(int argc, char** argv) {
  std::optional<command_line::MpiSession> mpi;
  command_line::Ending ending = command_line::guarded([&] { return command_line::run(argc, argv, mpi); });
  if (mpi) mpi->agree_on(ending);
  if (!ending.message.empty()) core::print(stderr, "{}\n", ending.message);
  return ending.code;
}
