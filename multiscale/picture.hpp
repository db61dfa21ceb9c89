// Pictures of a run, drawn by the Python package.
#pragma once

#include <filesystem>
#include <string>

namespace polybed::multiscale {

/// Draws picture.png in a run directory; false, with the reason, if Python or a package is missing or fails.
[[nodiscard]] bool draw_picture(const std::filesystem::path& run_directory, std::string& message);

}  // namespace polybed::multiscale
