// This program as another process: here the program of these tests, of which it runs one that is not run otherwise.
#include "hard/child_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "core/error.hpp"
#include "core/output/files.hpp"
#include "scenes/scratch.hpp"

namespace polybed::hard {
namespace {

using scenes::Scratch;

const std::vector<std::string> sleeping{"--gtest_also_run_disabled_tests",
                                        "--gtest_filter=ChildProgram.DISABLED_SleepsForAnHour"};

TEST(ChildProgram, DISABLED_SleepsForAnHour) { std::this_thread::sleep_for(std::chrono::hours(1)); }

TEST(ChildProgram, EndsWithItsCodeAndWhatItPrinted) {
  const Scratch folder;
  const std::filesystem::path printed = folder.path() / "out";
  EXPECT_EQ(run_child({{"--gtest_list_tests", "--gtest_filter=ChildProgram.*"}, 1, printed}), 0);
  EXPECT_THAT(core::read_text(printed), testing::HasSubstr("EndsWithItsCodeAndWhatItPrinted"));
}

TEST(ChildProgram, EndsWithItsObject) {
  const Scratch folder;
  pid_t process = 0;
  {
    ChildProgram child({sleeping, 1, folder.path() / "out"});
    process = child.process();
    EXPECT_FALSE(child.has_ended());
  }
  EXPECT_EQ(::kill(process, 0), -1);
}

TEST(ChildProgram, TellsWhereItCannotWrite) {
  EXPECT_THROW(ChildProgram({sleeping, 1, "/no/such/folder/out"}), core::FileError);
}

}  // namespace
}  // namespace polybed::hard
