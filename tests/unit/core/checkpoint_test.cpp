#include "core/output/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "core/output/file.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::core {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

Checkpoint sample() {
  using Limits = std::numeric_limits<double>;
  Checkpoint c;
  c.arrays["state"] = {0.1, -0.0, Limits::denorm_min(), -Limits::max(), Limits::infinity(), 1.0 / 3};
  c.arrays["empty"] = {};
  c.numbers = {{"time_s", 0.1 + 0.2}, {"zero", -0.0}};
  c.integers = {{"steps", std::numeric_limits<std::int64_t>::max()}, {"least", -9223372036854775807LL}};
  c.texts = {{"case", "title = \"a bed\"\n\xC3\xA9"}, {"none", ""}};
  return c;
}

std::string message_of_reading(const fs::path& path) {
  try {
    (void)read_checkpoint(path);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST(Checkpoint, ComesBackToTheBit) {
  const test::Scratch scratch;
  const fs::path path = scratch.path() / "checkpoint.h5";
  write_checkpoint(path, sample());
  const Checkpoint back = read_checkpoint(path), want = sample();
  EXPECT_EQ(back, want);
  const auto& a = back.arrays.at("state");
  ASSERT_EQ(a.size(), want.arrays.at("state").size());
  EXPECT_EQ(std::memcmp(a.data(), want.arrays.at("state").data(), a.size() * sizeof(double)), 0);
  EXPECT_TRUE(std::signbit(back.numbers.at("zero")));
}

TEST(Checkpoint, KeepsNotANumberToTheBit) {
  const test::Scratch scratch;
  const double odd = std::bit_cast<double>(0x7ff800000000beefULL);
  Checkpoint c;
  c.arrays["state"] = {odd};
  write_checkpoint(scratch.path() / "checkpoint.h5", c);
  const auto back = read_checkpoint(scratch.path() / "checkpoint.h5");
  EXPECT_EQ(std::bit_cast<std::uint64_t>(back.arrays.at("state")[0]), 0x7ff800000000beefULL);
}

TEST(Checkpoint, EqualStatesMakeEqualFiles) {
  const test::Scratch scratch;
  write_checkpoint(scratch.path() / "a.h5", sample());
  write_checkpoint(scratch.path() / "b.h5", sample());
  EXPECT_EQ(read_whole_file(scratch.path() / "a.h5"), read_whole_file(scratch.path() / "b.h5"));
}

TEST(Checkpoint, KeepsTheOneBefore) {
  const test::Scratch scratch;
  const fs::path path = scratch.path() / "checkpoint.h5";
  Checkpoint c = sample();
  for (int n = 1; n <= 3; ++n) {
    c.integers["steps"] = n;
    write_checkpoint(path, c);
  }
  EXPECT_EQ(read_checkpoint(path).integers.at("steps"), 3);
  EXPECT_EQ(read_checkpoint(previous_checkpoint(path)).integers.at("steps"), 2);
  EXPECT_EQ(previous_checkpoint(path).filename(), "checkpoint.previous.h5");
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()), 2);
}

TEST(Checkpoint, EveryLengthButTheFullOneIsRefused) {
  const test::Scratch scratch;
  const fs::path path = scratch.path() / "checkpoint.h5";
  write_checkpoint(path, sample());
  const Bytes whole = read_whole_file(path);
  std::size_t refused = 0, tried = 0;
  for (std::size_t length = 0; length < whole.size(); length += (length + 100 < whole.size() ? 97 : 1)) {
    write_atomically(path, std::span(whole).first(length));
    ++tried;
    refused += message_of_reading(path).find("cut short or damaged") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(tried, 100u);
  EXPECT_EQ(refused, tried);
}

TEST(Checkpoint, AnyFlippedByteIsRefused) {
  const test::Scratch scratch;
  const fs::path path = scratch.path() / "checkpoint.h5";
  write_checkpoint(path, sample());
  const Bytes whole = read_whole_file(path);
  for (std::size_t at = 0; at < whole.size(); at += 101) {
    Bytes flipped = whole;
    flipped[at] ^= std::byte(0x10);
    write_atomically(path, flipped);
    EXPECT_THAT(message_of_reading(path), HasSubstr("damaged")) << "byte " << at;
  }
}

TEST(Checkpoint, ADamagedOneNamesTheWholeOneBeforeIt) {
  const test::Scratch scratch;
  const fs::path path = scratch.path() / "checkpoint.h5";
  write_checkpoint(path, sample());
  write_checkpoint(path, sample());
  fs::resize_file(path, 1000);
  EXPECT_THAT(message_of_reading(path), HasSubstr("checkpoint.previous.h5, is whole"));
  fs::resize_file(previous_checkpoint(path), 1000);
  EXPECT_THAT(message_of_reading(path), Not(HasSubstr("is whole")));
  EXPECT_THAT(message_of_reading(scratch.path() / "none.h5"), HasSubstr("No such file"));
}

TEST(Checkpoint, AFullDiskLeavesTheOldOne) {
  const test::Scratch scratch;
  const fs::path path = scratch.path() / "checkpoint.h5";
  write_checkpoint(path, sample());
  Checkpoint large = sample();
  large.arrays["state"].assign(100000, 1.5);
  {
    const test::FullDisk disk(100000);
    try {
      write_checkpoint(path, large);
      FAIL() << "written to a full disk";
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("checkpoint.h5"));
      EXPECT_THAT(error.what(), HasSubstr("File too large"));
    }
  }
  EXPECT_EQ(read_checkpoint(path), sample());
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()), 1);
}

TEST(Checkpoint, NamesThatWouldMakeGroupsAreRefused) {
  const test::Scratch scratch;
  Checkpoint c;
  c.numbers["a/b"] = 1;
  EXPECT_THROW(write_checkpoint(scratch.path() / "checkpoint.h5", c), FileError);
}

TEST(Checksums, HaveThePublishedCheckValuesInPiecesToo) {
  // The check values of CRC-64/XZ and CRC-32 for "123456789".
  const std::string digits = "123456789";
  const std::span<const std::byte> all = std::as_bytes(std::span(digits.data(), digits.size()));
  EXPECT_EQ(crc64(all.subspan(4), crc64(all.first(4))), 0x995DC9BBDF1939FAULL);
  EXPECT_EQ(crc32(all.subspan(4), crc32(all.first(4))), 0xCBF43926U);
}

}  // namespace
}  // namespace polybed::core
