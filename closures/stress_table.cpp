#include "closures/stress_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace polybed::closures {

MonotoneCurve::MonotoneCurve(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(x_.size(), 0.0) {
  if (x_.size() < 2 || x_.size() != y_.size())
    throw std::invalid_argument("a table needs two knots or more, and as many values");
  for (std::size_t n = 0; n < x_.size(); ++n)
    if (!std::isfinite(x_[n]) || !std::isfinite(y_[n]) || (n > 0 && !(x_[n] > x_[n - 1])))
      throw std::invalid_argument("the knots of a table must rise, and its values be finite");
  for (std::size_t n = 1; n + 1 < x_.size(); ++n) {
    const double before = x_[n] - x_[n - 1], after = x_[n + 1] - x_[n];
    const double below = (y_[n] - y_[n - 1]) / before, above = (y_[n + 1] - y_[n]) / after;
    if (below * above > 0) {
      const double weight = (before + 2 * after) / (3 * (before + after));
      slope_[n] = below * above / (weight * above + (1 - weight) * below);
    }
  }
}

StressValue MonotoneCurve::operator()(double x) const {
  if (!(x > x_.front())) return {y_.front(), 0};
  if (x >= x_.back()) return {y_.back(), 0};
  const auto n = std::size_t(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;
  const double h = x_[n + 1] - x_[n], t = (x - x_[n]) / h, rise = y_[n + 1] - y_[n];
  const double m0 = h * slope_[n], m1 = h * slope_[n + 1];
  const double a = m0 + m1 - 2 * rise, b = 3 * rise - 2 * m0 - m1;
  return {y_[n] + t * (m0 + t * (b + t * a)), (m0 + t * (2 * b + t * 3 * a)) / h};
}

bool MonotoneCurve::increases() const {
  double last = y_.front();
  for (std::size_t n = 0; n + 1 < x_.size(); ++n)
    for (int k = 1; k <= 10; ++k) {
      const double here = k == 10 ? y_[n + 1] : (*this)(x_[n] + 0.1 * k * (x_[n + 1] - x_[n])).pressure;
      if (!(here > last)) return false;
      last = here;
    }
  return true;
}

}  // namespace polybed::closures
