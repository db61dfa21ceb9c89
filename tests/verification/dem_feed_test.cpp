// Particles that enter through [[feed]]: how many, when and where, and the accounts of what they bring.
#include <numbers>
#include <numeric>
#include <utility>

#include "core/numerics/metric.hpp"
#include "dem/settling.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double r = 0.5e-3, side = 0.02;
const Material glass{5e6, 0.25, 2500};
const double volume = 4.0 / 3 * pi * r * r * r;

/// A box of 20 mm without gravity; a sphere at rest in a corner of the bottom is its start.
core::Scene fed_box() {
  core::Scene scene = dry_box(r, glass, {side, side, side});
  core::set_restitution(scene, 0.5);
  return scene;
}
const std::vector<Bead> one_at_rest{{"a", {1e-3, r, 1e-3}}};

core::Feed feed_of(const std::string& species, core::ColumnFace at, std::vector<std::pair<double, double>> rate,
                   double velocity, std::vector<double> from = {}, std::vector<double> to = {}) {
  return {species, at, std::move(rate), velocity, std::move(from), std::move(to)};
}

// The number by a time is that of whole particles in the volume let in by then, step by step: of a rate that rises from
// 0 to F in 10 ms, falls to F/2 at once and stays there, F t^2/20 ms, then F (5 ms + (t - 10 ms)/2).
TEST(DemFeed, LetsInWholeParticlesOfTheVolumeCalledFor) {
  constexpr double most = 4e-3, area = 10e-3 * side;
  core::Scene scene = fed_box();
  scene.feeds = {feed_of("a", core::ColumnFace::top, {{0.0, 0.0}, {0.01, most}, {0.01, most / 2}}, 0.5, {5e-3, 0.0},
                         {15e-3, side})};
  Beads beads(scene, one_at_rest);
  const dem::Feeding& feeding = *beads.model.feeding();
  const auto expected = [](double t) {
    const double height = t < 0.01 ? most * t * t / 0.02 : most * (0.005 + (t - 0.01) / 2);
    return std::int64_t(std::floor(height * area / volume + 1e-6));
  };
  while (beads.model.time() < 0.03) {
    beads.steps(1);
    ASSERT_EQ(feeding.all(), expected(beads.model.time())) << "at " << beads.model.time() << " s";
    ASSERT_EQ(beads.model.particle_count(), 1 + feeding.all());
  }
  EXPECT_EQ(feeding.number, std::vector<std::int64_t>{22});  // 60 um on 200 mm2, of 0.5236 mm3 each
  EXPECT_EQ(feeding.waiting(), std::vector<std::int64_t>{0});
  EXPECT_TRUE(beads.model.pairs().touching.empty());
  const dem::Particles& particles = beads.model.particles();
  std::vector<std::int64_t> ids = particles.id;
  std::sort(ids.begin(), ids.end());
  double least = 1, greatest = 0;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    EXPECT_EQ(ids[i], std::int64_t(i));
    if (particles.id[i] == 0) continue;
    EXPECT_EQ(particles.motion[i].v, (dem::Vector{0, -0.5, 0}));
    least = std::min(least, particles.place[i].x[0]);
    greatest = std::max(greatest, particles.place[i].x[0]);
  }
  EXPECT_GE(least, 5e-3 + r);
  EXPECT_LE(greatest, 15e-3 - r);
  EXPECT_GT(greatest - least, 4e-3) << "at random places";
}

// More often than the list of pairs is made for their speed they enter several at a time, at most that much later: by
// the time in which they move by half the skin, 0.05 mm.
TEST(DemFeed, LetsInADenseStreamWithoutOverlap) {
  constexpr double velocity = 0.5, rate = 0.3 * velocity;
  core::Scene scene = fed_box();
  scene.feeds = {feed_of("a", core::ColumnFace::bottom, {{0.0, rate}}, velocity)};
  scene.feeds[0].from = {4e-3, 4e-3};
  scene.feeds[0].to = {side, side};
  Beads beads(scene, one_at_rest);
  const double per_second = rate * 16e-3 * 16e-3 / volume, late = 0.05e-3 / velocity + 2 * beads.dt();
  ASSERT_GT(per_second * late, 3);
  while (beads.model.time() < 0.015) {
    beads.steps(1);
    const double called = per_second * beads.model.time(), entered = double(beads.model.feeding()->all());
    ASSERT_LE(entered, called + 1e-5);
    ASSERT_GE(entered, std::floor(called - per_second * late) - 1) << "at " << beads.model.time() << " s";
  }
  EXPECT_TRUE(beads.model.pairs().touching.empty()) << "all move alike and none overlaps";
}

