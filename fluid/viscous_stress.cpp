#include "fluid/viscous_stress.hpp"

#include <algorithm>

#include "core/operators.hpp"
#include "fluid/density.hpp"

namespace polybed::fluid {

using core::face_mean;
using core::Index;

namespace {

/// Velocity gradients and voidage around the faces of one axis, and the viscous force on them.
class FaceStress {
 public:
  FaceStress(const core::Grid& grid, const FluidState& fluid, int axis) : grid_(grid), axis_(axis) {
    eps_ = fluid.voidage.data();
    for (int d = 0; d < grid.dimensions; ++d) {
      u_[std::size_t(d)] = fluid.velocity[std::size_t(d)].data();
      stride_[std::size_t(d)] = grid.stride(d);
      per_length_[std::size_t(d)] = 1 / grid.spacing[std::size_t(d)];
    }
  }

  /// div(eps tau/mu) on face c, 1/(m s).
  [[nodiscard]] double divergence(Index c) const {
    const auto a = std::size_t(axis_);
    double force = (normal(c) - normal(c - stride_[a])) * per_length_[a];
    for (int d = 0; d < grid_.dimensions; ++d) {
      if (d == axis_) continue;
      const auto b = std::size_t(d);
      force += (shear(c + stride_[b], b) - shear(c, b)) * per_length_[b];
    }
    return force;
  }

 private:
  /// eps (2 du_a/dx_a - 2/3 div U) in cell c.
  [[nodiscard]] double normal(Index c) const {
    double div = 0;
    for (int d = 0; d < grid_.dimensions; ++d) div += along(std::size_t(d), c);
    return eps_[c] * 2 * (along(std::size_t(axis_), c) - div / 3);
  }
  [[nodiscard]] double along(std::size_t d, Index c) const {
    return (u_[d][c + stride_[d]] - u_[d][c]) * per_length_[d];
  }

  /// eps (du_a/dx_b + du_b/dx_a) on the edge below the faces c of both axes.
  [[nodiscard]] double shear(Index c, std::size_t b) const {
    const auto a = std::size_t(axis_);
    const Index sa = stride_[a], sb = stride_[b];
    const double eps = 0.25 * ((eps_[c] + eps_[c - sa]) + (eps_[c - sb] + eps_[c - sa - sb]));
    return eps * ((u_[a][c] - u_[a][c - sb]) * per_length_[b] + (u_[b][c] - u_[b][c - sa]) * per_length_[a]);
  }

  const core::Grid& grid_;
  int axis_;
  const double* eps_;
  std::array<const double*, 3> u_{};
  std::array<Index, 3> stride_{};
  std::array<double, 3> per_length_{};
};

template <class Density>
void add_with(const Density& density, const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
              double viscosity, core::FaceField& acceleration) {
  const double* eps = fluid.voidage.data();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const FaceStress stress(grid, fluid, axis);
    const Index s = grid.stride(axis);
    double* rate = acceleration[std::size_t(axis)].data();
    core::for_each_row(grid, boundaries.moving_faces(axis, true), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        rate[c] +=
            viscosity / density.on_face(c, s) * stress.divergence(c) / std::max(face_mean(eps, c, s), voidage_floor);
    });
  }
}

}  // namespace

void add_viscous_stress(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                        const FluidConstants& constants, core::FaceField& acceleration) {
  with_density(fluid, constants.density,
               [&](const auto& local) { add_with(local, grid, boundaries, fluid, constants.viscosity, acceleration); });
}

}  // namespace polybed::fluid
