// The table of a sweep, for people.
#include <gtest/gtest.h>

#include "multiscale/cost/report.hpp"

namespace polybed::multiscale {
namespace {

// Of repetitions the middle one is told, as in cost.csv: the first also reads the program from the disk.
TEST(SweepMarkdown, HasTheMedianOfTheTimes) {
  Sweep sweep;
  sweep.outcome = "refused";
  sweep.options.quantities = {"bed_height"};
  Row row;
  row.status = "failed";
  row.cpu = {9, 1.25, 2.5};
  sweep.rows = {row, row};
  sweep.rows[1].cpu.clear();
  const std::string text = sweep_markdown(sweep, {"case.toml", "", {}});
  EXPECT_NE(text.find("| 2.5 |"), std::string::npos) << text;
  EXPECT_EQ(text.find("| 9 |"), std::string::npos) << text;
}

}  // namespace
}  // namespace polybed::multiscale
