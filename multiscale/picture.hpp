// The picture of a run, drawn by the Python package.
#pragma once

#include <filesystem>
#include <string>

namespace polybed::multiscale {

/// Draws picture.png into a run directory, finished or running. Nothing is printed and nothing thrown: a run
/// is complete without its picture.
/// \param message  where the picture is; or, if false is returned, why there is none (Python or a package of
///                 it missing, nothing stored yet)
[[nodiscard]] bool draw_picture(const std::filesystem::path& run_directory, std::string& message);

}  // namespace polybed::multiscale
