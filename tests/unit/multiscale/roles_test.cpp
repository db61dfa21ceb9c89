// A case with distributions of sizes, from its text to the species that a model sees.
#include "multiscale/roles.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "closures/mixture.hpp"
#include "core/case/file.hpp"

namespace polybed::multiscale {
namespace {

const std::string text = R"(
column = { size = [0.03, 0.2], cells = [6, 40] }
fluid = { name = "water", temperature = "20 degC" }
bed = { volume_share = [0.4, 0.6], static_height = "50 mm", solids_fraction = 0.6 }
inlet = { superficial_velocity = "20 mm/s" }
effects = { drag = "cello", solids_stress = "frictional" }
run = { until = "1 s" }
[[species]]
name = "sand"
density = 2650
distribution = "lognormal"
mean = "0.8 mm"
deviation = 0.3
[[species]]
name = "grit"
density = 2650
distribution = "sieves"
classes = 2
sieves = [["1 mm", 0.3], ["1.4 mm", 0.5], ["2 mm", 0.2], ["2.8 mm", 0]]
)";

// By hand: D_Sauter = mean exp(-s^2); 1/D_Sauter of the sieves is sum x_i (1/a - 1/b)/ln(b/a) = 0.3 x 849.15 +
// 0.5 x 600.79 + 0.2 x 424.57 = 640.05 per m.
TEST(SizeClasses, OfACaseHaveTheMomentsOfItsDistributions) {
  const core::Scene scene = core::parse_case(text, "case.toml", {}, all_roles(), size_classes);
  ASSERT_EQ(scene.species.size(), 5U);
  EXPECT_EQ(scene.species[2].name, "sand.3");
  EXPECT_EQ(scene.species[4].name, "grit.2");
  std::vector<double> diameter, share;
  for (std::size_t n = 0; n < 5; ++n) {
    diameter.push_back(scene.species[n].diameter);
    share.push_back(scene.bed.volume_share[n] / (n < 3 ? 0.4 : 0.6));
  }
  const auto part = [](const std::vector<double>& v, std::size_t from, std::size_t n) {
    return std::span<const double>(v).subspan(from, n);
  };
  EXPECT_NEAR(closures::sauter_diameter(part(share, 0, 3), part(diameter, 0, 3)), 0.8e-3 * std::exp(-0.09), 1e-15);
  EXPECT_NEAR(1 / closures::sauter_diameter(part(share, 3, 2), part(diameter, 3, 2)), 640.05, 0.01);
}

}  // namespace
}  // namespace polybed::multiscale
