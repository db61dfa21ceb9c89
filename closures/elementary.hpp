// Exponential, logarithm, power and arctangent from + - * /, roots and bits alone, without branches: loops over them
// are vectorised, unlike loops over the functions in <cmath>.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace polybed::closures {

/// ln x for x from 1e-300 to 1e300, to 5e-16 of the greater of 1 and the result: x = 2^n m with m
/// within a factor sqrt 2 of 1, and the series of 2 artanh((m-1)/(m+1)).
[[nodiscard]] inline double plain_log(double x) {
  constexpr std::uint64_t sqrt_half = 0x3fe6a09e667f3bcd, one = 0x3ff0000000000000, low = 0x000fffffffffffff;
  constexpr double shift = 0x1p52;
  // The exponent of x/sqrt(1/2) as an integer, converted to a double through the bits of 2^52 + n.
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) - sqrt_half + one;
  const double n = std::bit_cast<double>((bits >> 52) | std::bit_cast<std::uint64_t>(shift)) - (shift + 1023);
  const double m = std::bit_cast<double>((bits & low) + sqrt_half);
  const double s = (m - 1) / (m + 1), q = s * s;
  // In pairs rather than by Horner's rule: a single call then waits for fewer products.
  const double q2 = q * q, q4 = q2 * q2;
  const double low_half = (1.0 / 3 + q * (1.0 / 5)) + q2 * (1.0 / 7 + q * (1.0 / 9));
  const double high_half = (1.0 / 11 + q * (1.0 / 13)) + q2 * (1.0 / 15 + q * (1.0 / 17));
  const double series = q * (low_half + q4 * high_half);
  constexpr double ln2_high = 0x1.62e42fefa3800p-1, ln2_low = 0x1.ef35793c76730p-45;
  return n * ln2_high + (2 * s + (2 * s * series + n * ln2_low));
}

/// e^x for x from -700 to 700, to 5e-16 relative: x = n ln 2 + r, and Taylor's series of e^r.
[[nodiscard]] inline double plain_exp(double x) {
  constexpr double shift = 0x1.8p52, per_ln2 = 0x1.71547652b82fep0;
  constexpr double ln2_high = 0x1.62e42fefa3800p-1, ln2_low = 0x1.ef35793c76730p-45;
  const double shifted = x * per_ln2 + shift, n = shifted - shift;
  const double r = (x - n * ln2_high) - n * ln2_low;
  const double r2 = r * r, r4 = r2 * r2;
  const double first = (1 + r) + r2 * (0.5 + r * (1.0 / 6));
  const double second = (1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720 + r * (1.0 / 5040));
  const double third = (1.0 / 40320 + r * (1.0 / 362880)) + r2 * (1.0 / 3628800 + r * (1.0 / 39916800));
  const double series = first + r4 * (second + r4 * (third + r4 * (1.0 / 479001600)));
  const std::uint64_t power = (std::bit_cast<std::uint64_t>(shifted) + 1023) << 52;
  return series * std::bit_cast<double>(power);
}

/// x^p for x from 1e-60 to 1e60 and p from -4 to 5, to 4e-13 relative, to 3e-15 for x from 0.1 to 10. For smaller x,
/// and 0, x times a finite number; NaN for NaN.
[[nodiscard]] inline double plain_power(double x, double p) {
  return x * plain_exp((p - 1) * plain_log(std::max(x, 1e-60)));
}

/// arctan x, to 8e-16 relative: from 1/x for x > 1, with a short series for a quarter of the angle.
[[nodiscard]] inline double plain_arctan(double x) {
  const double size = std::abs(x), whole = std::min(size, 1.0) / std::max(size, 1.0);
  const double half = whole / (1 + std::sqrt(1 + whole * whole)), t = half / (1 + std::sqrt(1 + half * half));
  const double q = t * t, q2 = q * q, q4 = q2 * q2;  // at most 0.04
  const double low = (1.0 - q * (1.0 / 3)) + q2 * (1.0 / 5 - q * (1.0 / 7));
  const double middle = (1.0 / 9 - q * (1.0 / 11)) + q2 * (1.0 / 13 - q * (1.0 / 15));
  const double high = (1.0 / 17 - q * (1.0 / 19)) + q2 * (1.0 / 21);
  const double angle = 4 * (t * (low + q4 * (middle + q4 * high)));
  return std::copysign(size > 1 ? 0.5 * std::numbers::pi - angle : angle, x);
}

}  // namespace polybed::closures
