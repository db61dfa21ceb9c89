// Scenes of columns, and what a test keeps of a finished run.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "measures/invariants.hpp"
#include "scenes/beds.hpp"

namespace polybed::scenes {

/// Keeps a figure in the test's report (--gtest_output=json:FILE), for the page on verification.
inline void record(const std::string& name, double value) {
  testing::Test::RecordProperty(name, fmt::format("{:.4g}", value));
}

}  // namespace polybed::scenes
