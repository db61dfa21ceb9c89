#include "dem/coupling/own_share.hpp"

#include <algorithm>

#include "closures/sphere.hpp"
#include "closures/sphere_neighbours.hpp"

namespace polybed::dem {

OwnShare::OwnShare(const core::Grid& grid, const fluid::Smoothing& smoothing, std::vector<double> diameter,
                   bool squares, const OpenFaces* open)
    : open_(open), dimensions_(grid.dimensions), per_volume_(1 / grid.cell_volume()), diameter_(std::move(diameter)) {
  for (int axis = 0; axis < dimensions_; ++axis) {
    stride_[std::size_t(axis)] = grid.stride(axis);
    near_[std::size_t(axis)] = smoothing.nearest(axis, grid.cells[std::size_t(axis)]);
  }
  counts_.resize(grid.padded_size() * diameter_.size());
  if (squares) squares_.resize(counts_.size());
}

void OwnShare::take(const std::vector<core::Field>& fraction) {
  const std::size_t species = diameter_.size();
  std::vector<double> phi(species);
  for (std::size_t c = 0; c * species < counts_.size(); ++c) {
    for (std::size_t j = 0; j < species; ++j) phi[j] = std::max(0.0, fraction[j][c]);
    const closures::SphereNeighbours neighbours(phi, diameter_);
    for (std::size_t i = 0; i < species; ++i) {
      Surroundings& count = counts_[c * species + i] = {};
      double per_square = 0;
      for (std::size_t j = 0; j < species; ++j) {
        const double d = diameter_[j];
        const double volume = closures::sphere_volume(0.5 * d) * neighbours.excess(diameter_[i], d, phi[j], i == j);
        count.fraction += volume;
        count.per_mean += volume / d;
        count.average += volume * d;
        per_square += volume / (d * d);
        if (i == j) count.own = volume;
      }
      if (!squares_.empty()) squares_[c * species + i] = per_square;
    }
  }
}

double OwnShare::weight(const Lines& lines) const {
  double product = per_volume_;
  for (std::size_t a = 0; a < std::size_t(dimensions_); ++a) {
    const Line& line = lines.cell[a];
    const auto low = std::size_t(line.at[0] / stride_[a] - core::Grid::halo);
    const auto high = std::size_t(line.at[1] / stride_[a] - core::Grid::halo);
    const double between = low == high ? near_[a][low][0] : near_[a][low][1];
    product *= line.w[0] * line.w[0] * near_[a][low][0] + line.w[1] * line.w[1] * near_[a][high][0] +
               2 * line.w[0] * line.w[1] * between;
  }
  return product;
}

double OwnShare::per_square_without(double seen, const Lines& lines, std::int32_t species, double inside) const {
  double count = 0;
  for_each_cell(dimensions_, lines,
                [&](std::size_t at, double w) { count += w * squares_[at * diameter_.size() + std::size_t(species)]; });
  return std::max(0.0, seen - inside * weight(lines) * count);
}

Surroundings OwnShare::without(Surroundings seen, const Lines& lines, std::int32_t species, double inside) const {
  Surroundings count;
  for_each_cell(dimensions_, lines, [&](std::size_t at, double w) {
    const Surroundings& cell = counts_[at * diameter_.size() + std::size_t(species)];
    count.fraction += w * cell.fraction;
    count.per_mean += w * cell.per_mean;
    count.average += w * cell.average;
    count.own += w * cell.own;
  });
  const double kernel = inside * weight(lines);
  // What a particle alone leaves is round-off, or what the law of a few makes of the field that it gives itself.
  const auto rest = [&](double all, double own) { return std::max(0.0, all - kernel * own); };
  seen.fraction = rest(seen.fraction, count.fraction);
  seen.per_mean = rest(seen.per_mean, count.per_mean);
  seen.average = rest(seen.average, count.average);
  seen.own = std::min(seen.fraction, rest(seen.own, count.own));
  return seen;
}

}  // namespace polybed::dem
