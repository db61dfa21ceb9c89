#include "multiscale/resolve/guided_spheres.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "closures/film_impulse.hpp"
#include "core/error.hpp"

namespace polybed::multiscale {

namespace {

/// Overlap that is left, in cells: the fluid sees surfaces to about that.
constexpr double enough = 1e-3;
/// Sweeps over the pairs after which spheres are jammed: most steps need fewer than 50.
constexpr int most_sweeps = 2000;
/// Gap of pairs that can meet within two steps, cells: each moves by less than a cell.
constexpr double reach = 2;

}  // namespace

GuidedSpheres::GuidedSpheres(std::vector<lattice::Sphere> spheres, std::vector<std::size_t> species,
                             std::vector<lattice::Point> velocity, double edge)
    : spheres_(std::move(spheres)),
      motion_(spheres_.size()),
      species_(std::move(species)),
      velocity_(std::move(velocity)),
      count_(velocity_.size(), 0),
      edge_(edge) {
  for (const std::size_t j : species_) ++count_[j];
  find_motion();
}

lattice::Point GuidedSpheres::between(const lattice::Point& m, const lattice::Point& n) const {
  lattice::Point d;
  for (std::size_t k = 0; k < 3; ++k) d[k] = std::remainder(m[k] - n[k], edge_);
  return d;
}

auto GuidedSpheres::pairs_within(double gap) const -> std::vector<Pair> {
  std::vector<Pair> pairs;
  for (std::size_t m = 0; m < spheres_.size(); ++m)
    for (std::size_t n = 0; n < m; ++n) {
      const lattice::Point d = between(spheres_[m].centre, spheres_[n].centre);
      if (std::hypot(d[0], d[1], d[2]) < spheres_[m].radius + spheres_[n].radius + gap) pairs.push_back({m, n});
    }
  return pairs;
}

double GuidedSpheres::push_apart(const std::vector<Pair>& pairs, std::vector<lattice::Point>& centre) const {
  double worst = 0;
  for (const auto& [m, n] : pairs) {
    const lattice::Point d = between(centre[m], centre[n]);
    const double a = spheres_[m].radius, b = spheres_[n].radius, distance = std::hypot(d[0], d[1], d[2]);
    const double overlap = a + b - distance;
    if (overlap <= 0) continue;
    worst = std::max(worst, overlap);
    for (std::size_t k = 0; k < 3; ++k) {
      centre[m][k] += overlap * b / (a + b) * d[k] / distance;
      centre[n][k] -= overlap * a / (a + b) * d[k] / distance;
    }
  }
  return worst;
}

/// Shifts each species as a whole to its mean place after two steps.
void GuidedSpheres::keep_means(const std::vector<lattice::Point>& aimed, std::vector<lattice::Point>& centre) const {
  std::vector<lattice::Point> mean(count_.size());
  for (std::size_t n = 0; n < centre.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) mean[species_[n]][k] += (aimed[n][k] - centre[n][k]) / count_[species_[n]];
  for (std::size_t n = 0; n < centre.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) centre[n][k] += mean[species_[n]][k];
}

/// Velocities to the places in two steps, where no spheres overlap.
void GuidedSpheres::find_motion() {
  std::vector<lattice::Point> aimed;
  for (std::size_t n = 0; n < spheres_.size(); ++n) {
    aimed.push_back(spheres_[n].centre);
    for (std::size_t k = 0; k < 3; ++k) aimed[n][k] += 2 * velocity_[species_[n]][k];
  }
  const std::vector<Pair> pairs = pairs_within(reach);
  std::vector<lattice::Point> next = aimed;
  double overlap = 1;
  for (int sweeps = 0; overlap > enough; ++sweeps) {
    if (sweeps == most_sweeps)
      throw core::NumericsError("moving spheres jam, as they cannot pass each other: take a higher resolve.voidage");
    overlap = push_apart(pairs, next);
    keep_means(aimed, next);
  }
  for (std::size_t n = 0; n < spheres_.size(); ++n) {
    motion_[n].centre = spheres_[n].centre;
    for (std::size_t k = 0; k < 3; ++k) motion_[n].velocity[k] = 0.5 * (next[n][k] - spheres_[n].centre[k]);
  }
}

void GuidedSpheres::move() {
  for (std::size_t n = 0; n < spheres_.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) {
      double& x = spheres_[n].centre[k];
      x += 2 * motion_[n].velocity[k];
      x -= edge_ * std::floor(x / edge_);
    }
  find_motion();
}

void GuidedSpheres::restore(const std::vector<lattice::Point>& centres) {
  for (std::size_t n = 0; n < spheres_.size(); ++n) spheres_[n].centre = centres.at(n);
  find_motion();
}

std::vector<double> GuidedSpheres::film_impulses(double viscosity, double resolved, double roughness) const {
  std::vector<double> impulse(spheres_.size(), 0);
  for (const auto& [m, n] : pairs_within(reach)) {
    const double a = spheres_[m].radius, b = spheres_[n].radius;
    const lattice::Point before = between(spheres_[m].centre, spheres_[n].centre);
    lattice::Point after = before, mean;
    for (std::size_t k = 0; k < 3; ++k) {
      after[k] += 2 * (motion_[m].velocity[k] - motion_[n].velocity[k]);
      mean[k] = 0.5 * (before[k] + after[k]);
    }
    const auto gap = [&](const lattice::Point& d) { return std::hypot(d[0], d[1], d[2]) - a - b; };
    const double apart =
        closures::unresolved_film_impulse(viscosity, a * b / (a + b), gap(before), gap(after), resolved, roughness) *
        mean[0] / std::hypot(mean[0], mean[1], mean[2]);
    impulse[m] += apart;
    impulse[n] -= apart;
  }
  return impulse;
}

}  // namespace polybed::multiscale