// A feed as wide as a particle that one blocks: the others wait, are told, and follow one by one once it has gone.
TEST(DemFeed, LetsParticlesWaitUntilThereIsRoom) {
  core::Scene scene = fed_box();
  scene.feeds = {
      feed_of("a", core::ColumnFace::bottom, {{0.0, 0.2}, {0.01, 0.2}, {0.01, 0.0}}, 1, {5e-3, 5e-3}, {6e-3, 6e-3})};
  Beads beads(scene, {{"a", {5.5e-3, r, 5.5e-3}, {0, 0.05, 0}}});
  beads.until(0.012);  // 3 are called for by 10 ms, and the first is 0.6 mm high
  const dem::Feeding& feeding = *beads.model.feeding();
  EXPECT_EQ(feeding.all(), 0);
  EXPECT_EQ(feeding.waiting(), std::vector<std::int64_t>{3});
  EXPECT_THAT(feeding.warning(), testing::HasSubstr("3 of 3 particles of a"));
  beads.until(0.04);
  EXPECT_EQ(feeding.all(), 3);
  EXPECT_EQ(feeding.warning(), "");
}

// As long as all only fall the ledger closes to rounding: steps of the scheme are exact parabolas.
TEST(DemFeed, BringsItsEnergyWithIt) {
  core::Scene scene = fed_box();
  scene.column.gravity = 9.81;
  scene.feeds = {feed_of("a", core::ColumnFace::top, {{0.0, 2e-3}}, 0.5)};
  Beads beads(scene, {{"a", {1e-3, 4e-3, 1e-3}}});
  const dem::Totals start = dem::totals_of(beads.model);
  beads.until(0.02);
  const dem::Totals now = dem::totals_of(beads.model);
  ASSERT_EQ(beads.model.feeding()->all(), 30);  // 40 um on 400 mm2, of 0.5236 mm3 each
  ASSERT_EQ(now.contacts, 0);
  compare("brought by each", now.carried_in / 30, mass_of(r, glass.density) * (0.125 + 9.81 * (side - r)), 1e-5);
  compare("ledger of a fall", now.sum(), start.sum(), 1e-10, now.carried_in);
}

/// A slot that a feed of two sizes fills while it empties.
core::Scene hopper() {
  core::Scene scene = dry_box(r, glass, {0.012, 0.03, 3.2e-3});
  scene.column.dimensions = 2;
  scene.species.push_back(sphere("b", 0.7 * r, glass));
  scene.column.gravity = 9.81;
  scene.bed.start = {core::StartKind::mixed};
  scene.bed.particles = {100, 100};
  scene.bed.start_solids_fraction = 0.5;
  scene.dem.youngs_modulus = glass.youngs_modulus;
  scene.dem.opening = 5e-3;
  scene.dem.steps_per_contact = 50;  // impacts after a fall of 30 mm at 20: 1.4e-3 of the ledger
  scene.dem.greatest_speed.reset();
  core::set_restitution(scene, 0.6);
  for (const char* species : {"a", "b"})
    scene.feeds.push_back(feed_of(species, core::ColumnFace::top, {{0.0, 0.02}}, 0.3, {2e-3}, {10e-3}));
  return scene;
}

