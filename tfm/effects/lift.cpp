// Slot Force: lift on spheres in a sheared fluid, closures/lift_saffman_mei.hpp.
//
// The lift is computed on the faces. The vorticity on a face is the mean over its edges, each from the four velocities
// around the edge. Such differences across one cell see streams that alternate from cell to cell and have the right
// sign next to walls. Differences across two cells do not, and would separate the columns of cells.
#include "relevance/effects/lift.hpp"

#include <algorithm>

#include "closures/lift_saffman_mei.hpp"
#include "closures/sphere.hpp"
#include "core/vectors.hpp"
#include "fluid/density.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::tfm {

namespace {

using core::face_mean;
using core::Index;

/// A component of U_f - U_j on the faces of another axis, m/s: from the fluxes through the four faces around it, at the
/// voidage of the face, which a nearby surface changes less.
struct SlipAcross {
  const double *eps, *u, *v;
  Index across, along;  ///< strides of the face's axis and of the component's
  [[nodiscard]] double flux(Index c) const { return face_mean(eps, c, along) * (u[c] - v[c]); }
  [[nodiscard]] double at(Index c) const {
    return 0.25 / std::max(face_mean(eps, c, across), fluid::voidage_floor) *
           (flux(c) + flux(c + along) + flux(c - across) + flux(c - across + along));
  }
};

/// A component of curl U_f on the edges along its axis, 1/s: index c is the low edge of cell c.
template <class Metric>
struct EdgeVorticity {
  Metric metric;
  std::size_t axis_p, axis_q;  ///< the two other axes, in cyclic order
  const double *u_p, *u_q;
  Index p, q;  ///< their strides
  double per_p, per_q;
  [[nodiscard]] double at(Index c) const {
    return per_p * metric.per_distance(axis_p, c) * (u_q[c] - u_q[c - p]) -
           per_q * metric.per_distance(axis_q, c) * (u_p[c] - u_p[c - q]);
  }
  [[nodiscard]] double mean(Index c, Index s) const { return 0.5 * (at(c) + at(c + s)); }
};

/// The axes of a face in cyclic order, starting with its own; in 2-D one of them is inactive.
struct Axes {
  int a, b, d;
  explicit Axes(int axis) : a(axis), b((axis + 1) % 3), d((axis + 2) % 3) {}
};

template <int dimensions, class Metric, class Density>
void lift_loops(const Metric& metric, const Density& density, const Constants& constants,
                const fluid::Boundaries& boundaries, int axis, std::size_t j, Fields& fields) {
  const core::Grid& grid = constants.grid;
  const Axes axes(axis);
  const auto velocity = [&](int of) { return fields.fluid.velocity[std::size_t(of)].data(); };
  const auto slip_of = [&](int of) {
    return SlipAcross{fields.fluid.voidage.data(), velocity(of), fields.solids.velocity[j][std::size_t(of)].data(),
                      grid.stride(axis), grid.stride(of)};
  };
  const auto vorticity_about = [&](int of) {
    const Axes about(of);
    return EdgeVorticity<Metric>{metric,
                                 std::size_t(about.b),
                                 std::size_t(about.d),
                                 velocity(about.b),
                                 velocity(about.d),
                                 grid.stride(about.b),
                                 grid.stride(about.d),
                                 1 / grid.spacing[std::size_t(about.b)],
                                 1 / grid.spacing[std::size_t(about.d)]};
  };
  const SlipAcross slip_b = slip_of(axes.b), slip_d = slip_of(axes.d);
  const EdgeVorticity<Metric> about_a = vorticity_about(axes.a), about_b = vorticity_about(axes.b),
                              about_d = vorticity_about(axes.d);
  const bool has_b = dimensions == 3 || axes.b < 2, has_d = dimensions == 3 || axes.d < 2;
  const double *u = velocity(axis), *v = fields.solids.velocity[j][std::size_t(axis)].data();
  double* to = fields.force.on_solids[j].data();
  const Index s = grid.stride(axis), s_b = grid.stride(axes.b), s_d = grid.stride(axes.d);
  const double diameter = constants.diameter[j], viscosity = constants.fluid.viscosity;
  const double per_volume = 1 / closures::sphere_volume(0.5 * diameter);
  const auto loop = [&](auto&& slip, auto&& vorticity) {
    core::for_each_row(grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c)
        to[c] += per_volume * closures::lift_saffman_mei(slip(c), vorticity(c), diameter, density.on_face(c, s),
                                                         viscosity, closures::lift_least_shear_mei)
                                  .x;
    });
  };
  using closures::Vec3;
  if constexpr (dimensions == 3) {
    const auto along = [=](Index c) { return about_a.mean(c, s_b) + about_a.mean(c + s_d, s_b); };
    loop(
        [=](Index c) {
          return Vec3{u[c] - v[c], slip_b.at(c), slip_d.at(c)};
        },
        [=](Index c) {
          return Vec3{0.25 * (along(c) + along(c - s)), about_b.mean(c, s_d), about_d.mean(c, s_b)};
        });
  } else if (has_b) {
    loop(
        [=](Index c) {
          return Vec3{u[c] - v[c], slip_b.at(c), 0.0};
        },
        [=](Index c) {
          return Vec3{0.0, 0.0, about_d.mean(c, s_b)};
        });
  } else if (has_d) {
    loop(
        [=](Index c) {
          return Vec3{u[c] - v[c], 0.0, slip_d.at(c)};
        },
        [=](Index c) {
          return Vec3{0.0, about_b.mean(c, s_d), 0.0};
        });
  }
}

/// Saffman's lift with Mei's share on each species: as for one sphere, at any voidage, with the local density of a
/// compressible fluid. Below the least shear in the fit of the share it is linear in the vorticity: the slope of a root
/// would amplify round-off into streams where the flow is uniform or symmetric.
class Lift final : public ForceEffect {
 public:
  Lift(const Constants& constants, const fluid::Boundaries& boundaries)
      : constants_(constants), boundaries_(boundaries) {}

  void add(int axis, Fields& fields) override {
    fluid::with_density(fields.fluid, constants_.fluid.density, [&]<class Density>(const Density& local) {
      core::with_metric(constants_.grid, [&]<class Metric>(const Metric& metric) {
        for (std::size_t j = 0; j < constants_.species(); ++j)
          constants_.grid.dimensions == 3 ? core::in_vectors<lift_loops<3, Metric, Density>>(
                                                metric, local, constants_, boundaries_, axis, j, fields)
                                          : core::in_vectors<lift_loops<2, Metric, Density>>(
                                                metric, local, constants_, boundaries_, axis, j, fields);
      });
    });
  }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
};

/// A column of one cell across has no vorticity: creates nothing.
void make_lift(const Making& m) {
  const core::Grid& grid = m.constants.grid;
  if (grid.column_cells(0) == 1 && (grid.dimensions < 3 || grid.column_cells(2) == 1)) return;
  m.fields.force.on_solids.assign(m.constants.species(), core::make_field(grid));
  m.effects.forces.push_back(std::make_unique<Lift>(m.constants, m.boundaries));
}

}  // namespace

namespace makers {

extern const Maker lift;
const Maker lift{&relevance::effects::lift, "Force", make_lift};

}  // namespace makers

}  // namespace polybed::tfm
