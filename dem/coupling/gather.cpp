#include "dem/coupling/gather.hpp"

namespace polybed::dem {

Gather::Gather(const core::Grid& grid, std::vector<double> diameter, std::shared_ptr<const RoundWeights> round)
    : weights_(grid), diameter_(std::move(diameter)), width_(3 + diameter_.size()), round_(std::move(round)) {
  cells_.resize(grid.padded_size() * width_);
  for (int axis = 0; axis < grid.dimensions; ++axis) faces_[std::size_t(axis)].resize(grid.padded_size());
}

void Gather::take(const std::vector<core::Field>& fraction, const core::FaceField& velocity,
                  const core::FaceField& gradient) {
  const std::size_t cells = cells_.size() / width_;
  for (std::size_t c = 0; c < cells; ++c) {
    double* cell = cells_.data() + c * width_;
    cell[0] = cell[1] = cell[2] = 0;
    for (std::size_t j = 0; j < diameter_.size(); ++j) {
      const double phi = fraction[j][c];
      cell[0] += phi;
      cell[1] += phi / diameter_[j];
      cell[2] += phi * diameter_[j];
      cell[3 + j] = phi;
    }
  }
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t f = 0; f < faces_[a].size(); ++f) faces_[a][f] = {velocity[a][f], gradient[a][f]};
}

void Gather::take_vorticity(const std::array<core::Field, 3>& vorticity) {
  vorticity_.resize(vorticity[0].size());
  for (std::size_t c = 0; c < vorticity_.size(); ++c)
    for (std::size_t k = 0; k < 3; ++k) vorticity_[c][k] = vorticity[k][c];
}

}  // namespace polybed::dem
