// Mean law and partition apart: every pair, and what it must keep.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "closures/drag.hpp"

namespace polybed::closures {
namespace {

struct Mixture {
  double eps;
  std::vector<double> share, diameter, slip;  ///< density and viscosity 1
};

Mixture random_mixture(std::mt19937_64& random, bool common_slip) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::size_t species = 2 + std::size_t(3 * uniform(random));
  Mixture m{0.4 + 0.6 * uniform(random), {}, {}, {}};
  double sum = 0;
  for (std::size_t j = 0; j < species; ++j) {
    m.share.push_back(0.01 + uniform(random));
    m.diameter.push_back(std::pow(4.0, uniform(random)));
    m.slip.push_back(common_slip && j > 0 ? m.slip[0] : std::pow(10.0, 4 * uniform(random) - 2));
    sum += m.share.back();
  }
  for (double& x : m.share) x /= sum;
  return m;
}

struct Answer {
  std::vector<double> f, slope;
};

Answer answer(const DragLaw& law, const Mixture& m) {
  Answer a{std::vector<double>(m.share.size()), std::vector<double>(m.share.size())};
  drag_of_mixture(law, m.eps, m.share, m.diameter, m.slip, 1, 1, a.f, a.slope);
  return a;
}

std::vector<std::string> means() {
  std::vector<std::string> names;
  for (const DragLawInfo& law : drag_laws())
    if (law.is_mean) names.push_back(law.name);
  return names;
}

using Pair = std::tuple<std::string, std::string>;

std::vector<std::string> partition_names() {
  std::vector<std::string> names;
  for (const DragLawInfo& partition : partitions()) names.push_back(partition.name);
  return names;
}

class EveryPair : public testing::TestWithParam<Pair> {
 protected:
  [[nodiscard]] std::string mean() const { return std::get<0>(GetParam()); }
  [[nodiscard]] std::string partition() const { return std::get<1>(GetParam()); }
  [[nodiscard]] DragLaw law() const { return drag_law(mean(), partition(), Guard::on); }
};

// f_j = f_mean(eps, Re_m) f_j^part/f_one^part(eps, Re_m), from the laws of mixtures that the partitions are named for.
TEST_P(EveryPair, IsTheMeanTimesTheShareOfItsPartition) {
  std::mt19937_64 random(1);
  const DragLaw pair = law(), whole = drag_law(partition(), Guard::on), of_mean = drag_law(mean(), Guard::on);
  for (int n = 0; n < 50; ++n) {
    const Mixture m = random_mixture(random, false);
    const Answer shared = answer(pair, m), part = answer(whole, m);
    const double sauter = sauter_diameter(m.share, m.diameter);
    for (std::size_t j = 0; j < m.share.size(); ++j) {
      const double re = m.slip[j] * sauter;
      const double expected = pure_drag_at(of_mean, m.eps, re) * part.f[j] / pure_drag_at(whole, m.eps, re);
      EXPECT_NEAR(shared.f[j], expected, 1e-12 * expected);  // a few roundings, those of Re included
    }
  }
}

TEST_P(EveryPair, OfOneSizeIsTheMeanLaw) {
  for (const double eps : {0.4, 0.7, 1.0})
    for (const double re : {0.0, 0.1, 30.0, 900.0}) {
      const double expected = pure_drag_at(drag_law(mean(), Guard::on), eps, re);
      const double share = partition() == "vbk_corrected" ? 1.064 : 1;  // y + 0.064 y^3 at y = 1
      const Answer a = answer(law(), {eps, {0.3, 0.7}, {2, 2}, {re / 2, re / 2}});
      for (const double f : a.f) EXPECT_NEAR(f, share * expected, 1e-12 * expected);
      EXPECT_EQ(pure_drag_at(law(), eps, re), expected);
    }
}

TEST_P(EveryPair, DerivativeIsThatOfThePair) {
  std::mt19937_64 random(2);
  for (int n = 0; n < 50; ++n) {
    const Mixture m = random_mixture(random, false);
    const double step = 1e-5;
    Mixture up = m, down = m;
    for (double& u : up.slip) u *= 1 + step;
    for (double& u : down.slip) u *= 1 - step;
    const Answer here = answer(law(), m), above = answer(law(), up), below = answer(law(), down);
    for (std::size_t j = 0; j < m.share.size(); ++j)  // central differences: truncation 1e-10, round-off 1e-11 of f
      EXPECT_NEAR((above.f[j] - below.f[j]) / (2 * step), here.slope[j], 1e-6 * (here.f[j] + std::abs(here.slope[j])));
  }
}

TEST_P(EveryPair, BatchesAreThoseOfSingleMixtures) {
  constexpr std::size_t cells = 200;  // more than are worked on together, and not a multiple of that
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  const std::vector<double> diameter{1e-3, 3e-3};
  std::vector<double> eps(cells), x1(cells), x2(cells), u1(cells), u2(cells), f1(cells), f2(cells);
  std::vector<double> per_mean(cells), average(cells), per_square(cells), size(cells, diameter[1]), f(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    eps[c] = c == 0 ? 1 + 1e-9 : 0.3 + 0.7 * uniform(random);
    x1[c] = c == 1 ? 0 : uniform(random);
    x2[c] = 1 - x1[c];
    u1[c] = c == 2 ? 0 : std::pow(10.0, 4 * uniform(random) - 4);
    u2[c] = std::pow(10.0, 4 * uniform(random) - 4);
    const Composition sum = composition_of(std::vector{x1[c], x2[c]}, diameter);
    per_mean[c] = sum.per_mean;
    average[c] = sum.average;
    per_square[c] = sum.per_square;
  }
  const std::vector<const double*> share{x1.data(), x2.data()}, slip{u1.data(), u2.data()};
  const std::vector<double*> result{f1.data(), f2.data()};
  GuardCount count, of_particles;
  drag_of_cells(law(), eps, share, slip, diameter, 1000, 1e-3, result, count);
  EXPECT_EQ(count.evaluations, 2 * cells);
  drag_of_particles(law(), eps, per_mean, average, per_square, diameter[1], x2, size, u2, 1000, 1e-3, f, of_particles);
  EXPECT_EQ(of_particles.evaluations, cells);
  for (std::size_t c = 0; c < cells; ++c) {
    std::vector<double> single(2), slope(2);
    drag_of_mixture(law(), eps[c], std::vector{x1[c], x2[c]}, diameter, std::vector{u1[c], u2[c]}, 1000, 1e-3, single,
                    slope);
    EXPECT_NEAR(f1[c], single[0], 1e-12 * single[0]) << c;  // round-off of Re
    EXPECT_NEAR(f2[c], single[1], 1e-12 * single[1]) << c;
    EXPECT_NEAR(f[c], single[1], 1e-12 * single[1]) << c;
  }
}

TEST_P(EveryPair, SplittingOrPermutingSpeciesChangesNothing) {
  std::mt19937_64 random(4);
  for (int n = 0; n < 50; ++n) {
    const Mixture m = random_mixture(random, false);
    Mixture split = m;
    split.share.insert(split.share.begin(), 0.3 * m.share.back());
    split.diameter.insert(split.diameter.begin(), m.diameter.back());
    split.slip.insert(split.slip.begin(), m.slip.back());
    split.share.back() *= 0.7;
    const Answer whole = answer(law(), m), parts = answer(law(), split);
    EXPECT_NEAR(parts.f.front(), whole.f.back(), 1e-12 * whole.f.back());
    for (std::size_t j = 0; j < m.share.size(); ++j) EXPECT_NEAR(parts.f[j + 1], whole.f[j], 1e-12 * whole.f[j]);
  }
}

INSTANTIATE_TEST_SUITE_P(Drag, EveryPair,
                         testing::Combine(testing::ValuesIn(means()), testing::ValuesIn(partition_names())));

TEST(Partition, TheSumRuleHoldsWhereItIsSaidTo) {
  std::mt19937_64 random(5);
  double most_of_corrected = 0, most_of_yin = 0, most_of_brinkman = 0;
  for (int n = 0; n < 2000; ++n) {
    const Mixture m = random_mixture(random, true);
    const double re = m.slip[0] * sauter_diameter(m.share, m.diameter);
    const auto deviation = [&](const char* partition) {
      const DragLaw law = drag_law("wen_yu", partition, Guard::on);
      return std::abs(deviation_from_base(law, m.eps, re, m.share, m.diameter, answer(law, m).f));
    };
    EXPECT_LE(deviation("cello"), 1e-12);
    EXPECT_LE(deviation("vbk_theory"), 1e-12);
    most_of_corrected = std::max(most_of_corrected, deviation("vbk_corrected"));
    most_of_yin = std::max(most_of_yin, deviation("yin_sundaresan"));
    most_of_brinkman = std::max(most_of_brinkman, deviation("brinkman_oseen"));
  }
  for (const double most : {most_of_corrected, most_of_yin, most_of_brinkman}) EXPECT_GT(most, 0.01);
}

TEST(Partition, ThePairsOfTheLawsOfMixturesAreThoseLaws) {
  std::mt19937_64 random(6);
  const std::tuple<const char*, const char*, const char*> pairs[] = {
      {"cello", "cello", "cello"},
      {"vbk", "vbk_theory", "vbk_theory"},
      {"vbk", "vbk_corrected", "vbk_corrected"},
      {"cello", "yin_sundaresan", "yin_sundaresan"},
      {"brinkman_oseen", "brinkman_oseen", "brinkman_oseen"}};
  for (const auto& [mean, partition, name] : pairs) {
    const Mixture m = random_mixture(random, false);
    EXPECT_EQ(answer(drag_law(mean, partition, Guard::on), m).f, answer(drag_law(name, Guard::on), m).f) << name;
  }
  EXPECT_FALSE(drag_law("wen_yu", "none", Guard::on).partition);
}

TEST(Partition, WhatIsNoMeanOrNoPartitionIsRefused) {
  for (const char* law : {"vbk_theory", "vbk_corrected", "yin_sundaresan", "patwardhan_tien", "syamlal", "no_law"})
    EXPECT_THROW((void)drag_law(law, "cello", Guard::on), std::invalid_argument) << law;
  for (const char* partition : {"patwardhan_tien", "syamlal", "wen_yu", "no_law"})
    EXPECT_THROW((void)drag_law("wen_yu", partition, Guard::on), std::invalid_argument) << partition;
}

}  // namespace
}  // namespace polybed::closures
