// The width over which particles are averaged, and why.
#include "dem/coupling/kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace polybed::dem {
namespace {

using testing::HasSubstr;

core::Scene asking(const std::string& kernel) {
  core::Scene scene;
  scene.dem.kernel = core::choice_of<core::Kernel>(kernel);
  return scene;
}

TEST(Kernel, SuitsCellsAndNumberUnlessTheCaseSays) {
  const core::Scene automatic = asking("auto");
  EXPECT_EQ(kernel_of(automatic, 3e-3, 2e-3, 1000).width, 0);  // 1.5 diameters are enough
  EXPECT_THAT(kernel_of(automatic, 3e-3, 2e-3, 1000).reason, HasSubstr("the smallest cell has 1.5"));
  EXPECT_DOUBLE_EQ(kernel_of(automatic, 2.9e-3, 2e-3, 1000).width, 8e-3);
  EXPECT_THAT(kernel_of(automatic, 2.9e-3, 2e-3, 1000).reason, HasSubstr("4 of the largest diameters, as"));
  EXPECT_DOUBLE_EQ(kernel_of(automatic, 2.9e-3, 2e-3, 1).width, 12e-3);
}

// Equal volumes of 1 and 2 mm: 1/(0.5/1 + 0.5/2) = 4/3 mm.
TEST(Kernel, IsFourOfTheMeanDiameterOfAMixture) {
  core::Scene scene = asking("auto");
  scene.species.resize(2);
  scene.species[0].diameter = 1e-3, scene.species[1].diameter = 2e-3;
  scene.bed.volume_share = {0.5, 0.5};
  const Kernel kernel = kernel_of(scene, 2e-3, 2e-3, 1000);
  EXPECT_DOUBLE_EQ(kernel.width, 16e-3 / 3);
  EXPECT_THAT(kernel.reason, HasSubstr("2.7 of the largest diameters, as"));
  scene.bed.volume_share = {1, 0};
  EXPECT_DOUBLE_EQ(kernel_of(scene, 2e-3, 2e-3, 1000).width, 4e-3);
  scene.bed.volume_share.clear();  // of a list
  EXPECT_DOUBLE_EQ(kernel_of(scene, 2e-3, 2e-3, 1000).width, 8e-3);
}

TEST(Kernel, IsWhatTheCaseAsksFor) {
  EXPECT_EQ(kernel_of(asking("bilinear"), 1e-3, 2e-3, 1000).width, 0);
  EXPECT_DOUBLE_EQ(kernel_of(asking("diffusion"), 1, 2e-3, 1000).width, 8e-3);  // where bilinear weights would do
  core::Scene scene = asking("auto");
  scene.dem.kernel_width = 5e-3;
  EXPECT_EQ(kernel_of(scene, 1, 2e-3, 1000).width, 5e-3);
  scene.dem.kernel = core::Kernel::diffusion;
  EXPECT_EQ(kernel_of(scene, 1e-3, 2e-3, 1).width, 5e-3);
}

}  // namespace
}  // namespace polybed::dem
