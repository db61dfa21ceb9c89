// The scenes that verification tests start from, and what they keep of a finished run.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "fluid/invariants.hpp"
#include "multiscale/stability/problems/beds.hpp"

namespace polybed::verification {

/// Keeps a figure in the test's report (--gtest_output=json:FILE), for the page on verification.
inline void record(const std::string& name, double value) {
  testing::Test::RecordProperty(name, fmt::format("{:.4g}", value));
}

}  // namespace polybed::verification
