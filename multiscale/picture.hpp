// Pictures and pages that the Python package makes of what a command has written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace polybed::multiscale {

/// Hands a folder over to a module of the Python package, with the words `OPTIONS -- directory`. Nothing is printed and
/// nothing thrown: what lies in the folder is complete without its picture.
/// \param message  the last line it says, where the picture is; or, if false is returned, why there is none (Python or a
///                 package of it missing, nothing stored yet)
[[nodiscard]] bool draw(const std::string& module, const std::filesystem::path& directory, std::string& message,
                        std::vector<std::string> options = {});

/// Draws picture.png and makes report.html in a run directory, finished or running, likewise.
[[nodiscard]] bool draw_picture(const std::filesystem::path& run_directory, std::string& message);

}  // namespace polybed::multiscale
