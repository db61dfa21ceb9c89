// A tabulated function of the solids fraction: monotone, C1, bounded outside its range.
#pragma once

#include <vector>

#include "closures/stress_frictional.hpp"

namespace polybed::closures {

/// Piecewise cubic through knots that preserves their order: slopes of Fritsch and Carlson (SIAM J. Numer. Anal. 17,
/// 1980, 238-246) as weighted harmonic means (Brodlie), 0 at both ends, so that it is C1 with constant values outside.
class MonotoneCurve {
 public:
  MonotoneCurve() = default;
  /// \param x  strictly increasing, at least two  \param y  the same number of finite values
  /// Throws std::invalid_argument otherwise.
  MonotoneCurve(std::vector<double> x, std::vector<double> y);

  /// Value and slope at any x; beyond the ends the end's value and slope 0.
  [[nodiscard]] StressValue operator()(double x) const;

  [[nodiscard]] double first() const { return x_.front(); }
  [[nodiscard]] double last() const { return x_.back(); }

  /// Whether it increases strictly on a grid ten times finer than its knots.
  [[nodiscard]] bool increases() const;

 private:
  std::vector<double> x_, y_, slope_;
};

}  // namespace polybed::closures
