// Many drawn scenes, what came of each, and the least case that still fails.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hard/draw.hpp"
#include "hard/hard_case.hpp"

namespace polybed::hard {

/// A case, parsed from its text and run for its time or until it has computed for `cpu` seconds, under the invariants.
[[nodiscard]] Result result_of_case(const std::string& text, const std::string& name, double cpu);

/// The same of several texts, each in a process of its own.
[[nodiscard]] std::vector<Result> results_of(const std::vector<std::string>& texts, int jobs, double cpu,
                                             const std::function<void(std::size_t, const Result&)>& seen = {});

/// The least draw that still fails: each parameter in turn goes to its standard, or by bisection of the logarithm as
/// near to it as it may, until none moves; then its numbers have two digits.
/// \param fails  whether a draw fails
[[nodiscard]] Draw shrunk(Draw draw, const std::function<bool(const Draw&)>& fails);

/// What two failures have in common if they are one mistake: the invariants, and the first line of the cause without
/// its numbers, times and sizes for most.
[[nodiscard]] std::string kind_of(const Result& result);

/// A minimal case and what came of it.
struct Found {
  std::uint64_t number = 0;  ///< of the draw
  Draw draw;
  Result result;
};

/// Writes case.toml, expected.toml and README.md into the next free folder 001, 002, ... and returns it.
std::filesystem::path keep(const Found& found, std::uint64_t seed, const std::filesystem::path& directory);

/// The cases kept in a directory, as hard cases of the catalogue, and the outcomes expected of them.
[[nodiscard]] std::vector<HardCase> kept_cases(const std::filesystem::path& directory);
[[nodiscard]] std::string kept_outcome(const std::filesystem::path& directory, const std::string& id);

}  // namespace polybed::hard
