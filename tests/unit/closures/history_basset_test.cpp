// The history force: kernels, the fit of its tail, and the scheme against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>

#include "closures/history_basset.hpp"

namespace polybed::closures {
namespace {

constexpr double d = 1e-3, nu = 1e-6, pi = std::numbers::pi;
constexpr double fit_error = 1.26e-3;  // of basset_tail_fitted, as its script prints: 1.2582e-3

/// The published ten (van Hinsberg et al. 2011). Greatest error of the kernel 0.7 % to t = 100, 3.4 % to 1000,
/// 10 % to 1e4, 45 % to 1e5.
inline constexpr BassetTail basset_tail_van_hinsberg{
    {0.1, 0.3, 1, 3, 10, 40, 190, 1000, 6500, 50000},
    {0.23477481312586, 0.28549576238194, 0.28479416718255, 0.26149775537574, 0.32056200511938, 0.35354490689146,
     0.39635904496921, 0.42253908596514, 0.48317384225265, 0.63661146557001}};

/// The sum, at t >= 1 in units of the window. Past t = 1e5 it falls below 1/sqrt(t): older slips are forgotten.
double basset_tail_kernel(const BassetTail& tail, double time) {
  double sum = 0;
  for (std::size_t i = 0; i < BassetTail::terms; ++i)
    sum += tail.share[i] * std::sqrt(std::numbers::e / tail.time[i]) * std::exp(-time / (2 * tail.time[i]));
  return sum;
}

/// Coefficient of the newest g, s^(1/2): (4/3) sqrt(h), and 0 at the very start.
template <std::size_t Window>
double basset_newest(const BassetWeights<Window>& weights, const BassetHistory<Window>& history) {
  return history.known > 0 ? weights.newer[0] : 0;
}

template <std::size_t Window>
Vec3 basset_force(double prefactor, const BassetWeights<Window>& weights, const BassetHistory<Window>& history,
                  const Vec3& acceleration) {
  return prefactor * (basset_newest(weights, history) * acceleration + basset_past(weights, history));
}

/// Sum over 1/sqrt at time `steps` h, of accelerations g(t) since t = 0, without the prefactor.
template <std::size_t Window, class Acceleration>
double history_at(const BassetTail& tail, double h, std::size_t steps, Acceleration&& g) {
  const auto weights = std::make_unique<BassetWeights<Window>>(basset_weights<Window>(tail, h));
  auto history = std::make_unique<BassetHistory<Window>>();
  for (std::size_t n = 0; n < steps; ++n) *history = basset_step(*weights, *history, {g(double(n) * h), 0, 0});
  return basset_force(1, *weights, *history, {g(double(steps) * h), 0, 0}).x;
}

/// Greatest relative error of a tail from 1 to a reach, at 2000 points equally spaced in log t.
double worst_of_tail(const BassetTail& tail, double reach) {
  double worst = 0;
  for (int n = 0; n <= 2000; ++n) {
    const double t = std::pow(reach, n / 2000.);
    worst = std::max(worst, std::abs(basset_tail_kernel(tail, t) * std::sqrt(t) - 1));
  }
  return worst;
}

TEST(HistoryKernel, ByHand) {
  // Computed apart from this code: t 10 ms, w 20 mm/s, Re_p 20.
  EXPECT_NEAR(history_kernel_basset(0.01, d, nu), 2.8209479177387813, 1e-14);
  EXPECT_NEAR(history_kernel_mei_adrian(0.01, d, nu, 0.02), 1.169016430538773, 1e-14);
  EXPECT_NEAR(basset_prefactor(d, 1000, 1e-3), 2.658680776358274e-06, 1e-20);
  // The prefactor is 3 pi mu d K sqrt(t).
  EXPECT_NEAR(3 * pi * 1e-3 * d * history_kernel_basset(0.01, d, nu) * 0.1, basset_prefactor(d, 1000, 1e-3), 1e-20);
}

TEST(HistoryKernel, MeiAndAdrianLieBelowBassetAndDecayFaster) {
  for (double t = 1e-6; t < 1e3; t *= 3) {
    // Without slip it is Basset's: round-off of square roots.
    EXPECT_NEAR(history_kernel_mei_adrian(t, d, nu, 0) / history_kernel_basset(t, d, nu), 1, 1e-14);
    for (const double w : {1e-5, 1e-3, 0.1}) {
      EXPECT_LT(history_kernel_mei_adrian(t, d, nu, w), history_kernel_basset(t, d, nu));
      EXPECT_LT(history_kernel_mei_adrian(2 * t, d, nu, w), history_kernel_mei_adrian(t, d, nu, w));
    }
  }
  // t^-1/2 first, t^-2 last; the other part is then below 1e-4 and 1e-3 of the one that rules.
  EXPECT_NEAR(history_kernel_mei_adrian(1e-10, d, nu, 0.01) / history_kernel_mei_adrian(1e-12, d, nu, 0.01), 0.1, 1e-4);
  EXPECT_NEAR(history_kernel_mei_adrian(1e6, d, nu, 0.01) / history_kernel_mei_adrian(1e5, d, nu, 0.01), 0.01, 1e-5);
}

TEST(HistoryTail, ErrorIsAsSaid) {
  // Both ways: the fits are no worse than said, and the published one is as bad as said.
  EXPECT_LT(worst_of_tail(basset_tail_fitted, 1e5), fit_error);
  EXPECT_LT(worst_of_tail(basset_tail_van_hinsberg, 100), 0.007);
  EXPECT_LT(worst_of_tail(basset_tail_van_hinsberg, 1e3), 0.034);
  EXPECT_LT(worst_of_tail(basset_tail_van_hinsberg, 1e4), 0.104);
  EXPECT_GT(worst_of_tail(basset_tail_van_hinsberg, 1e5), 0.4);
  // Past its reach it forgets: below 1/sqrt(t), and never negative.
  for (const double t : {1e6, 1e7, 1e9}) {
    EXPECT_LT(basset_tail_kernel(basset_tail_fitted, t), 1 / std::sqrt(t));
    EXPECT_GE(basset_tail_kernel(basset_tail_fitted, t), 0);
  }
}

TEST(HistoryTail, RampsByHandAndAcrossTheSwitch) {
  EXPECT_DOUBLE_EQ(ramps_of_exponential(0).falling, 0.5);
  EXPECT_DOUBLE_EQ(ramps_of_exponential(0).rising, 0.5);
  EXPECT_NEAR(ramps_of_exponential(1).falling, std::exp(-1.0), 1e-15);         // (1 - 1 + 1/e)/1
  EXPECT_NEAR(ramps_of_exponential(1).rising, 1 - 2 * std::exp(-1.0), 1e-15);  // 1 - 2/e
  for (const double z : {0.3, 1.0, 1.000001, 4.0})                             // their sum is (1 - e^-z)/z
    EXPECT_NEAR(ramps_of_exponential(z).falling + ramps_of_exponential(z).rising, -std::expm1(-z) / z, 1e-15);
}

TEST(HistoryScheme, WeightsByHand) {
  const auto w = basset_weights<2>(basset_tail_fitted, 0.25);
  EXPECT_NEAR(w.newer[0], 4. / 3 * 0.5, 1e-16);
  EXPECT_NEAR(w.older[0], 2. / 3 * 0.5, 1e-16);
  // int_1^2 (2 - s)/sqrt(s) ds = [4 sqrt s - (2/3) s^(3/2)] = (8/3) sqrt 2 - 10/3, and 2 sqrt 2 - 2 less that.
  EXPECT_NEAR(w.newer[1], 0.5 * (8. / 3 * std::sqrt(2.0) - 10. / 3), 1e-15);
  EXPECT_NEAR(w.older[1], 0.5 * (4. / 3 - 2. / 3 * std::sqrt(2.0)), 1e-15);
}

TEST(HistoryScheme, ConstantAccelerationWithinTheWindowIsExact) {
  // F = 3 d^2 sqrt(pi rho_f mu) a sqrt(t): twice the prefactor 1.5 d^2 sqrt(pi rho_f mu). d 1 mm, a 2 m/s2, water.
  const double h = 1e-4, prefactor = basset_prefactor(d, 1000, 1e-3), a = 2;
  const auto w = basset_weights<64>(basset_tail_fitted, h);
  BassetHistory<64> history;
  EXPECT_EQ(basset_newest(w, history), 0);
  EXPECT_EQ(basset_force(prefactor, w, history, {a, 0, 0}).x, 0);
  for (int n = 1; n <= 64; ++n) {
    history = basset_step(w, history, {a, 0, 0});
    const double expected = 3 * d * d * std::sqrt(pi * 1000 * 1e-3) * a * std::sqrt(n * h);
    EXPECT_NEAR(basset_force(prefactor, w, history, {a, 0, 0}).x, expected, 1e-14 * expected) << n;  // sum of 128
  }
  EXPECT_NEAR(basset_newest(w, history), 4. / 3 * std::sqrt(h), 1e-17);
}

TEST(HistoryScheme, LinearAccelerationWithinTheWindowIsExact) {
  // int_0^t s/sqrt(t - s) ds = (4/3) t^(3/2).
  EXPECT_NEAR(history_at<64>(basset_tail_fitted, 0.5, 50, [](double t) { return t; }), 4. / 3 * std::pow(25, 1.5),
              1e-13 * 4. / 3 * 125);
}

TEST(HistoryScheme, ConstantAccelerationBeyondTheWindow) {
  // 2 sqrt(t); the share outside the window has the error of the exponentials, no more.
  for (const std::size_t steps : {20, 100, 1000, 100000}) {
    const double exact = 2 * std::sqrt(double(steps));
    EXPECT_NEAR(history_at<10>(basset_tail_fitted, 1, steps, [](double) { return 1.; }), exact, fit_error * exact);
  }
  const double exact = 2 * std::sqrt(1000.);  // 100 windows: the published ten within their 0.7 %
  EXPECT_NEAR(history_at<10>(basset_tail_van_hinsberg, 1, 1000, [](double) { return 1.; }), exact, 7e-3 * exact);
  EXPECT_NEAR(history_at<1>(basset_tail_fitted, 1, 1000, [](double) { return 1.; }), exact, fit_error * exact);
}

/// sqrt(2 pi) C(2 sqrt(k)) = int_0^t cos(s)/sqrt(t - s) ds at t = 2 pi k; C the Fresnel integral, from SciPy.
constexpr double cosine_after_1 = 2.5066282746310002 * 0.48825340607534073,
                 cosine_after_10 = 2.5066282746310002 * 0.4995998717875205;

TEST(HistoryScheme, SecondOrderInASinusoidalSlip) {
  const auto error = [](std::size_t steps) {
    const auto cosine = [](double t) { return std::cos(t); };
    return std::abs(history_at<320>(basset_tail_fitted, 2 * pi / double(steps), steps, cosine) - cosine_after_1);
  };
  double last = error(20);
  for (const std::size_t steps : {40, 80, 160, 320}) {
    const double now = error(steps);
    EXPECT_NEAR(std::log2(last / now), 2, 0.15) << steps;  // order two; the next term is of order 2.5
    last = now;
  }
  EXPECT_LT(last, 1e-4);
}

template <std::size_t Window>
double error_with_tail(std::size_t per_period) {
  const auto cosine = [](double t) { return std::cos(t); };
  return history_at<Window>(basset_tail_fitted, 2 * pi / double(per_period), 10 * per_period, cosine) - cosine_after_10;
}

TEST(HistoryScheme, SecondOrderUntilTheTailShows) {
  // A window of a tenth of the period, nine tenths and nine periods more in exponentials: the error goes in second
  // order to that of the exponentials, which is the least that can be.
  const double error[] = {error_with_tail<2>(20), error_with_tail<4>(40), error_with_tail<8>(80),
                          error_with_tail<16>(160), error_with_tail<32>(320)};
  for (std::size_t n = 0; n + 2 < std::size(error); ++n)
    EXPECT_NEAR(std::log2((error[n] - error[n + 1]) / (error[n + 1] - error[n + 2])), 2, 0.15) << n;
  // Never more than its relative error times int |cos s|/sqrt(t - s) ds < 2 sqrt(20 pi), a bound of 0.02; as the signs
  // of the error alternate it is less than the same share of the force itself.
  EXPECT_LT(std::abs(error[4]), fit_error * cosine_after_10);
}

TEST(HistoryScheme, PastEqualsTheSameExponentialsSummedDirectly) {
  // Ten steps of a window of two: the sums carried on are the integral of the exponentials over the older eight steps.
  // g = 1: int_2^10 e^(-s/(2 T)) ds c = c 2 T (e^(-1/T) - e^(-5/T)), T = 2 t_i in units of the step.
  const auto w = basset_weights<2>(basset_tail_fitted, 1);
  BassetHistory<2> history;
  for (int n = 0; n < 10; ++n) history = basset_step(w, history, {1, -2, 0});
  for (std::size_t i = 0; i < BassetTail::terms; ++i) {
    const double time = 2 * basset_tail_fitted.time[i];
    const double exact = basset_tail_fitted.share[i] * std::sqrt(std::numbers::e / time) * 2 * time *
                         (std::exp(-1 / time) - std::exp(-5 / time));
    EXPECT_NEAR(history.tail[i].x, exact, 1e-11 * exact) << i;  // t_10 is 2e5 steps: the difference loses five digits
    EXPECT_DOUBLE_EQ(history.tail[i].y, -2 * history.tail[i].x);
    EXPECT_EQ(history.tail[i].z, 0);
  }
}

/// Relative error of dv/dt at 400 s of m dv/dt = F - B int (dv/ds)/sqrt(t - s) ds with B/m = 10 per sqrt(s), F/m = 1.
/// Exact: e^(x^2) erfc(x), x = (B/m) sqrt(pi t) = 354, thus (1 - 1/(2 x^2))/(x sqrt pi), by Laplace's transform.
double error_of_released_sphere(double h) {
  const double b = 10, x = b * std::sqrt(pi * 400), exact = (1 - 0.5 / (x * x)) / (x * std::sqrt(pi));
  const auto w = basset_weights<8>(basset_tail_fitted, h);
  BassetHistory<8> history;
  double rate = 0;
  for (int n = 0; n <= int(400 / h); ++n) {
    rate = (1 - b * basset_past(w, history).x) / (1 + b * basset_newest(w, history));
    history = basset_step(w, history, {rate, 0, 0});
  }
  return std::abs(rate / exact - 1);
}

TEST(HistoryScheme, StableWithTheNewestOnTheLeft) {
  // At h = 1 s the newest term is 13 times the mass, and the start, over in m^2/(pi B^2) = 3 ms, is not resolved: what
  // that leaves after 400 steps is below 1 %, and shrinks with the step.
  EXPECT_LT(error_of_released_sphere(1), 0.01);
  EXPECT_LT(error_of_released_sphere(0.25), 0.6 * error_of_released_sphere(1));
}

TEST(HistoryScheme, LaggingTheNewestDiverges) {
  const double b = 10;
  const auto w = basset_weights<8>(basset_tail_fitted, 1);
  BassetHistory<8> history;
  double rate = 0;
  for (int n = 0; n <= 40; ++n) {
    rate = 1 - b * (basset_past(w, history).x + basset_newest(w, history) * rate);
    history = basset_step(w, history, {rate, 0, 0});
  }
  EXPECT_GT(std::abs(rate), 1e20);
}

}  // namespace
}  // namespace polybed::closures
