// Particles and fluid in a round column, without friction of the fluid on its wall: forces balance over the circle.
#include <cmath>

#include "scenes/round_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double area = pi / 4 * across * across;

// A fixed bed between clear fluid above and below. The fluid loses momentum to the spheres alone; what it carries out
// through the top more than in through the bottom is counted.
TEST(DemRoundColumn, TheDropOverAFixedBedIsTheForceOnIt) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    constexpr double velocity = 0.02;
    core::Scene scene = round_column(2500, cells);
    scene.column.closed = false;
    scene.inlet.superficial_velocity = {{0.0, velocity}};
    scene.effects["drag"] = "ergun";
    scene.bed.held = true;
    scene.dem.kernel = kernel;
    scene.dem.fluid_every = 4;
    scene.dem.fixed_step = 0.1 * high / cells[1] / velocity / 4;
    Beads bed(scene, within(scene, 12e-3, 36e-3));
    bed.steps(200 * 4);
    const fluid::Flow& flow = bed.model.coupling()->flow();
    const core::Grid& grid = flow.grid();
    double out = 0;
    for (int k = 0; k < cells[2]; ++k)
      for (int i = 0; i < cells[0]; ++i) {
        const auto f = std::size_t(grid.index(i, cells[1], k));
        const double u = flow.state().velocity[1][f];
        out +=
            grid.metric->open[1][f] * grid.spacing[0] * grid.spacing[2] * water.density * (u * u - velocity * velocity);
      }
    const double force = force_on(bed.model);
    // The flow above the bed is not quite steady after so long.
    compare("drop x area", bed.model.coupling()->pressure_drop() * area, force + out, 1e-3);
    EXPECT_LT(std::abs(out), 0.05 * force);
  });
}

// Spheres that sink in a closed column: once the mean speed is steady the fluid's pressure on the bottom carries their
// weight. As the volume flux over each layer is 0, the momentum of the fluid goes with theirs.
TEST(DemRoundColumn, TheDropUnderASuspensionIsItsBuoyantWeight) {
  for_each_kernel([](core::Kernel kernel, const std::array<int, 3>& cells) {
    constexpr double density = 1100;
    core::Scene scene = heavy_column(density, cells);
    scene.effects["drag"] = "ergun";
    scene.dem.kernel = kernel;
    const std::vector<Bead> beads = within(scene, 16e-3, 46e-3, 0.8);
    Beads bed(scene, beads);
    const double solids = double(beads.size()) * bead_volume, weight = solids * (density - water.density) * 9.81;
    bed.steps(1000);
    const double before = mean_speed(bed.model);
    double drop = 0;
    for (int n = 0; n < 50; ++n) {
      bed.steps(10);
      drop += bed.model.coupling()->pressure_drop() / 50;
    }
    // Momentum that spheres and fluid have gained together: V (rho_p - rho_f) U.
    const double gained = solids * (density - water.density) * (mean_speed(bed.model) - before) / (500 * bed.dt());
    compare("drop x area over weight", drop * area / (weight + gained), 1, 1e-3);
    EXPECT_LT(mean_speed(bed.model), -1e-3);
    EXPECT_LT(std::abs(gained), 0.05 * weight);
  });
}

TEST(DemRoundColumn, ANeutrallyBuoyantSuspensionStays) { expect_a_neutral_suspension_to_stay({}); }

TEST(DemRoundColumn, LosesWhatPassesItsTopAndResumesWithTheSameBits) {
  core::Scene scene = heavy_column(1010, {6, 12, 6});
  scene.inlet.superficial_velocity = {{0.0, 0.06}};
  expect_what_leaves_to_be_gone(scene, [](const Beads&) {});
}

// Water that rises slowly, fed with glass from the top, anywhere in the circle: 1 mm/s of 452 mm2 for 0.1 s, in whole
// spheres of 4.19 mm3. What has come in is in the cells.
TEST(DemRoundColumn, IsFedWithinItsCircle) {
  core::Scene scene = heavy_column(2500, {6, 12, 6});
  scene.column.closed = false;
  scene.inlet.superficial_velocity = {{0.0, 0.01}};
  scene.feeds = {{"a", core::ColumnFace::top, {{0.0, 1e-3}}, 0.1, {}, {}}};
  Beads bed(scene, {{"a", {0.5 * across, 10e-3, 0.5 * across}}});
  bed.steps(1000);
  EXPECT_EQ(bed.model.feeding()->all(), 10);
  double inside = 0;
  const dem::Particles& particles = bed.model.particles();
  for (std::size_t i = 0; i < particles.owned; ++i)
    inside += bed.model.feeding()->arrivals().share(bed.model.box(), particles.place[i], particles.id[i]) * bead_volume;
  EXPECT_GT(inside, 8 * bead_volume);
  compare("solids in the cells", solids_of(bed.model), inside, 1e-9);
}

}  // namespace
}  // namespace polybed::scenes
