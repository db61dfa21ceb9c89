// Damping ratio of contacts whose restitution is known only when they begin.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "closures/restitution.hpp"

namespace polybed::dem {

/// beta over L = -ln e, at most L = -ln 0.05 for a clipped tail (closures/restitution.hpp): linear between 512 entries,
/// to 2e-6; for a kept tail the closed form L/sqrt(pi^2 + L^2).
class DampingTable {
 public:
  explicit DampingTable(bool clipped) : clipped_(clipped) {
    for (std::size_t n = 0; n < beta_.size(); ++n)
      beta_[n] = closures::damping_ratio_clipped(std::exp(-most * double(n) / intervals));
  }
  /// \param log  L, 0 or above; infinite: no rebound, or the least that the law allows
  [[nodiscard]] double operator()(double log) const {
    if (!clipped_) return std::isinf(log) ? 1 : log / std::sqrt(std::numbers::pi * std::numbers::pi + log * log);
    if (log >= most) return beta_.back();
    const double place = log * (intervals / most);
    const auto n = std::size_t(place);
    return beta_[n] + (place - double(n)) * (beta_[n + 1] - beta_[n]);
  }
  [[nodiscard]] double greatest() const { return (*this)(std::numeric_limits<double>::infinity()); }

 private:
  static constexpr double intervals = 512, most = 2.99573227355399099;  ///< -ln of least_restitution_clipped
  std::array<double, 513> beta_{};
  bool clipped_;
};

}  // namespace polybed::dem
