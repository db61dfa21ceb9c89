// What a particle counts for in the averages around it: alone, and among others of an equilibrium mixture.
#include "dem/coupling/own_share.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cloud.hpp"
#include "dem/coupling/scatter.hpp"

namespace polybed::dem::test {
namespace {

/// Averages of a cloud under a kernel, and what its particles see of them.
struct Averaged {
  Cloud& cloud;
  fluid::Smoothing smoothing;
  std::vector<core::Field> fraction;
  Gather gather;
  OwnShare own;

  Averaged(Cloud& given, double width)
      : cloud(given),
        smoothing(given.grid, width, true),
        fraction(2, core::make_field(given.grid)),
        gather(given.grid, {0.5e-3, 1.1e-3}),
        own(given.grid, smoothing, {0.5e-3, 1.1e-3}, true) {
    renew();
  }
  void renew() {
    Scatter scatter(cloud.grid, cloud.grid, cloud.materials, false, cloud.volume, 0.2);
    fluid::ParticlePhase phase(cloud.grid, false);
    scatter.collect(cloud.particles, cloud.loads, 1e-3);
    scatter.give(nullptr, nullptr, false, phase, fraction);
    for (core::Field& phi : fraction) smoothing.smooth_cells(phi);
    gather.take(fraction, core::make_face_field(cloud.grid), core::make_face_field(cloud.grid));
    own.take(fraction);
  }
  [[nodiscard]] Surroundings seen(const Vector& x, std::int32_t species) const {
    return gather.solids(gather.lines(x), species);
  }
  [[nodiscard]] Surroundings without(const Vector& x, std::int32_t species) const {
    const Lines lines = gather.lines(x);
    return own.without(gather.solids(lines, species), lines, species);
  }
};

// Its volume times the kernel at its own place is all there is: at any place in its cell, beside a wall, under a kernel
// and with bilinear weights alone.
TEST(OwnShare, IsAllThatAParticleAloneSees) {
  for (const int dimensions : {2, 3})
    for (const bool periodic : {false, true})
      for (const double width : {0.0, 4e-3})
        for (const Vector& x : {Vector{5.2e-3, 4.1e-3, 4.7e-3}, {0.6e-3, 9.4e-3, 7.4e-3}, {11.9e-3, 0.6e-3, 0.7e-3}}) {
          Cloud cloud(cloud_scene(dimensions, periodic));
          cloud.add(1, x);
          const Averaged around(cloud, width);
          const double kernel = around.own.weight(around.gather.lines(x));
          // Sums stand in units of 2^-62 of 64 times the volume; and 16 steps of the kernel.
          EXPECT_NEAR(around.seen(x, 1).fraction / (cloud.volume * kernel), 1, 1e-12) << dimensions << width;
          const Lines lines = around.gather.lines(x);
          const auto left = [&](double inside) {
            return around.own.without(around.seen(x, 1), lines, 1, inside).fraction;
          };
          EXPECT_NEAR(left(0.25), 0.75 * left(0) + 0.25 * left(1), 1e-12 * left(0));
          const double square = around.gather.per_square(lines);
          EXPECT_NEAR(square * 1.1e-3 * 1.1e-3, around.seen(x, 1).fraction, 1e-12 * around.seen(x, 1).fraction);
          EXPECT_NEAR(around.own.per_square_without(square, lines, 1) * 1.1e-3 * 1.1e-3, around.without(x, 1).fraction,
                      1e-12 * around.seen(x, 1).fraction);
        }
}

/// Spheres that do not overlap: moved one by one by up to 0.2 mm where there is room (Metropolis), across x and z
/// around.
class Mixture {
 public:
  Mixture(Cloud& cloud, std::array<int, 2> numbers) : cloud_(cloud) {
    for (const int species : {1, 0})  // the large ones first, while there is room
      for (int n = 0; n < numbers[std::size_t(species)];) {
        const double r = cloud.materials.species()[std::size_t(species)].radius;
        Vector x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = one_(random_) * size_[k];
        if (!free(x, r, cloud.particles.size())) continue;
        cloud.add(species, x);
        ++n;
      }
  }
  void sweep() {
    for (std::size_t i = 0; i < cloud_.particles.owned; ++i) {
      Place& place = cloud_.particles.place[i];
      Vector x = place.x;
      for (std::size_t k = 0; k < 3; ++k) x[k] += 0.4e-3 * (one_(random_) - 0.5);
      for (const std::size_t k : {0, 2}) x[k] -= std::floor(x[k] / size_[k]) * size_[k];
      if (free(x, place.radius, i)) place.x = x;
    }
  }
  [[nodiscard]] double random() { return one_(random_); }

