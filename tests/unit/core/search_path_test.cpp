#include "core/search_path.hpp"

#include <gtest/gtest.h>

namespace polybed::core {
namespace {

TEST(SearchPath, KeepsTheAbsoluteEntriesInTheirOrder) {
  EXPECT_EQ(absolute_entries("/usr/local/bin:/usr/bin:/bin"), "/usr/local/bin:/usr/bin:/bin");
  EXPECT_EQ(absolute_entries(":.:/usr/bin:bin:../bin::/bin:"), "/usr/bin:/bin");
}

TEST(SearchPath, IsNeverEmpty) {
  for (const char* path : {"", ":", ".", ".:bin", "::"}) EXPECT_EQ(absolute_entries(path), "/usr/bin:/bin") << path;
}

}  // namespace
}  // namespace polybed::core
