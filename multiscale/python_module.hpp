// Starts a module of the Python package that stands beside the program.
#pragma once

#include <string>
#include <vector>

namespace polybed::multiscale {

/// How a module ended.
struct PythonEnd {
  int code = 0;             ///< its exit code; 128 and the number of the signal if one ended it
  std::string output;       ///< what it printed, if that was kept
  std::string not_started;  ///< why it did not start; empty if it did
};

enum class PythonOutput { keep, show };

/// Runs a module of the package with Debian's Python, as `python3 -m module arguments...` would, and waits for its end.
/// Python is isolated: nothing of the working directory and of PYTHONPATH is imported. Nothing is thrown.
/// \param output  keep: standard output and error go into PythonEnd::output; show: they are those of this process
[[nodiscard]] PythonEnd run_python(const std::string& module, const std::vector<std::string>& arguments,
                                   PythonOutput output);

/// Becomes a module of the package: the study of a command that is written in Python. The module finds this program in
/// the environment's POLYBED. Throws core::FileError if Python cannot be started.
[[noreturn]] void become_python(const std::string& module, const std::vector<std::string>& arguments);

/// The line that installs what the package needs.
constexpr const char* python_packages = "apt-get install python3 python3-numpy python3-h5py python3-matplotlib";

}  // namespace polybed::multiscale
