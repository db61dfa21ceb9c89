// From the fluid to particles: field values at each of them, T(2.4)-(2.10), with the same weights as in the other
// direction.
#pragma once

#include <array>
#include <vector>

#include "core/numerics/field.hpp"
#include "dem/coupling/round_weights.hpp"
#include "dem/several.hpp"

namespace polybed::dem {

/// Solids around a particle.
struct Surroundings {
  double fraction = 0;  ///< phi, all species
  double per_mean = 0;  ///< sum phi_j/D_j, 1/m
  double average = 0;   ///< sum phi_j D_j, m
  double own = 0;       ///< phi of its own species
};

/// Fluid at a particle.
struct Stream {
  Vector velocity{}, gradient{};  ///< U_f, m/s; grad p, Pa/m
};

class Gather {
 public:
  /// \param round  weights in a round column: null in a box
  Gather(const core::Grid& grid, std::vector<double> diameter, std::shared_ptr<const RoundWeights> round);
  Gather(const core::Grid& grid, std::vector<double> diameter)
      : Gather(grid, std::move(diameter), round_weights(grid)) {}

  /// Lays the fields out side by side. \param fraction  phi_j, [species][cell]
  void take(const std::vector<core::Field>& fraction, const core::FaceField& velocity, const core::FaceField& gradient);

  /// omega in cells, 1/s, for effects that need it.
  void take_vorticity(const std::array<core::Field, 3>& vorticity);

  /// Shares of a particle: lines in a box, else round shares.
  template <bool round>
  [[nodiscard]] auto shares(const Vector& x) const {
    if constexpr (round)
      return (*round_)(x);
    else
      return weights_(x);
  }
  [[nodiscard]] Lines lines(const Vector& x) const { return weights_(x); }
  /// Null in a box, else the weights for shares<true>.
  [[nodiscard]] const std::shared_ptr<const RoundWeights>& round() const { return round_; }

  template <class Shares>
  [[nodiscard]] Surroundings solids(const Shares& lines, std::int32_t species) const {
    Four sum{};  // the fourth is for the first species
    for_each_cell(weights_.dimensions(), lines, [&](std::size_t at, double w) {
      Four first;
      get_four(cells_.data() + at * width_, first);
      sum += w * first;
    });
    if (diameter_.size() == 1) return {sum[0], sum[1], sum[2], sum[3]};
    double own = 0;
    for_each_cell(weights_.dimensions(), lines,
                  [&](std::size_t at, double w) { own += w * cells_[at * width_ + 3 + std::size_t(species)]; });
    return {sum[0], sum[1], sum[2], own};
  }
  /// sum phi_j/D_j^2, 1/m2, for drag laws that need it.
  template <class Shares>
  [[nodiscard]] double per_square(const Shares& lines) const {
    double sum = 0;
    for_each_cell(weights_.dimensions(), lines, [&](std::size_t at, double w) {
      const double* fraction = cells_.data() + at * width_ + 3;
      for (std::size_t j = 0; j < diameter_.size(); ++j) sum += w * fraction[j] / (diameter_[j] * diameter_[j]);
    });
    return sum;
  }
  template <class Shares>
  [[nodiscard]] Stream stream(const Shares& lines) const {
    Stream s;
    for (int axis = 0; axis < weights_.dimensions(); ++axis) {
      const auto a = std::size_t(axis);
      Two sum{};
      for_each_face(weights_.dimensions(), lines, axis, [&](std::size_t at, double w) {
        sum += w * *static_cast<const TwoInMemory*>(static_cast<const void*>(faces_[a].data() + at));
      });
      s.velocity[a] = sum[0];
      s.gradient[a] = sum[1];
    }
    return s;
  }
  /// Only if take_vorticity() was called.
  template <class Shares>
  [[nodiscard]] Vector vorticity(const Shares& lines) const {
    Vector omega{};
    for_each_cell(weights_.dimensions(), lines, [&](std::size_t at, double w) {
      for (std::size_t k = 0; k < 3; ++k) omega[k] += w * vorticity_[at][k];
    });
    return omega;
  }
  /// Value of one field on faces.
  template <class Shares>
  [[nodiscard]] Vector vector(const Shares& lines, const core::FaceField& field) const {
    Vector v{};
    for (int axis = 0; axis < weights_.dimensions(); ++axis) {
      const auto a = std::size_t(axis);
      for_each_face(weights_.dimensions(), lines, axis, [&](std::size_t at, double w) { v[a] += w * field[a][at]; });
    }
    return v;
  }

 private:
  Weights weights_;
  std::vector<double> diameter_;
  std::size_t width_;          ///< numbers per cell
  std::vector<double> cells_;  ///< [cell]: phi, sum phi_j/D_j, sum phi_j D_j, phi_j of each species
  std::array<std::vector<std::array<double, 2>>, 3> faces_;  ///< [axis][face]: U_f, grad p
  std::vector<Vector> vorticity_;                            ///< [cell]; empty unless an effect needs it
  std::shared_ptr<const RoundWeights> round_;                ///< null: weights_ are used
};

}  // namespace polybed::dem