// Every particle was there at the start or has entered, and is in the box or has left, by species; the ledger closes to
// V5 with what came in and went out.
TEST(DemFeed, KeepsCountAndLedger) {
  core::Timers timers;
  dem::Model model(hopper(), timers);
  const dem::Totals start = dem::totals_of(model);
  double greatest = 0, miss = 0;
  while (model.time() < 0.25) {
    model.step(1e300);
    if (model.steps() % 200 != 0) continue;
    const dem::Totals now = dem::totals_of(model);
    greatest = std::max({greatest, now.kinetic + now.rotational, now.dissipated, now.elastic});
    miss = std::max(miss, std::abs(now.sum() - start.sum()));
    std::array<std::int64_t, 2> inside{};
    for (std::size_t i = 0; i < model.particles().owned; ++i) ++inside[std::size_t(model.particles().species[i])];
    for (std::size_t j = 0; j < 2; ++j)
      ASSERT_EQ(inside[j] + model.outflow()->number[j], 100 + model.feeding()->number[j]) << "species " << j;
    ASSERT_EQ(inside[0] + inside[1], model.particle_count());
  }
  EXPECT_GT(model.outflow()->all(), 100);
  // 8 mm of 3.2 mm at 20 mm/s for 0.25 s: 128 mm3, of 0.5236 and 0.1796 mm3 each
  EXPECT_EQ(model.feeding()->number, (std::vector<std::int64_t>{244, 712}));
  EXPECT_GT(dem::totals_of(model).carried_in, 0.1 * greatest) << "seen";
  compare("ledger of a feed", miss / greatest, 0, 1e-3, 1);
  const auto steps = double(model.work().particle_steps);
  EXPECT_GT(steps, double(model.steps()) * 200);
  EXPECT_LT(steps, double(model.steps()) * double(200 + model.feeding()->all()));
}

void expect_same(const core::Checkpoint& one, const core::Checkpoint& other) {
  EXPECT_EQ(one.integers, other.integers);
  EXPECT_EQ(one.numbers, other.numbers);
  ASSERT_EQ(one.arrays.size(), other.arrays.size());
  for (const auto& [name, values] : one.arrays) EXPECT_EQ(values, other.arrays.at(name)) << name;
}

TEST(DemFeed, ResumesWithTheSameBits) {
  core::Timers timers;
  const core::Scene scene = hopper();
  dem::Model through(scene, timers), again(scene, timers);
  for (int n = 0; n < 4000; ++n) through.step(1e300);
  through.restart();
  const core::Checkpoint middle = through.checkpoint();
  EXPECT_GT(through.feeding()->all(), 20);
  again.resume(middle);
  expect_same(again.checkpoint(), middle);
  for (int n = 0; n < 1500; ++n)
    for (dem::Model* run : {&through, &again}) run->step(1e300);
  expect_same(again.checkpoint(), through.checkpoint());

  // Another run that begins with these particles is fed from time 0, and numbers go on behind the last one.
  again.start_from(middle);
  EXPECT_EQ(again.feeding()->all(), 0);
  std::int64_t last = 0;
  for (std::size_t i = 0; i < again.particles().owned; ++i) last = std::max(last, again.particles().id[i]);
  EXPECT_EQ(again.feeding()->next_id(), last + 1);
}

/// Beads of 950 kg/m3 in water, which flows down on them at 6 mm/s, solids included; some are fed over the whole top.
/// Or the same upside down: upward through the bottom, where a feed adds to the fluid.
core::Scene inverse(bool upside_down) {
  constexpr double flow = 6e-3, rate = 1e-3;
  core::Scene scene = wet_box(2 * r, 950, water, {8e-3, 24e-3, 8e-3}, {4, 12, 4});
  scene.species[0].youngs_modulus = 3e5;
  scene.column.closed = false;
  scene.column.gravity = 9.81;
  scene.effects["drag"] = "wen_yu";
  scene.dem.greatest_speed = 0.1;
  scene.dem.fluid_every = 8;
  scene.column.down = {0, upside_down ? 1.0 : -1.0, 0};
  scene.inlet = {{{0.0, upside_down ? flow - rate : -flow}}, {}, core::ColumnEnd::top};
  scene.feeds = {feed_of("a", upside_down ? core::ColumnFace::bottom : core::ColumnFace::top, {{0.0, rate}}, 20e-3)};
  return scene;
}

std::vector<Bead> under_the_top(bool upside_down) {
  std::vector<Bead> beads = cubic_lattice("a", 1.6e-3, {8e-3, 6.4e-3, 8e-3});
  for (Bead& bead : beads)
    if (!upside_down) bead.x[1] = 24e-3 - bead.x[1];
  return beads;
}

