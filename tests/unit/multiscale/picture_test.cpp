#include "multiscale/python_module.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/output/output.hpp"
#include "tests/unit/core/scratch.hpp"

namespace polybed::multiscale {
namespace {

using testing::HasSubstr;

TEST(Picture, IsDrawnOfOneStepAlone) {
  const test::Scratch scratch;
  core::Grid grid;
  grid.cells = {3, 4, 1};
  core::FieldWriter writer(scratch.path(), grid, {{"voidage", false}, {"phi_only", false}});
  const core::Field voidage = core::make_field(grid, 0.6), phi = core::make_field(grid, 0.4);
  const std::vector<core::FieldValues> values{{voidage}, {phi}};
  writer.write_step(0, values);
  std::string message;
  EXPECT_TRUE(draw_picture(scratch.path(), message)) << message;
  EXPECT_THAT(message, HasSubstr("picture.png"));
  EXPECT_GT(std::filesystem::file_size(scratch.path() / "picture.png"), 1000u);
}

TEST(Picture, SaysWhyThereIsNone) {
  const test::Scratch scratch;
  std::string message;
  EXPECT_FALSE(draw_picture(scratch.path(), message));
  EXPECT_THAT(message, HasSubstr("no stored fields yet"));
}

}  // namespace
}  // namespace polybed::multiscale
