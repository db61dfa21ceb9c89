// The program: the only place that catches, and exits.
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "multiscale/command_line/command_line.hpp"

namespace {

using namespace polybed;
using command_line::Ending;

int exit_code(core::ExitCode code) { return static_cast<int>(code); }

Ending failed(core::ExitCode code, const std::string& message) { return {exit_code(code), message}; }

Ending guarded(const std::function<core::ExitCode()>& work) {
  try {
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
  } catch (const std::system_error& error) {  // a file system or standard output
    return failed(core::ExitCode::file, error.what());
  } catch (const std::exception& error) {
    return failed(core::ExitCode::numerics, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is told like a full disk
  std::optional<command_line::MpiSession> mpi;
  Ending ending = guarded([&] { return command_line::run(argc, argv, mpi); });
  if (mpi) mpi->agree_on(ending);
  if (!ending.message.empty()) fmt::print(stderr, "{}\n", ending.message);
  return ending.code;
}