// An inverse bed is the mirror image of the bed under reversed gravity. By hand 1 mm/s of 64 mm2 for 60 ms are 3.84
// mm3, 7 beads of 0.5236 mm3. Collisions amplify the round-off of the mirrored places; 1e-3 of a diameter are far above
// it.
TEST(DemFeed, AnInverseBedIsTheMirrorImage) {
  Beads floating(inverse(false), under_the_top(false)), sinking(inverse(true), under_the_top(true));
  for (Beads* one : {&floating, &sinking}) {
    one->until(0.06);
    ASSERT_EQ(one->model.feeding()->number, std::vector<std::int64_t>{7});
  }
  for (std::int64_t id = 0; id < floating.model.particle_count(); ++id) {
    const dem::Vector &x = floating.place(id).x, &y = sinking.place(id).x;
    EXPECT_NEAR(x[0], y[0], 2e-3 * r) << id;
    EXPECT_NEAR(x[1], 24e-3 - y[1], 2e-3 * r) << id;
    EXPECT_NEAR(x[2], y[2], 2e-3 * r) << id;
  }
}

// The water presses the beads down as much as their weight lacks: p falls downwards by N V (rho_f - rho_p) g/A. Above
// the centre of the topmost cell, 2 mm high, is the screen's share of those near it, linear in the height. Beads are
// counted, and so is their energy. 5 %: beads that enter bring 2 % of it as momentum, and that of the water changes by
// rho J^2 (1/eps - 1), 3 % at a voidage of 0.7.
TEST(DemFeed, AnInverseBedCarriesItsBuoyancy) {
  Beads beads(inverse(false), under_the_top(false));
  const dem::Model& model = beads.model;
  const dem::Totals start = dem::totals_of(model);
  const core::Grid& grid = model.coupling()->flow().grid();
  const auto mean = [&](int row) {
    double sum = 0;
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 4; ++i)
        sum += model.coupling()->flow().state().pressure[std::size_t(grid.index(i, row, k))] / 16;
    return sum;
  };
  double fall = 0, weight = 0, greatest = 0;
  while (model.time() < 0.3) {
    beads.steps(8);
    const dem::Totals now = dem::totals_of(model);
    greatest = std::max({greatest, now.kinetic + now.rotational, now.dissipated, std::abs(now.work)});
    if (model.time() < 0.1) continue;
    fall += mean(11) - mean(0);
    for (std::size_t i = 0; i < model.particles().owned; ++i)
      weight += std::min(1.0, (24e-3 - model.particles().place[i].x[1]) / 2e-3) * volume * 50 * 9.81 / 64e-6;
  }
  EXPECT_EQ(model.particle_count(), 100 + model.feeding()->all());
  EXPECT_GT(model.feeding()->all(), 10);  // others wait for room
  compare("pressure over the buoyancy of the beads", fall / weight, 1, 0.05);
  compare("ledger of an inverse bed", dem::totals_of(model).sum() - start.sum(), 0, 1e-3, greatest);
}

TEST(DemFeed, IsShutWhileABedSettlesAndAbsentWithoutFeeds) {
  core::Scene scene = hopper();
  core::Timers timers;
  scene.bed.start = {core::StartKind::settled};
  const core::Checkpoint rest = dem::settled(scene, dem::Model(scene, timers).limits().dt, nullptr, nullptr);
  EXPECT_EQ(rest.arrays.at("particles").size(), 200U * 23);
  EXPECT_FALSE(rest.arrays.contains("feed_entered"));
  scene.feeds.clear();
  EXPECT_EQ(dem::Model(scene, timers).feeding(), nullptr);
}

/// Water that rises slowly through a column, fed with 144 mm3/s of glass, from the top or elsewhere.
core::Scene fed_water(int every, core::ColumnFace at = core::ColumnFace::top) {
  core::Scene scene = wet_box(2 * r, glass.density, water, {12e-3, 24e-3, 12e-3}, {8, 16, 8});
  scene.column.closed = false;
  scene.column.gravity = 9.81;
  scene.inlet.superficial_velocity = {{0.0, 0.01}};
  scene.dem.fluid_every = every;
  scene.dem.greatest_speed = 0.3;
  scene.feeds = {feed_of("a", at, {{0.0, 1e-3}}, 0.1)};
  if (is_side(at)) {
    scene.feeds[0].from = {2e-3, 3e-3};
    scene.feeds[0].to = {10e-3, 21e-3};
  }
  return scene;
}

