#include "tfm/solids_viscosity.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "fluid/convection.hpp"
#include "fluid/face_stress.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// The rate of strain of one velocity at cell centres.
template <std::size_t dimensions, class Metric>
class Strain {
 public:
  Strain(const Metric& metric, const core::Grid& grid, const core::FaceField& velocity, const core::Field& fraction)
      : metric_(metric), share_(fraction) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      u_[d] = velocity[d].data();
      stride_[d] = grid.stride(int(d));
      per_length_[d] = 1 / grid.spacing[d];
    }
  }

  /// 2 D':D' in cell c, 1/s2.
  [[nodiscard]] double squared(Index c) const {
    double squares = 0, divergence = 0, shear = 0;
    core::for_each_axis<dimensions>([&](auto a) {
      const double along = (u_[a][c + stride_[a]] - u_[a][c]) * (per_length_[a] * metric_.per_length(a, c));
      squares += along * along;
      divergence += along;
      core::for_each_axis<dimensions>([&](auto b) {
        if constexpr (b > a)
          shear += 0.25 * (edge(c, a, b) + edge(c + stride_[a], a, b) +
                           (edge(c + stride_[b], a, b) + edge(c + stride_[a] + stride_[b], a, b)));
      });
    });
    if constexpr (Metric::radial) {
      const double around = 0.5 * (u_[0][c] + u_[0][c + stride_[0]]) * metric_.per_radius(c);
      squares += around * around;
      divergence += around;
    }
    return 2 * std::max(squares - divergence * divergence / 3, 0.0) + shear;
  }

 private:
  /// (du_a/dx_b + du_b/dx_a)^2 on the edge below the faces c of both axes, times the share of shear that it transmits.
  [[nodiscard]] double edge(Index c, std::size_t a, std::size_t b) const {
    const double rate = (u_[a][c] - u_[a][c - stride_[b]]) * (per_length_[b] * metric_.per_distance(b, c)) +
                        (u_[b][c] - u_[b][c - stride_[a]]) * (per_length_[a] * metric_.per_distance(a, c));
    return share_(c, stride_[a], stride_[b]) * rate * rate;
  }

  Metric metric_;
  fluid::SolidEdge share_;
  std::array<const double*, 3> u_{};
  std::array<Index, 3> stride_{};
  std::array<double, 3> per_length_{};
};

/// The solids' velocity, along walls inside: their steps stop no flow along them.
class AlongWalls {
 public:
  AlongWalls(const core::Grid& grid, const fluid::Boundaries& boundaries, const core::FaceField& velocity)
      : given_(velocity), inside_(grid.metric && grid.metric->walls) {
    if (inside_) filled_ = fluid::along_walls_inside(grid, boundaries, velocity);
  }
  [[nodiscard]] const core::FaceField& velocity() const { return inside_ ? filled_ : given_; }

 private:
  const core::FaceField& given_;
  core::FaceField filled_;
  bool inside_;
};

template <std::size_t dimensions, class Metric>
void strain_rates_in(const Metric& metric, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields) {
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const AlongWalls along(constants.grid, boundaries, fields.solids.velocity[j]);
    const Strain<dimensions, Metric> strain(metric, constants.grid, along.velocity(), fields.solids.fraction[j]);
    double* out = fields.stress.strain[j].data();
    core::for_each_row(constants.grid, boundaries.solids_cells(), [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) out[c] = strain.squared(c);
    });
  }
}

template <std::size_t dimensions, class Metric>
void add_viscosity_in(const Metric& metric, const Constants& constants, const fluid::Boundaries& boundaries,
                      Fields& fields, core::Field& weight) {
  const core::Grid& grid = constants.grid;
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const core::Field& fraction = fields.solids.fraction[j];
    const AlongWalls along(grid, boundaries, fields.solids.velocity[j]);
    const double *phi = fraction.data(), *viscosity = fields.stress.viscosity.data();
    double* to = weight.data();
    const std::size_t cells = weight.size();
#pragma GCC ivdep
    for (std::size_t c = 0; c < cells; ++c) to[c] = std::max(phi[c], 0.0) * viscosity[c];
    core::for_each_axis<dimensions>([&](auto axis) __attribute__((always_inline)) {
      const fluid::FaceStress<dimensions, axis, Metric, fluid::SolidEdge> stress(metric, grid, weight, along.velocity(),
                                                                                 fluid::SolidEdge(fraction));
      const Index s = grid.stride(int(axis));
      double* a = fields.solids.acceleration[j][axis].data();
      const double per_density = 1 / constants.density[j], floor = diffusion_floor(constants, j);
      core::for_each_row(grid, boundaries.moving_faces(int(axis), false), [&](Index begin, Index end) {
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c)
          a[c] +=
              per_density * stress.divergence(c) / (0.5 * (std::max(phi[c - s], 0.0) + std::max(phi[c], 0.0)) + floor);
      });
    });
  }
}

}  // namespace

void strain_rates(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  core::with_metric(constants.grid, [&]<class Metric>(const Metric& metric) {
    constants.grid.dimensions == 2
        ? core::in_vectors<strain_rates_in<2, Metric>>(metric, constants, boundaries, fields)
        : core::in_vectors<strain_rates_in<3, Metric>>(metric, constants, boundaries, fields);
  });
}

void add_solids_viscosity(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields,
                          core::Field& weight) {
  core::with_metric(constants.grid, [&]<class Metric>(const Metric& metric) {
    if (constants.grid.dimensions == 2)
      core::in_vectors<add_viscosity_in<2, Metric>>(metric, constants, boundaries, fields, weight);
    else
      core::in_vectors<add_viscosity_in<3, Metric>>(metric, constants, boundaries, fields, weight);
  });
}

}  // namespace polybed::tfm
