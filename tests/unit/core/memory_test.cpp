#include "core/memory.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace polybed::core {
namespace {

TEST(Memory, NumbersAreReadByTheirName) {
  const char* text = "MemTotal:       16384 kB\nMemAvailable:    8 kB\ninactive_file 77\nlast:\n";
  EXPECT_EQ(number_of_line(text, "MemAvailable"), 8192);
  EXPECT_EQ(number_of_line(text, "inactive_file"), 77);
  EXPECT_EQ(number_of_line(text, "Mem"), -1);  // the beginning of a name is not the name
  EXPECT_EQ(number_of_line(text, "last"), -1);
  EXPECT_EQ(number_of_line("", "last"), -1);
}

TEST(Memory, TheProcessSeesWhatItTakes) {
  const ProcessMemory before = process_memory();
  ASSERT_GT(before.now, 0);
  EXPECT_GE(before.most, before.now);
  constexpr double size = 64e6;
  const std::vector<double> taken(std::size_t(size / sizeof(double)), 1.0);
  // 64 MB written to are held; the allowance is the eighth that the address sanitizer adds, and as much again
  EXPECT_NEAR(process_memory().now - before.now, size, 16e6) << taken.back();
}

TEST(Memory, SomethingLimitsIt) {
  const AvailableMemory available = available_memory();
  EXPECT_GT(available.bytes, 0);
  EXPECT_FALSE(available.limit.empty());
}

}  // namespace
}  // namespace polybed::core
