// A particle's own contribution to the averages at its position. Drag laws use mean fractions of a whole mixture. An
// average around a particle includes the particle itself, minus the neighbours that it displaces, and is too high by
// that: in a bed with the two sizes of Matsuura and Akehata, under a kernel of four large diameters, by 0.6 % of the
// column for the large ones, which is 3 % of their drag and 4 mm/s of the inversion velocity.
#pragma once

#include <array>
#include <vector>

#include "core/numerics/field.hpp"
#include "dem/coupling/gather.hpp"
#include "dem/coupling/open_faces.hpp"
#include "fluid/smoothing.hpp"

namespace polybed::dem {

class OwnShare {
 public:
  /// \param smoothing  of what particles give to the fluid \param diameter  of each species, m
  /// \param squares  whether per_square_without will be asked  \param open  that particles pass; null: none
  OwnShare(const core::Grid& grid, const fluid::Smoothing& smoothing, std::vector<double> diameter,
           bool squares = false, const OpenFaces* open = nullptr);

  /// Share of a particle's volume that counts.
  [[nodiscard]] double inside(const Place& place, std::int64_t id) const {
    return open_ != nullptr ? open_->inside(place, id) : 1;
  }

  /// Contribution of each species in every cell, from closures::SphereNeighbours. \param fraction  [species][cell]
  void take(const std::vector<core::Field>& fraction);

  /// The surroundings as a mean of the mixture, from those that the particle sees with itself among them.
  /// The kernel is taken to be wide against the correlation of neighbours, two or three diameters.
  /// \param inside  share of its volume that counts
  [[nodiscard]] Surroundings without(Surroundings seen, const Lines& lines, std::int32_t species,
                                     double inside = 1) const;

  /// The same of sum phi_j/D_j^2, 1/m2.
  [[nodiscard]] double per_square_without(double seen, const Lines& lines, std::int32_t species,
                                          double inside = 1) const;

  /// The kernel at its own place: contribution of a volume of 1 at x to the average at x, 1/m3.
  [[nodiscard]] double weight(const Lines& lines) const;

 private:
  const OpenFaces* open_;
  int dimensions_;
  std::array<core::Index, 3> stride_{};
  double per_volume_;                                       ///< of a cell, 1/m3
  std::array<std::vector<std::array<double, 2>>, 3> near_;  ///< [axis][cell]: the kernel in the cell, in the next one
  std::vector<double> diameter_;
  std::vector<Surroundings> counts_;  ///< [cell][species]: times 1 m3
  std::vector<double> squares_;       ///< the same for sum phi_j/D_j^2; empty unless needed
};

}  // namespace polybed::dem
