// The scenes that verification tests of particles start from, and how they compare.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../unit/core/scratch.hpp"
#include "scenes/beads.hpp"

namespace polybed::scenes {

/// Checks a number against its closed form and keeps both for docs/record/verification-particles.md
/// (--gtest_output=xml:FILE).
/// \param scale  that the tolerance is a share of
inline void compare(const std::string& what, double obtained, double expected, double tolerance, double scale) {
  testing::Test::RecordProperty(what, fmt::format("{:.8g} expected {:.8g} error {:.2g} allowed {:.2g}", obtained,
                                                  expected, std::abs(obtained - expected) / scale, tolerance));
  EXPECT_NEAR(obtained, expected, tolerance * scale) << what;
}
inline void compare(const std::string& what, double obtained, double expected, double tolerance) {
  compare(what, obtained, expected, tolerance, std::abs(expected));
}

}  // namespace polybed::scenes
