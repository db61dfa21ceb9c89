#include "closures/pair_distribution.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

namespace polybed::closures {

namespace {

using Complex = std::complex<double>;

/// int_0^D s^n exp(-i k s) ds of n = 1, 2.
std::array<Complex, 2> moments(double k, double d) {
  const double x = k * d;
  if (x > 1) {
    const Complex ik(0, k), end = std::exp(Complex(0, -x));
    const Complex first = ((1.0 - end) / ik - d * end) / ik;
    return {first, (2.0 * first - d * d * end) / ik};
  }
  // The closed form subtracts; the terms of the series fall at least as 1/m!.
  constexpr int terms = 20;
  Complex first = 0, second = 0, power = 1;
  for (int m = 0; m < terms; ++m) {
    first += power / double(m + 2);
    second += power / double(m + 3);
    power *= Complex(0, -x) / double(m + 1);
  }
  return {first * d * d, second * d * d * d};
}

}  // namespace

double exclusion_spectrum(double k, double contact) {
  const double x = k * contact, volume = 4 * std::numbers::pi * contact * contact * contact;
  constexpr double small = 1e-2;  // below it the series, whose next term is x^4/280, errs less than the difference
  if (x < small) return -volume * (1 - 0.1 * x * x) / 3;
  return -volume * (std::sin(x) - x * std::cos(x)) / (x * x * x);
}

PercusYevick::PercusYevick(std::span<const double> fraction, std::span<const double> diameter) {
  const auto count = Eigen::Index(diameter.size());
  diameter_ = Eigen::Map<const Eigen::VectorXd>(diameter.data(), count);
  const Eigen::ArrayXd d = diameter_.array(), phi = Eigen::Map<const Eigen::VectorXd>(fraction.data(), count);
  number_ = phi / (std::numbers::pi / 6 * d.cube());
  const double free = 1 - phi.sum(), squares = (phi / d).sum();  // 1 - xi_3, xi_2
  a_ = (free + 3 * d * squares) / (free * free);
  b_ = -1.5 * d.square() * squares / (free * free);
}

Complex PercusYevick::factor(double k, Eigen::Index i, Eigen::Index j) const {
  // With s = R_ij - r, from 0 to D_j: Q = a_i s^2/2 - (a_i R_ij + b_i) s.
  const double contact = 0.5 * (diameter_[i] + diameter_[j]);
  const auto [first, second] = moments(k, diameter_[j]);
  const Complex integral =
      std::exp(Complex(0, k * contact)) * (0.5 * a_[i] * second - (a_[i] * contact + b_[i]) * first);
  return (i == j ? 1.0 : 0.0) - 2 * std::numbers::pi * std::sqrt(number_[i] * number_[j]) * integral;
}

Eigen::MatrixXd PercusYevick::spectrum(double k) const {
  const Eigen::Index count = diameter_.size();
  Eigen::MatrixXcd q(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) q(i, j) = factor(k, i, j);
  // q(-k) is the conjugate of q(k): Q is real.
  Eigen::MatrixXd h = (q.adjoint() * q).inverse().real() - Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) h(i, j) /= std::sqrt(number_[i] * number_[j]);
  return h;
}

}  // namespace polybed::closures
