// Forms of drag laws with constants of a fit, and laws that are moved.
#include "closures/drag_form.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace polybed::closures {
namespace {

std::map<std::string, double> published(const DragForm& form) {
  std::map<std::string, double> constants;
  for (const DragFormConstant& c : form.constants) constants[c.name] = c.published;
  return constants;
}

struct Sample {
  double eps;
  std::vector<double> share, diameter, slip;
};

const std::vector<Sample> samples{{0.30, {0.4, 0.6}, {1, 2.5}, {0.1, 0.2}},
                                  {0.45, {0.2, 0.3, 0.5}, {1, 2, 3}, {20, 30, 50}},
                                  {0.85, {0.5, 0.5}, {1, 4}, {5, 9000}},
                                  {1, {1}, {1}, {7}}};

std::vector<double> of_mixture(const DragLaw& law, const Sample& m) {
  std::vector<double> f(m.share.size()), slope(m.share.size());
  drag_of_mixture(law, m.eps, m.share, m.diameter, m.slip, 1, 1, f, slope);
  return f;
}

/// The same by the batch of cells.
std::vector<double> of_cells(const DragLaw& law, const Sample& m) {
  std::vector<double> f(m.share.size());
  std::vector<const double*> share, slip;
  std::vector<double*> out;
  for (std::size_t j = 0; j < f.size(); ++j) {
    share.push_back(&m.share[j]);
    slip.push_back(&m.slip[j]);
    out.push_back(&f[j]);
  }
  GuardCount count;
  drag_of_cells(law, {&m.eps, 1}, share, slip, m.diameter, 1, 1, out, count);
  return f;
}

/// The same by the batch of particles.
std::vector<double> of_particles(const DragLaw& law, const Sample& m) {
  const Composition sum = composition_of(m.share, m.diameter);
  const std::size_t n = m.share.size();
  const std::vector<double> eps(n, m.eps), per_mean(n, sum.per_mean), average(n, sum.average),
      square(n, sum.per_square);
  std::vector<double> f(n);
  GuardCount count;
  drag_of_particles(law, eps, per_mean, average, square, sum.largest, m.share, m.diameter, m.slip, 1, 1, f, count);
  return f;
}

TEST(DragForm, WithPublishedConstantsIsThePublishedLaw) {
  for (const DragForm& form : drag_forms())
    for (const Guard guard : {Guard::on, Guard::off}) {
      const DragLaw fitted = fitted_drag_law(form.name, published(form), guard), law = drag_law(form.name, guard);
      for (const Sample& m : samples) {
        const std::vector<double> expected = of_mixture(law, m), by_form = of_mixture(fitted, m);
        const std::vector<double> cells = of_cells(fitted, m), particles = of_particles(fitted, m);
        for (std::size_t j = 0; j < expected.size(); ++j) {  // the compiler folds known constants: a rounding or two
          EXPECT_NEAR(by_form[j] / expected[j], 1, 1e-13) << form.name;
          EXPECT_NEAR(cells[j] / expected[j], 1, 1e-13) << form.name;
          EXPECT_NEAR(particles[j] / expected[j], 1, 1e-13) << form.name;
        }
      }
    }
}

TEST(DragForm, EveryConstantActs) {
  for (const DragForm& form : drag_forms())
    for (const DragFormConstant& c : form.constants) {
      std::map<std::string, double> constants = published(form);
      constants[c.name] *= 1.1;
      const DragLaw law = fitted_drag_law(form.name, published(form), Guard::on),
                    other = fitted_drag_law(form.name, constants, Guard::on);
      double most = 0;
      for (const Sample& m : samples) {
        const std::vector<double> a = of_mixture(law, m), b = of_mixture(other, m);
        for (std::size_t j = 0; j < a.size(); ++j) most = std::max(most, std::abs(b[j] / a[j] - 1));
      }
      EXPECT_GT(most, 1e-9) << form.name << " " << c.name;
    }
}

TEST(DragForm, RefusesWrongConstants) {
  const DragForm form = drag_forms().front();
  const auto refused = [&](const std::map<std::string, double>& constants) {
    EXPECT_THROW((void)fitted_drag_law(form.name, constants, Guard::on), std::invalid_argument);
  };
  auto constants = published(form);
  constants["k1_linear"] = -1;
  refused(constants);
  constants.erase("k1_linear");
  refused(constants);
  constants = published(form);
  constants["k1_lineal"] = 1;
  refused(constants);
  EXPECT_THROW((void)fitted_drag_law("ergun", {}, Guard::on), std::invalid_argument);
}

TEST(DragForm, UnusableLawsAreFound) {
  for (const DragForm& form : drag_forms()) {
    EXPECT_FALSE(unusable_at(fitted_drag_law(form.name, published(form), Guard::on))) << form.name;
    auto constants = published(form);
    if (form.name == "cello") {
      constants["k3_voidage"] *= 5;  // K3 below 0: the force falls as the velocity rises
      const auto at = unusable_at(fitted_drag_law(form.name, constants, Guard::on));
      ASSERT_TRUE(at);
      EXPECT_LT(at->voidage, 1);
    }
  }
}

TEST(MovedLaw, CommonFactorAndTilt) {
  for (const auto& [name, partition] :
       {std::pair{"cello", "none"}, {"brinkman_oseen", "none"}, {"wen_yu", "brinkman_oseen"}, {"vbk", "vbk_theory"}}) {
    const DragLaw law = drag_law(name, partition, Guard::on);
    DragLaw moved = law;
    moved.common = 1.04;
    moved.tilt = -0.02;
    for (const Sample& m : samples) {
      const std::vector<double> plain = of_mixture(law, m), f = of_mixture(moved, m), cells = of_cells(moved, m),
                                particles = of_particles(moved, m);
      const double mean = sauter_diameter(m.share, m.diameter);
      for (std::size_t j = 0; j < f.size(); ++j) {
        const double expected = plain[j] * 1.04 * (1 - 0.02 * (m.diameter[j] / mean - 1));
        EXPECT_NEAR(f[j] / expected, 1, 1e-14) << name;
        EXPECT_NEAR(cells[j] / expected, 1, 1e-13) << name;
        EXPECT_NEAR(particles[j] / expected, 1, 1e-13) << name;
      }
    }
    EXPECT_NEAR(pure_drag_at(moved, 0.6, 20), 1.04 * pure_drag_at(law, 0.6, 20), 1e-12);
  }
}

TEST(MovedLaw, TiltKeepsTheSumWhereForcesGoAsDiameters) {
  DragLaw moved = drag_law("vbk", "vbk_theory", Guard::on);
  const Sample m{0.5, {0.3, 0.7}, {1, 3}, {10, 10}};
  const double mean = sauter_diameter(m.share, m.diameter);
  const auto sum = [&] {
    const std::vector<double> f = of_mixture(moved, m);
    double total = 0;
    for (std::size_t j = 0; j < 2; ++j) total += m.share[j] * f[j] * mean * mean / (m.diameter[j] * m.diameter[j]);
    return total;
  };
  const double before = sum();
  moved.tilt = 0.05;
  EXPECT_NEAR(sum() / before, 1, 1e-14);
}

}  // namespace
}  // namespace polybed::closures
