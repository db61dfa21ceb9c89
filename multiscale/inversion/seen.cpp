#include "multiscale/inversion/seen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "closures/pair_distribution.hpp"
#include "closures/sphere.hpp"
#include "core/numerics/blocks.hpp"
#include "dem/coupling/kernel.hpp"
#include "fluid/smoothing.hpp"
#include "multiscale/inversion/balance.hpp"

namespace polybed::multiscale {

namespace {

using std::numbers::pi;
constexpr int wave_numbers = 1000;    ///< twice as many move no velocity by 1e-5
constexpr double most_per_cell = 40;  ///< k a: sinc^4 is below 1e-5 there, in the mean over directions below 1e-6
constexpr int directions = 128;       ///< of a quarter turn; in three dimensions as many azimuths as half of it
constexpr int scan_of_seen = 200;     ///< intervals of the scan for roots: each asks the averages

double sinc4(double x) {
  const double s = x == 0 ? 1 : std::sin(x) / x;
  return s * s * s * s;
}

/// Mean of sinc^4(k c0 a0/2) sinc^4(k c1 a1/2)... over the directions with cosines c.
double mean_over_directions(double k, const std::vector<double>& cell) {
  const auto along = [&](std::size_t n, double cosine) { return sinc4(0.5 * k * cosine * cell[n]); };
  if (cell.size() == 1) return along(0, 1);
  const auto turn = [&](double across, int count) {  // over the angle between the first two axes
    double sum = 0;
    for (int n = 0; n < count; ++n) {
      const double angle = 0.5 * pi * (n + 0.5) / count;
      sum += along(0, across * std::cos(angle)) * along(1, across * std::sin(angle));
    }
    return sum / count;
  };
  if (cell.size() == 2) return turn(1, directions);
  double sum = 0;
  for (int n = 0; n < directions / 2; ++n) {
    const double cosine = (n + 0.5) / (directions / 2);
    sum += along(2, cosine) * turn(std::sqrt(1 - cosine * cosine), directions / 2);
  }
  return sum / (directions / 2);
}

std::vector<double> varying(const AveragingKernel& kernel) {
  std::vector<double> cell;
  for (std::size_t a = 0; a < 3; ++a)
    if (!kernel.wide[a]) cell.push_back(kernel.cell[a]);
  return cell;
}

/// Of the axes along which the kernel is uniform, 1/m each.
double per_uniform_axis(const AveragingKernel& kernel) {
  double product = 1;
  for (std::size_t a = 0; a < 3; ++a)
    if (kernel.wide[a]) product /= kernel.cell[a];
  return product;
}

}  // namespace

int AveragingKernel::axes() const { return int(std::count(wide.begin(), wide.end(), false)); }

AveragingKernel averaging_kernel(const core::Scene& scene) {
  AveragingKernel kernel;
  const core::Column& column = scene.column;
  for (std::size_t a = 0; a < 3; ++a) {
    kernel.cell[a] = column.size[a] / double(column.cells[a]);
    kernel.wide[a] = column.cells[a] == 1;
  }
  double largest = 0;
  for (const core::Species& species : scene.species) largest = std::max(largest, species.diameter);
  const auto& numbers = scene.bed.particles;
  // A bed of two species that is given by its volume has more than the few that have a kernel of their own.
  const std::int64_t count = numbers.empty() ? 1000 : std::accumulate(numbers.begin(), numbers.end(), std::int64_t(0));
  const double width = dem::kernel_of(scene, core::grid_of(column, nullptr).smallest_spacing(), largest, count).width;
  kernel.time = fluid::smoothing_time(width);
  return kernel;
}

double kernel_at_itself(const AveragingKernel& kernel) {
  double product = per_uniform_axis(kernel);
  for (const double a : varying(kernel)) {
    if (kernel.time == 0) {
      product *= 2 / (3 * a);
      continue;
    }
    double sum = 0.5;  // by the rule of trapezia, from k = 0
    const double step = most_per_cell / (a * wave_numbers);
    for (int n = 1; n <= wave_numbers; ++n) {
      const double k = n * step;
      sum += sinc4(0.5 * k * a) * std::exp(-kernel.time * k * k);
    }
    product *= sum * step / pi;
  }
  return product;
}

double kernel_spectrum(const AveragingKernel& kernel, double k) {
  return mean_over_directions(k, varying(kernel)) * std::exp(-kernel.time * k * k);
}

SeenAverages::SeenAverages(const AveragingKernel& kernel, const std::array<double, 2>& diameter, Neighbours neighbours)
    : diameter_(diameter), neighbours_(neighbours), at_itself_(kernel_at_itself(kernel)) {
  const std::vector<double> cell = varying(kernel);
  const int axes = kernel.axes();
  if (axes == 0) {  // the average of the whole column
    k_ = {0};
    weight_ = {per_uniform_axis(kernel)};
    return;
  }
  const double step = most_per_cell / (*std::min_element(cell.begin(), cell.end()) * wave_numbers);
  // (2 pi)^-n times the surface of the unit sphere in n dimensions: 1/pi, 1/(2 pi), 1/(2 pi^2).
  const double shell = axes == 1 ? 1 / pi : axes == 2 ? 1 / (2 * pi) : 1 / (2 * pi * pi);
  for (int n = 0; n <= wave_numbers; ++n) {
    const double k = n * step, share = n == 0 || n == wave_numbers ? 0.5 : 1;
    k_.push_back(k);
    weight_.push_back(share * step * shell * std::pow(k, axes - 1) * kernel_spectrum(kernel, k) *
                      per_uniform_axis(kernel));
  }
}

std::array<std::array<double, 2>, 2> SeenAverages::excess(const std::array<double, 2>& phi) const {
  std::array<std::array<double, 2>, 2> sum{};
  const closures::PercusYevick pairs(phi, diameter_);
  for (std::size_t n = 0; n < k_.size(); ++n) {
    const bool alike = neighbours_ == Neighbours::percus_yevick;
    const Eigen::Matrix2d h = alike ? Eigen::Matrix2d(pairs.spectrum(k_[n])) : Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        sum[i][j] += weight_[n] * (alike ? h(Eigen::Index(i), Eigen::Index(j))
                                         : closures::exclusion_spectrum(k_[n], 0.5 * (diameter_[i] + diameter_[j])));
  }
  return sum;
}

std::array<std::array<double, 2>, 2> SeenAverages::fractions(const std::array<double, 2>& phi) const {
  auto seen = excess(phi);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double own = i == j ? closures::sphere_volume(0.5 * diameter_[i]) * at_itself_ : 0;
      seen[i][j] = std::max(0.0, phi[j] * (1 + seen[i][j]) + own);
    }
  return seen;
}

std::vector<InversionPoint> seen_inversion_points(const BinaryBed& bed, const closures::DragLaw& law,
                                                  const SeenAverages& seen) {
  return balanced(bed, law, scan_of_seen, [&](double voidage) -> std::optional<std::array<Around, 2>> {
    const auto fraction = seen.fractions({(1 - voidage) * bed.share[0], (1 - voidage) * bed.share[1]});
    std::array<Around, 2> around{};
    for (std::size_t i = 0; i < 2; ++i) {
      const double all = fraction[i][0] + fraction[i][1];
      if (!(all > 0 && all < 1)) return std::nullopt;
      around[i] = {1 - all, {fraction[i][0] / all, fraction[i][1] / all}};
    }
    return around;
  });
}

}  // namespace polybed::multiscale
