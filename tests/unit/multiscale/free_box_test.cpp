#include "multiscale/resolve/free_box.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "multiscale/resolve/rows.hpp"

using namespace polybed;
using namespace polybed::multiscale;

namespace {

/// Spheres of one size that fall at a Reynolds number of 1 to 10 in a liquid of ten times the viscosity of water.
core::Scene one_size(int spheres, double voidage) {
  core::Scene scene;
  scene.species.resize(1);
  scene.species[0].name = "beads";
  scene.species[0].diameter = 1.5e-3;
  scene.species[0].density = 1300;
  core::resolve_materials(scene);
  scene.fluid.name = "oil";
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 5e-3;
  scene.column.gravity = 9.81;
  scene.bed.volume_share = {1};
  scene.effects["contact"] = "hertz_mindlin";
  scene.resolve.motion = core::SphereMotion::free;
  scene.resolve.voidage = {voidage};
  scene.resolve.spheres = spheres;
  scene.resolve.cells_per_diameter = 8;
  scene.resolve.grids = 1;
  scene.resolve.precision = core::Precision::two;
  return scene;
}

const StillWanted go_on = [](double, double) { return true; };

}  // namespace

// A sphere in a periodic box is a cubic array: it falls at the velocity at which the held array has its weight. The
// difference is that of the motion over the lattice, 0.6 % here; the start has been forgotten to 0.2 %.
TEST(FreeBox, SphereFallsAtTheVelocityThatBalancesTheHeldDrag) {
  core::Scene scene = one_size(1, 0.95);
  const SpherePacking packing = sphere_packing(scene, 0.95, 1);
  FreeBox<double> box(scene, {0.95, 0, 0, 0}, packing);
  for (int n = 0; n < 1000; ++n) {
    if (n == 800) box.forget();
    box.step();
    if (n % 10 == 0) box.sample();
  }
  const BoxDrag fall = box.means();
  // (rho_s - rho_f) g D^2/(18 mu) over the superficial slip: what the pure drag and the mean pressure bear together.
  const double net = 300 * 9.81 * 1.5e-3 * 1.5e-3 / (18 * 5e-3) / fall.slip[0];
  EXPECT_NEAR(fall.net[0], net, 0.005 * net);
  scene.resolve.motion = core::SphereMotion::held;
  const double reynolds = 1000 * fall.slip[0] * 1.5e-3 / 5e-3;
  const BoxDrag held = box_drag(scene, {0.95, reynolds, 0, 0}, packing, go_on);
  EXPECT_NEAR(net, held.net[0], 0.01 * held.net[0]);
}

// Momentum of liquid and spheres: nothing acts on the box, so what is left is round-off; with contacts.
TEST(FreeBox, MomentumIsConservedAndACommonVelocityChangesNothing) {
  const core::Scene scene = one_size(8, 0.6);
  const SpherePacking packing = sphere_packing(scene, 0.6, 1);
  FreeBox<double> rest(scene, {0.6, 0, 0, 0}, packing), moving(scene, {0.6, 0, 0, 0}, packing);
  const double speed = 0.02, si = speed / rest.plan().scale / rest.plan().step;
  moving.flow().set_velocity({speed, 0, 0});
  moving.spheres().kick(std::vector<dem::Kick>(8, dem::Kick{{si, 0, 0}, {}}));
  moving.let_walls_follow();
  const double before = moving.momentum().all;
  for (int n = 0; n < 200; ++n) {
    rest.step();
    moving.step();
    if (n == 100) {
      rest.forget();
      moving.forget();
    }
    rest.sample();
    moving.sample();
  }
  EXPECT_LT(std::abs(rest.momentum().all), 1e-10 * rest.momentum().of_spheres);
  EXPECT_LT(std::abs(moving.momentum().all - before), 1e-10 * moving.momentum().of_spheres);
  EXPECT_NEAR(moving.means().slip[0], rest.means().slip[0], 0.01 * rest.means().slip[0]);
}

