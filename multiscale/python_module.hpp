// Starts a module of the Python package that stands beside the program.
#pragma once

#include <filesystem>
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
constexpr const char* python_packages =
    "apt-get install python3 python3-numpy python3-h5py python3-matplotlib python3-scipy";

/// Pictures and pages that the package makes of what a command has written: hands a folder over to a module of the
/// Python package, with the words `OPTIONS -- directory`. Nothing is printed and nothing thrown: what lies in the
/// folder is complete without its picture.
/// \param message  the last line it says, where the picture is; or, if false is returned, why there is none (Python or a
///                 package of it missing, nothing stored yet)
[[nodiscard]] bool draw(const std::string& module, const std::filesystem::path& directory, std::string& message,
                        std::vector<std::string> options = {});

/// Draws picture.png and makes report.html in a run directory, finished or running, likewise.
[[nodiscard]] bool draw_picture(const std::filesystem::path& run_directory, std::string& message);

}  // namespace polybed::multiscale
