#include "multiscale/inversion/scan.hpp"

#include <algorithm>
#include <cmath>

namespace polybed::multiscale {

namespace {

constexpr double widening = 1.25;  // of an end that does not enclose the zero
constexpr int most_widenings = 6;
constexpr double margin = 0.1;  // of the bracket, which a secant keeps from its ends

/// A velocity with all that its runs have told, and the last of them.
struct Point {
  double velocity = 0;
  ScanMean mean;
  std::size_t run = 0;
};

/// Mean of two runs at one velocity from different sides; half of what they differ by is unknown.
ScanMean both(const ScanMean& a, const ScanMean& b) {
  return {0.5 * (a.value + b.value), std::max(0.5 * std::hypot(a.error, b.error), 0.5 * std::abs(a.value - b.value))};
}

class Scan {
 public:
  explicit Scan(const RunAt& run) : run_(run) {}

  ScanResult search(const ScanRange& range) && {
    low_ = at(range.low, std::nullopt);
    high_ = at(range.high, low_.run);
    if (enclose())
      narrow();
    else
      result_.end = ScanEnd::not_found;
    result_.low = low_.velocity;
    result_.high = high_.velocity;
    return std::move(result_);
  }

 private:
  Point at(double velocity, std::optional<std::size_t> from) {
    const ScanMean mean = run_(velocity, from);
    result_.runs.push_back({velocity, from, mean});
    return {velocity, mean, result_.runs.size() - 1};
  }

  [[nodiscard]] bool enclosed() const {
    return low_.mean.certain() && high_.mean.certain() && low_.mean.value * high_.mean.value < 0;
  }

  /// Moves the end that is uncertain, or else the one nearer to zero, outwards; what it leaves is still inside.
  bool enclose() {
    for (int n = 0; !enclosed(); ++n) {
      if (n == most_widenings) return false;
      const bool up = high_.mean.certain() == low_.mean.certain()
                          ? std::abs(high_.mean.value) < std::abs(low_.mean.value)
                          : !high_.mean.certain();
      Point& end = up ? high_ : low_;
      const Point former = end;
      end = at(up ? end.velocity * widening : end.velocity / widening, end.run);
      // a zero that lies between the former end and the new one is enclosed by these two
      if (former.mean.certain() && end.mean.certain() && former.mean.value * end.mean.value < 0)
        (up ? low_ : high_) = former;
    }
    return true;
  }

  void narrow() {
    bool halved = true;
    while (2 * (high_.velocity - low_.velocity) > scan_width * (high_.velocity + low_.velocity)) {
      const double before = high_.velocity - low_.velocity;
      const Point point = inside(halved ? secant() : 0.5 * (low_.velocity + high_.velocity));
      if (!point.mean.certain()) return end_at(point);
      (point.mean.value * low_.mean.value > 0 ? low_ : high_) = point;
      halved = high_.velocity - low_.velocity <= 0.5 * before;
    }
    const double slope = slope_of_bracket(), share = low_.mean.value / (low_.mean.value - high_.mean.value);
    const double noise = std::hypot((1 - share) * low_.mean.error, share * high_.mean.error);
    found(ScanEnd::bracket, low_.velocity + share * (high_.velocity - low_.velocity), noise, slope);
  }

  /// The zero of the line through the ends, kept from them.
  [[nodiscard]] double secant() const {
    const double share = low_.mean.value / (low_.mean.value - high_.mean.value);
    return low_.velocity + std::clamp(share, margin, 1 - margin) * (high_.velocity - low_.velocity);
  }

  Point inside(double velocity) {
    const bool from_low = velocity - low_.velocity <= high_.velocity - velocity;
    Point point = at(velocity, from_low ? low_.run : high_.run);
    if (point.mean.certain()) return point;
    const Point again = at(velocity, from_low ? high_.run : low_.run);
    return {velocity, both(point.mean, again.mean), again.run};
  }

  [[nodiscard]] double slope_of_bracket() const {
    return (high_.mean.value - low_.mean.value) / (high_.velocity - low_.velocity);
  }

  void end_at(const Point& point) { found(ScanEnd::indistinct, point.velocity, point.mean.error, slope_of_bracket()); }

  void found(ScanEnd end, double velocity, double noise, double slope) {
    result_.end = end;
    result_.velocity = velocity;
    result_.slope = slope;
    result_.error = noise / std::abs(slope);
  }

  const RunAt& run_;
  Point low_, high_;
  ScanResult result_;
};

}  // namespace

std::string name_of(ScanEnd end) {
  switch (end) {
    case ScanEnd::bracket:
      return "bracket";
    case ScanEnd::indistinct:
      return "indistinct";
    case ScanEnd::not_found:
      break;
  }
  return "not found";
}

ScanResult scan_inversion(const ScanRange& range, const RunAt& run) { return Scan(run).search(range); }

}  // namespace polybed::multiscale