TEST(FreeBox, GoesOnFromItsFileWithTheSameBits) {
  core::Scene scene = one_size(4, 0.8);
  scene.resolve.precision = core::Precision::one;
  scene.resolve.cells_per_diameter = 6;
  scene.resolve.until = 0.15;
  const ResolvePoint point{0.8, 0, 0, 0};
  const SpherePacking packing = sphere_packing(scene, 0.8, 1);
  const BoxDrag whole = box_drag(scene, point, packing, go_on);
  const KeptBox kept{std::filesystem::path(testing::TempDir()) / "free-box.h5", box_name(scene, point), 1e9};
  kept.remove();
  int windows = 0;
  EXPECT_THROW((void)box_drag(
                   scene, point, packing, [&](double, double) { return ++windows < 2; }, &kept),
               core::Stopped);
  EXPECT_EQ(windows, 2);
  BoxDrag resumed = box_drag(scene, point, packing, go_on, &kept);
  resumed.seconds = whole.seconds;
  EXPECT_EQ(box_text(resumed), box_text(whole));
  EXPECT_FALSE(std::filesystem::exists(kept.path));
}

TEST(FreeBox, RowsHaveSlipAndItsReynoldsNumbers) {
  const core::Scene scene = one_size(27, 0.8);
  RowBoxes boxes;
  for (const double slip : {0.02, 0.04}) {
    BoxDrag box{{3}, {2.5}, {slip}, {0.001}, {0.002}, 8};
    boxes.push_back({{box}});
  }
  // Mean 0.03 m/s, standard error 0.01; Re = 1000 0.03 1.5e-3/5e-3 = 9, in a pore and a cell 9/(0.8 8) = 1.406.
  EXPECT_EQ(row_header(scene),
            "eps,Re,x1,D1,u_1,u_1_se,f_1,v_1,w_1,packings,resolution,spheres,imbalance,cell_Re,u_1_grid");
  EXPECT_EQ(row_text(scene, 0.8, 0, boxes), "0.8,9,1.00000000,0.0015,0.03,0.01,2.5,0.001,0.002,2,8,27,0,1.41,");
  EXPECT_EQ(pair_text(scene, 0.8, boxes), "");
  // Half of the edge, 6.20 mm, is 2.07 diameters: ten shells.
  boxes[0][0][0].pairs.assign(10, 1.5);
  boxes[1][0][0].pairs.assign(10, 2.5);
  EXPECT_THAT(pair_text(scene, 0.8, boxes), testing::StartsWith("0.8,9,1,1,1.05,2,0.5\n0.8,9,1,1,1.15,2,0.5\n"));
  EXPECT_EQ(box_of_text(box_text(boxes[1][0][0]), scene).pairs, boxes[1][0][0].pairs);
}

// A cube of edge 10: two spheres of radius 1/2 meet across its sides at 1.05, one of radius 1 is 1.93 from the first,
// 1.29 of the distance at contact. One pair of one in a shell of 4/3 pi (1.1^3 - 1) = 1.38649, one of two in a shell
// of 4/3 pi 1.5^3 (1.3^3 - 1.2^3) = 6.63033; points at random would have 1.38649/1000 and 2 6.63033/1000.
// The other pair of two is at 2.197, 1.465 of contact: 4/3 pi 1.5^3 (1.5^3 - 1.4^3) = 8.92055.
TEST(FreeBox, PairDistributionIsThatOfPointsTimesItself) {
  PairDistribution pairs({0.5, 1}, {2, 1}, 10);
  const std::vector<lattice::Sphere> spheres{{{0.5, 0, 0}, 0.5}, {{9.45, 0, 0}, 0.5}, {{0.5, 1.93, 0}, 1}};
  pairs.add(spheres, {0, 0, 1});
  pairs.add(spheres, {0, 0, 1});
  ASSERT_EQ(pairs.shells().size(), 40);  // to 3: no pair of two large spheres
  std::vector<double> g = pairs.mean();
  EXPECT_NEAR(g[0], 1 / 1.38649e-3, 1e-5 / 1.38649e-3);
  EXPECT_NEAR(g[20 + 2], 1 / 13.26066e-3, 1e-5 / 13.26066e-3);
  EXPECT_NEAR(pairs.shells()[22].middle, 1.25, 1e-12);
  EXPECT_NEAR(g[20 + 4], 1 / 17.84110e-3, 1e-5 / 17.84110e-3);
  g[0] = g[22] = g[24] = 0;
  EXPECT_THAT(g, testing::Each(0.0));
  PairDistribution again({0.5, 1}, {2, 1}, 10);
  again.restore(pairs.sums());
  EXPECT_EQ(again.mean(), pairs.mean());
  again.forget();
  EXPECT_THAT(again.mean(), testing::Each(0.0));
}
