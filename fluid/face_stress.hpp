// The divergence of a viscous stress on the faces of the staggered grid, for the fluid and for solids: second order,
// normal stresses in cells, shear stresses on edges. Walls act through the ghosts of the velocity.
#pragma once

#include <algorithm>
#include <array>

#include "core/numerics/operators.hpp"

namespace polybed::fluid {

/// Share of the mean weight of the four cells around an edge that transmits shear between the two pairs of faces: all
/// of it.
struct WholeEdge {
  [[nodiscard]] double operator()(core::Index, core::Index, core::Index) const { return 1; }
};

/// The same for a phase whose fraction can end there: the harmonic mean of the fractions in the four cells over their
/// arithmetic mean, 16/(sum phi sum 1/phi). It is 1 for uniform phi, to second order for smooth phi, and 0 at a free
/// surface, which is free of stress. Otherwise a face with hardly any mass would follow dense neighbours and its
/// velocity would shear them. Fractions up to 1e-60, whose products would underflow, count as 0.
class SolidEdge {
 public:
  explicit SolidEdge(const core::Field& fraction) : phi_(fraction.data()) {}
  /// \param c  the cell above the edge along both axes  \param sa, sb  their strides
  [[nodiscard]] double operator()(core::Index c, core::Index sa, core::Index sb) const {
    return of(phi_[c], phi_[c - sa], phi_[c - sb], phi_[c - sa - sb]);
  }
  [[nodiscard]] static double of(double a, double b, double c, double d) {
    const double ab = a * b, cd = c * d, least = std::min(std::min(a, b), std::min(c, d));
    const double share = 16 * (ab * cd) / (((a + b) + (c + d)) * ((a + b) * cd + (c + d) * ab));
    return least > 1e-60 ? share : 0;
  }

 private:
  const double* phi_;
};

/// div(w (grad U + grad U^T - 2/3 div U I)) on the faces of the axis a, with a weight w on cells (eps for the fluid,
/// phi_j times viscosity for a solid). Around an axis the hoop stress also pulls inwards. Ghosts of both must be
/// filled; fields must outlive this. Everything is always_inline: otherwise g++, with the metric of a round column,
/// would call it cell by cell, at the least width of vectors.
template <std::size_t dimensions, std::size_t a, class Metric, class Edge = WholeEdge>
class FaceStress {
 public:
  FaceStress(const Metric& metric, const core::Grid& grid, const core::Field& weight, const core::FaceField& velocity,
             Edge edge = {})
      : metric_(metric), weight_(weight.data()), edge_(edge) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      u_[d] = velocity[d].data();
      stride_[d] = grid.stride(int(d));
      per_length_[d] = 1 / grid.spacing[d];
    }
  }

  /// Divergence on face c, in units of the weight times 1/(m s).
  [[nodiscard, gnu::always_inline]] double divergence(core::Index c) const {
    double force = (through(c) - through(c - stride_[a])) * per_length_[a];
    core::for_each_axis<dimensions>([&](auto b) __attribute__((always_inline)) {
      if constexpr (b != a)
        force +=
            (open_edge(c + stride_[b], b) * shear(c + stride_[b], b) - open_edge(c, b) * shear(c, b)) * per_length_[b];
    });
    force *= metric_.per_volume_on(a, c);
    if constexpr (Metric::radial && a == 0) force -= around(c);
    return force;
  }

 private:
  /// w (2 du_a/dx_a - 2/3 div U) in cell c, over its whole cross-section.
  [[nodiscard, gnu::always_inline]] double through(core::Index c) const {
    return metric_.volume(c) * metric_.per_length(a, c) * (weight_[c] * 2 * (along(a, c) - divergence_in(c) / 3));
  }
  /// div U in cell c.
  [[nodiscard, gnu::always_inline]] double divergence_in(core::Index c) const {
    double div = 0;
    core::for_each_axis<dimensions>([&](auto d) __attribute__((always_inline)) {
      if constexpr (Metric::radial)
        div += (metric_.open(d, c + stride_[d]) * u_[d][c + stride_[d]] - metric_.open(d, c) * u_[d][c]) *
               (per_length_[d] * metric_.per_volume(c));
      else
        div += along(d, c);
    });
    return div;
  }
  /// w (2 u_r/r - 2/3 div U)/r on face c.
  [[nodiscard, gnu::always_inline]] double around(core::Index c) const {
    const core::Index s = stride_[0];
    const double weight = 0.5 * (weight_[c - s] + weight_[c]), per_radius = metric_.per_radius_on(c);
    const double div = 0.5 * (divergence_in(c - s) + divergence_in(c));
    return weight * 2 * (u_[0][c] * per_radius - div / 3) * per_radius;
  }
  /// Open share of the edge below the faces c of both axes, across b.
  [[nodiscard, gnu::always_inline]] double open_edge(core::Index c, std::size_t b) const {
    return 0.5 * (metric_.open(b, c) + metric_.open(b, c - stride_[a]));
  }
  [[nodiscard, gnu::always_inline]] double along(std::size_t d, core::Index c) const {
    return (u_[d][c + stride_[d]] - u_[d][c]) * (per_length_[d] * metric_.per_length(d, c));
  }

  /// w (du_a/dx_b + du_b/dx_a) on the edge below the faces c of both axes.
  [[nodiscard, gnu::always_inline]] double shear(core::Index c, std::size_t b) const {
    const core::Index sa = stride_[a], sb = stride_[b];
    const double weight =
        0.25 * edge_(c, sa, sb) * ((weight_[c] + weight_[c - sa]) + (weight_[c - sb] + weight_[c - sa - sb]));
    return weight * ((u_[a][c] - u_[a][c - sb]) * (per_length_[b] * metric_.per_distance(b, c)) +
                     (u_[b][c] - u_[b][c - sa]) * (per_length_[a] * metric_.per_distance(a, c)));
  }

  Metric metric_;
  const double* weight_;
  Edge edge_;
  std::array<const double*, 3> u_{};
  std::array<core::Index, 3> stride_{};
  std::array<double, 3> per_length_{};
};

}  // namespace polybed::fluid
