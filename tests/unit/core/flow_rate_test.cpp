// inlet.flow_rate: what a pump's label says becomes the velocity over the cross-section.
#include <gtest/gtest.h>

#include "core/case/file.hpp"
#include "core/error.hpp"

namespace polybed::core {
namespace {

const char* const pumped = R"(column = { size = ["60 mm", "600 mm"], cells = [12, 120], depth = "10 mm" }
fluid = { name = "water", temperature = "15 degC" }
bed = { volume_share = [1.0], static_height = "60 mm", solids_fraction = 0.6 }
inlet = { flow_rate = [[0, "108 l/h"], [1, "5.4e-5 m3/s"]] }
run = { until = "2 s" }
[[species]]
name = "fine"
diameter = "0.8 mm"
density = "1395 kg/m3"
)";

// 108 l/h are 3e-5 m3/s, through 60 mm times 10 mm.
TEST(FlowRate, BecomesAVelocity) {
  const Scene scene = parse_case(pumped, "case.toml", {}, {});
  ASSERT_EQ(scene.inlet.superficial_velocity.size(), 2U);
  EXPECT_NEAR(scene.inlet.superficial_velocity[0].second, 0.05, 1e-15);
  EXPECT_NEAR(scene.inlet.superficial_velocity[1].second, 0.09, 1e-15);
  EXPECT_TRUE(scene.inlet.flow_rate.empty());
}

TEST(FlowRate, GivesWayToAVelocityOnTheCommandLine) {
  const std::string velocity = "inlet.superficial_velocity=0.02";
  const Scene scene = parse_case(pumped, "case.toml", std::vector{velocity}, {});
  ASSERT_EQ(scene.inlet.superficial_velocity.size(), 1U);
  EXPECT_EQ(scene.inlet.superficial_velocity[0].second, 0.02);
  EXPECT_THROW(parse_case(pumped, "case.toml", std::vector<std::string>{velocity, "inlet.flow_rate=1e-5"}, {}),
               CaseError)
      << "both on the command line contradict each other";
}

}  // namespace
}  // namespace polybed::core
