// The commands of the program as the command line has them.
#pragma once

#include <optional>

#include "app/mpi_session.hpp"
#include "core/error.hpp"

namespace polybed::app {

/// Does what the command line asks for and returns the code to end with; throws what the command throws. A line that
/// cannot be read is told on standard error and is core::ExitCode::wrong_case.
/// \param mpi  started if the command needs it
core::ExitCode run(int argc, char** argv, std::optional<MpiSession>& mpi);

}  // namespace polybed::app