/// Solids of the fluid's cells, in whole cells.
std::vector<double> solids_of(const dem::Model& model) {
  const dem::Coupling::Column column = model.coupling()->column();
  std::vector<double> phi;
  for (int k = 0; k < column.grid.cells[2]; ++k)
    for (int j = 0; j < column.grid.cells[1]; ++j)
      for (int i = 0; i < column.grid.cells[0]; ++i)
        if (const auto c = std::size_t(column.grid.index(i, j, k)); column.grid.metric)
          phi.push_back(column.fraction[0][c] * column.grid.metric->volume[c]);
        else
          phi.push_back(column.fraction[0][c]);
  return phi;
}

// In a fluid a particle enters at the end of a step of the fluid. Its volume grows in the cells as if it came through a
// plane at the feed's velocity v, or as far as it has moved on: pi z^2 (3 r - z)/3 at z = v t or its distance from the
// face less r, at most pi r^2 dz in a step. Forces of the fluid act on it from its first step on. 1e-9: volumes are
// sums of whole units.
void expect_growth(const core::Scene& scene) {
  Beads beads(scene, {{"a", {6e-3, 12e-3, 6e-3}}});
  const dem::Model& model = beads.model;
  const core::ColumnFace at = scene.feeds[0].at;
  const auto a = std::size_t(axis_of(at));
  const double cell = std::pow(1.5e-3, 3), moved = 1e-2;  // by others in a step of the fluid
  const int every = scene.dem.fluid_every.value_or(1);
  const double most = std::numbers::pi * r * r * 0.3 * every * model.limits().dt;  // at the greatest speed
  std::vector<double> since;
  for (std::vector<double> before = solids_of(model); model.time() < 0.03;) {
    beads.steps(every);
    const std::vector<double> now = solids_of(model), last = std::exchange(before, now);
    if (model.feeding()->all() > std::int64_t(since.size())) since.push_back(model.time());
    EXPECT_EQ(model.feeding()->all(), std::int64_t(since.size()));
    double expected = volume;
    const dem::Particles& particles = model.particles();
    for (std::size_t i = 0; i < particles.owned; ++i) {
      if (particles.id[i] == 0 || std::size_t(particles.id[i]) > since.size()) continue;
      const dem::Vector& x = particles.place[i].x;
      const double way = (scene.column.is_round() && a != 1 ? 6e-3 - std::hypot(x[0] - 6e-3, x[2] - 6e-3)
                          : side_of(at) == 0                ? x[a]
                                                            : scene.column.size[a] - x[a]) -
                         r,
                   t = since[std::size_t(particles.id[i]) - 1];
      const double z = std::min(std::max(0.1 * (model.time() - t), way), 2 * r);
      expected += std::numbers::pi * z * z * (3 * r - z) / 3;
    }
    EXPECT_NEAR(std::accumulate(now.begin(), now.end(), 0.0) * cell, expected, 1e-9 * volume);
    double jump = 0;
    for (std::size_t c = 0; c < now.size(); ++c) jump = std::max(jump, now[c] - last[c]);
    EXPECT_LE(jump, most / cell + moved);
    for (std::size_t i = 0; i < model.particles().owned; ++i) EXPECT_GT(model.coupling()->motion().load[i].drag, 0);
  }
  // 1 mm/s of 144 mm2 for 30 ms: 4.32 mm3
  EXPECT_EQ(since.size(), 8);
}

TEST(DemFeed, GrowsInTheCellsOfAFluid) {
  using core::ColumnFace;
  for (const ColumnFace at : {ColumnFace::top, ColumnFace::bottom, ColumnFace::left, ColumnFace::back}) {
    SCOPED_TRACE(name_of(at));
    expect_growth(fed_water(8, at));
  }
  core::Scene tube = fed_water(8, ColumnFace::left);
  tube.column.shape = core::ColumnShape::cylinder;
  expect_growth(tube);
}

TEST(DemFeed, InAFluidResumesWithTheSameBits) {
  core::Scene scene = fed_water(8);
  scene.effects["added_mass"] = "zuber";
  Beads through(scene, one_at_rest), again(scene, one_at_rest);
  through.until(0.016);
  through.model.restart();
  const core::Checkpoint middle = through.model.checkpoint();
  EXPECT_GT(through.model.feeding()->all(), 2);
  again.model.resume(middle);
  for (Beads* run : {&through, &again}) run->steps(800);
  EXPECT_GT(through.model.feeding()->all(), 4);
  expect_same(again.model.checkpoint(), through.model.checkpoint());
}

}  // namespace
}  // namespace polybed::scenes
