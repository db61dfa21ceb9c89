// Another program in the place of this one.
#pragma once

#include <string>
#include <vector>

namespace polybed::multiscale {

/// This process's environment, NAME=VALUE.
[[nodiscard]] std::vector<std::string> environment();

/// Texts as exec wants them: their places, and a null behind.
[[nodiscard]] std::vector<char*> pointers_to(std::vector<std::string>& texts);

/// Goes on as another program. Returns only if it cannot be started: why not.
/// \param words  its path and its arguments
[[nodiscard]] std::string become(std::vector<std::string> words, std::vector<std::string> variables = environment());

}  // namespace polybed::multiscale
