#include "multiscale/resolve/moving_box.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "multiscale/resolve/rows.hpp"
#include "multiscale/resolve/rules.hpp"

using namespace polybed;
using namespace polybed::multiscale;

namespace {

/// Spheres of two species, the second `ratio` times as large, in equal volumes.
core::Scene two_species(int spheres, double voidage, double ratio, double reynolds) {
  core::Scene scene;
  scene.species.resize(2);
  for (std::size_t j = 0; j < 2; ++j) {
    scene.species[j].name = j == 0 ? "fine" : "coarse";
    scene.species[j].diameter = j == 0 ? 1e-3 : ratio * 1e-3;
    scene.species[j].density = 2500;
  }
  scene.bed.volume_share = {0.5, 0.5};
  scene.resolve.motion = core::SphereMotion::moving;
  scene.resolve.voidage = {voidage};
  scene.resolve.reynolds = {reynolds};
  scene.resolve.spheres = spheres;
  scene.resolve.cells_per_diameter = 6;
  scene.resolve.grids = 1;
  return scene;
}

/// A sphere of each of two species of one size, in a box where they pass beside each other.
core::Scene two_arrays(int cells) {
  core::Scene scene = two_species(2, 0.8, 1, 10);
  scene.resolve.cells_per_diameter = cells;
  return scene;
}

SpherePacking places_of_arrays(const core::Scene& scene) {
  const double length = box_length(scene, 0.8), x = 0.013e-3;
  return {length, {{x, 2 * x, 3 * x}, {x + 0.25 * length, 2 * x + 0.5 * length, 3 * x + 0.5 * length}}, {0, 1}, {}};
}

const StillWanted go_on = [](double, double) { return true; };

/// Mean forces after `first` of all double steps of travelling spheres.
template <class Real>
BoxDrag run(MovingBox<Real>& box, int first, int all) {
  const int still = int(box.plan().still / 2);
  for (int n = 0; n < still + all; ++n) {
    if (n == still + first) box.forget();
    box.step();
    if (n % 100 == 99) box.begin_window();
  }
  return box.means();
}

}  // namespace

// By hand: two spheres of radius 2 and 1 overlap by 0.3 along x and move apart by 0.1 and 0.2; a third of each species
// is far away and moves back by half of that, then all species are where they would be.
TEST(GuidedSpheres, PushEachOtherAsideAndKeepTheirMean) {
  const double edge = 40;
  GuidedSpheres spheres({{{10, 10, 10}, 2}, {{13.1, 10, 10}, 1}, {{30, 30, 30}, 2}, {{20, 30, 10}, 1}}, {0, 1, 0, 1},
                        {{0.1, 0, 0}, {-0.1, 0, 0}}, edge);
  const auto& motion = spheres.motion();
  // To 10.2 and 12.9, which overlap by 0.3; the push returns half each round, so what is left is found by halves.
  const double first = 10 + 2 * motion[0].velocity[0], second = 13.1 + 2 * motion[1].velocity[0];
  EXPECT_NEAR(second - first, 3, 1e-3);
  EXPECT_NEAR((motion[0].velocity[0] + motion[2].velocity[0]) / 2, 0.1, 1e-15);
  EXPECT_NEAR((motion[1].velocity[0] + motion[3].velocity[0]) / 2, -0.1, 1e-15);
  EXPECT_NEAR(motion[0].velocity[0] - 0.1, -0.05, 1e-3);  // by 0.1, the larger one less
  EXPECT_NEAR(motion[1].velocity[0] + 0.1, 0.1, 1e-3);    // by 0.2
  EXPECT_EQ(motion[0].velocity[1], 0);
  // The film between them, 6 pi mu R*^2 (ln(1/0.1) + ...): from a gap of 0.1 to one of 0.
  const std::vector<double> film = spheres.film_impulses(0.5, 2.0 / 3, 0.01);
  const double h = 0.1, r = 0.01, c = 6 * M_PI * 0.5 * 4 / 9;
  EXPECT_NEAR(film[1], c * (std::log(h / r) - (h - r) / (2.0 / 3) + (1 - 1.5 * r)), 0.1 * c);  // 1e-3 of 0.01
  EXPECT_EQ(film[0], -film[1]);
  EXPECT_EQ(film[2], 0);
}

// Through 400 double steps of a dense box: no overlap beyond what is left, and each species at its mean place.
TEST(GuidedSpheres, PassThroughEachOtherWithoutOverlap) {
  core::Scene scene = two_species(36, 0.55, 1.5, 10);
  const SpherePacking packing = sphere_packing(scene, 0.55, 1);
  const double scale = 8e3, edge = packing.length * scale, u = 0.03;
  GuidedSpheres spheres(spheres_of(scene, packing, scale), packing.species, {{0, 0, 0}, {u, 0, 0}}, edge);
  lattice::Point moved[2] = {};
  double overlap = 0;
  for (int n = 0; n < 400; ++n) {
    for (std::size_t i = 0; i < packing.species.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) moved[packing.species[i]][k] += 2 * spheres.motion()[i].velocity[k];
    spheres.move();
    const auto& at = spheres.spheres();
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t m = 0; m < i; ++m) {
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k)
          square += std::pow(std::remainder(at[i].centre[k] - at[m].centre[k], edge), 2);
        overlap = std::max(overlap, at[i].radius + at[m].radius - std::sqrt(square));
      }
  }
  EXPECT_LT(overlap, 2e-3);  // 1e-3, which the return to the mean changes by less than as much
  const std::vector<std::int64_t> count = sphere_numbers(scene);
  EXPECT_NEAR(moved[0][0] / double(count[0]), 0, 1e-10);
  EXPECT_NEAR(moved[1][0] / double(count[1]), 800 * u, 1e-10);
  EXPECT_NEAR(moved[1][1], 0, 1e-10);
}