 private:
  [[nodiscard]] bool free(const Vector& x, double r, std::size_t self) const {
    if (x[1] < r || x[1] > size_[1] - r) return false;
    for (std::size_t j = 0; j < cloud_.particles.owned; ++j) {
      const Place& other = cloud_.particles.place[j];
      double square = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        double d = std::abs(x[k] - other.x[k]);
        if (k != 1) d = std::min(d, size_[k] - d);
        square += d * d;
      }
      if (j != self && square < (r + other.radius) * (r + other.radius)) return false;
    }
    return true;
  }
  Cloud& cloud_;
  Vector size_{12e-3, 10e-3, 8e-3};
  std::mt19937_64 random_{3};
  std::uniform_real_distribution<double> one_{0, 1};
};

// 20 % of solids, half of it coarse, under a kernel of 3 coarse diameters: what particles of both sizes see without
// themselves is what is seen from anywhere; with themselves, the coarse ones see 1.5 % more. 400 pictures give 1.0008
// and 0.9984 without, 0.9971 and 1.0154 with themselves; 120 scatter by half a per cent. Of a box with so many and no
// more particles, one that is counted is missing elsewhere: 0.1 %.
TEST(OwnShare, LeavesTheMeanOfAMixture) {
  Cloud cloud(cloud_scene(3, true));
  Mixture mixture(cloud, {1467, 138});
  Averaged around(cloud, 3.3e-3);
  constexpr int pictures = 120;
  std::array<double, 2> kept{}, removed{}, anywhere{}, own{}, own_anywhere{}, counted{};
  for (int n = 0; n < pictures; ++n) {
    for (int k = 0; k < (n == 0 ? 20 : 2); ++k) mixture.sweep();
    around.renew();
    for (std::size_t i = 0; i < cloud.particles.owned; ++i) {
      const Vector& x = cloud.particles.place[i].x;
      if (std::abs(x[1] - 5e-3) > 2e-3) continue;  // away from bottom and top
      const auto j = std::size_t(cloud.particles.species[i]);
      const Surroundings other =
          around.seen({mixture.random() * 12e-3, x[1], mixture.random() * 8e-3}, std::int32_t(j));
      kept[j] += around.seen(x, std::int32_t(j)).fraction;
      removed[j] += around.without(x, std::int32_t(j)).fraction;
      own[j] += around.without(x, std::int32_t(j)).own;
      anywhere[j] += other.fraction;
      own_anywhere[j] += other.own;
      ++counted[j];
    }
  }
  for (std::size_t j = 0; j < 2; ++j) {
    RecordProperty(fmt::format("species {}", j),
                   fmt::format("kept {:.4f}, removed {:.4f}, own {:.4f}", kept[j] / anywhere[j],
                               removed[j] / anywhere[j], own[j] / own_anywhere[j]));
    EXPECT_NEAR(removed[j] / anywhere[j], 1, 0.01) << j;
    EXPECT_NEAR(own[j] / own_anywhere[j], 1, 0.02) << j;
  }
  EXPECT_GT(kept[1] / anywhere[1], 1.01);
}

}  // namespace
}  // namespace polybed::dem::test
