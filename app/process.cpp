#include "app/process.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <new>
#include <system_error>

#include "core/search_path.hpp"

namespace polybed::app {

namespace {

int exit_code(core::ExitCode code) { return static_cast<int>(code); }

Ending failed(core::ExitCode code, const std::string& message) { return {exit_code(code), message}; }

/// Opens a file for closed standard streams; otherwise the next opened file would replace one and receive the messages.
/// An answer that cannot be written there is reported as an error.
void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace

Ending guarded(const std::function<core::ExitCode()>& work) {
  open_closed_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // report a limit on file sizes like a full disk
  std::signal(SIGPIPE, SIG_IGN);  // likewise for a closed reader
  try {
    core::search_absolute_path();
    return {exit_code(work()), ""};
  } catch (const core::CaseError& error) {
    return failed(core::ExitCode::wrong_case, error.what());
  } catch (const core::NumericsError& error) {
    return failed(core::ExitCode::numerics, error.what());
  } catch (const core::FileError& error) {
    return failed(core::ExitCode::file, error.what());
  } catch (const core::MpiError& error) {
    return failed(core::ExitCode::mpi, error.what());
  } catch (const core::Stopped& error) {
    return failed(core::ExitCode::stopped, error.what());
  } catch (const std::bad_alloc&) {
    return failed(core::ExitCode::wrong_case, "not enough memory: choose fewer column.cells");
  } catch (const std::system_error& error) {  // from a file system or standard output
    return failed(core::ExitCode::file, error.what());
  } catch (const std::exception& error) {
    return failed(core::ExitCode::numerics, error.what());
  }
}

}  // namespace polybed::app