// Two arrays that move together. 1 % is asked; motion over the lattice makes 0.6 % at 12 cells per diameter and Re 5,
// in proportion to Re and the square of a cell: 1.9 % at 10 cells and Re 10.
TEST(MovingBox, ArraysThroughFluidAtRestHaveTheHeldDrag) {
  const core::Scene scene = two_arrays(12);
  const SpherePacking packing = places_of_arrays(scene);
  const ResolvePoint all{0.8, 5, 0, 0, {0, 1}};
  EXPECT_FALSE(places_move(scene, all));
  const BoxDrag held = box_drag(scene, all, packing, go_on);
  MovingBox<float> box(scene, all, packing, -plan_of(scene, all).units.speed / 0.8);
  const BoxDrag moving = run(box, 600, 800);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(moving.pure[j], held.pure[j], 0.01 * held.pure[j]);
    EXPECT_NEAR(moving.net[j], held.net[j], 0.01 * held.net[j]);
  }
  EXPECT_LT(moving.imbalance, 1e-3);
}

// The same arrays pass each other without touching, and move in common: 0.8 % of f_11 here, 1 % is asked.
TEST(MovingBox, RelativeMotionIsInvariantToACommonVelocity) {
  const core::Scene scene = two_arrays(10);
  const SpherePacking packing = places_of_arrays(scene);
  const ResolvePoint point{0.8, 10, 0, 0, {0}};
  const double u = plan_of(scene, point).units.speed / 0.8;
  MovingBox<float> rest(scene, point, packing);
  const BoxDrag f = run(rest, 500, 1500);
  for (const double common : {-u, -0.5 * u}) {
    MovingBox<float> box(scene, point, packing, common);
    const BoxDrag g = run(box, 500, 1500);
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(g.pure[j], f.pure[j], 0.01 * f.pure[0]) << common;
  }
}

TEST(MovingBox, GoesOnFromItsFileWithTheSameBits) {
  const core::Scene scene = two_species(4, 0.8, 1, 10);  // two of each, which push each other
  const ResolvePoint point{0.8, 10, 0, 0, {1}};
  const SpherePacking packing = sphere_packing(scene, 0.8, 1);
  const BoxDrag whole = box_drag(scene, point, packing, go_on);
  const KeptBox kept{std::filesystem::path(testing::TempDir()) / "moving-box.h5", box_name(scene, point), 1e9};
  kept.remove();
  int windows = 0;
  EXPECT_THROW((void)box_drag(
                   scene, point, packing, [&](double, double) { return ++windows < 9; }, &kept),
               core::Stopped);
  BoxDrag resumed = box_drag(scene, point, packing, go_on, &kept);
  resumed.seconds = whole.seconds;
  EXPECT_EQ(box_text(resumed), box_text(whole));
  EXPECT_FALSE(std::filesystem::exists(kept.path));
}

// Boxes past {1}, {2}, {1, 2}: f_j1 = (f({1}) + f({1, 2}) - f({2}))/2. A quadratic force u_1 + 2 u_2 + 3 u_1^2 + 4 u_1
// u_2 + 5 u_2^2 is split into 1 + 3 + 2 and 2 + 5 + 2.
TEST(MovingBox, PartsOfSpeciesSumToTheHeldDrag) {
  core::Scene scene = two_species(9, 0.8, 2, 10);
  const auto sets = passed(scene, 10);
  EXPECT_THAT(sets, testing::ElementsAre(std::vector{0}, std::vector{1}, std::vector{0, 1}));
  RowBoxes boxes{{{}}};
  for (const double f : {4.0, 7.0, 15.0}) boxes[0][0].push_back({{f, 1}, {f, 1}, {}, {}, {}, 8});
  EXPECT_THAT(row_text(scene, 0.8, 10, boxes), testing::HasSubstr(",15,,15,1,,1,6,,9,,"));
  scene.species.resize(3);
  double all = 0, one = 0, none = 0;
  for (const auto& set : passed(scene, 10)) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += factor_of(set, k, scene, 10);
    EXPECT_NEAR(sum, set.size() == 3 ? 1 : 0, 1e-15);
    all += set.size() == 3 ? factor_of(set, 2, scene, 10) : 0;
    one += set == std::vector{2} ? factor_of(set, 2, scene, 10) : 0;
    none += set == std::vector{0, 1} ? factor_of(set, 2, scene, 10) : 0;
  }
  EXPECT_NEAR(all, 1.0 / 3, 1e-15);
  EXPECT_NEAR(one, 1.0 / 3, 1e-15);
  EXPECT_NEAR(none, -1.0 / 3, 1e-15);
}

TEST(MovingBox, NarrowBoxesAreRefusedWhereSpheresTravel) {
  core::Scene scene = two_species(9, 0.6, 2, 10);
  const auto broken = [&] {
    std::string text;
    for (const core::CaseProblem& problem : core::problems_of(resolve_rules(), scene)) text += problem.text() + "\n";
    return text;
  };
  EXPECT_THAT(broken(), testing::HasSubstr("spheres that travel need 2.11"));
  scene.resolve.reynolds = {0};
  EXPECT_EQ(broken(), "");
}
