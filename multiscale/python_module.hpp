// Starts a module of the Python package next to the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace polybed::multiscale {

/// Result of a module.
struct PythonEnd {
  int code = 0;             ///< its exit code, or 128 plus the number of the signal that ended it
  std::string output;       ///< its output, if stored
  std::string not_started;  ///< why it did not start; empty if it started
};

enum class PythonOutput { keep, show };

/// Runs a module of the package with Debian's Python, as `python3 -m module arguments...` would, and waits for its end.
/// Python is isolated: it imports nothing from the working directory and PYTHONPATH. Throws nothing.
/// \param output  keep: standard output and error go into PythonEnd::output; show: to this process's own
[[nodiscard]] PythonEnd run_python(const std::string& module, const std::vector<std::string>& arguments,
                                   PythonOutput output);

/// Becomes a module of the package: the study for a command that is written in Python. The module finds this program
/// through POLYBED in the environment. Throws core::FileError if Python cannot be started.
[[noreturn]] void become_python(const std::string& module, const std::vector<std::string>& arguments);

/// The line that installs the package's requirements.
constexpr const char* python_packages =
    "apt-get install python3 python3-numpy python3-h5py python3-matplotlib python3-scipy";

/// Pictures and pages of a command's results: passes a folder to a module of the Python package, with the words
/// `OPTIONS -- directory`. Prints and throws nothing: the folder is complete without its picture.
/// \param message  its last line, the picture's path; or, if it returns false, why there is no picture (Python or a
/// package is missing, nothing stored yet)
[[nodiscard]] bool draw(const std::string& module, const std::filesystem::path& directory, std::string& message,
                        std::vector<std::string> options = {});

/// Draws picture.png and makes report.html in a run directory, finished or running, likewise.
[[nodiscard]] bool draw_picture(const std::filesystem::path& run_directory, std::string& message);

}  // namespace polybed::multiscale
