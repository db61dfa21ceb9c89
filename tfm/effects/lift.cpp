// Slot Force: lift of spheres in a sheared fluid, closures/lift_saffman_mei.hpp.
#include "relevance/effects/lift.hpp"

#include <algorithm>

#include "closures/lift_saffman_mei.hpp"
#include "closures/sphere.hpp"
#include "core/vectors.hpp"
#include "fluid/density.hpp"
#include "fluid/vorticity.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::tfm {

namespace {

using core::face_mean;
using core::Index;

/// The component of U_f - U_j along an axis at the centre of a cell, m/s: like drag it is that which the flux through
/// both faces has at the cell's voidage, which a surface beside the cell does not change.
struct Slip {
  const double *eps, *u, *v;
  Index s;
  [[nodiscard]] double at(Index c) const {
    return 0.5 / std::max(eps[c], fluid::voidage_floor) *
           (face_mean(eps, c, s) * (u[c] - v[c]) + face_mean(eps, c + s, s) * (u[c + s] - v[c + s]));
  }
};

template <int dimensions, class Density>
void lift_loops(const Density& density, const Constants& constants, const fluid::Boundaries& boundaries, std::size_t j,
                Fields& fields) {
  const auto along = [&](int axis) {
    return Slip{fields.fluid.voidage.data(), fields.fluid.velocity[std::size_t(axis)].data(),
                fields.solids.velocity[j][std::size_t(axis)].data(), constants.grid.stride(axis)};
  };
  const Slip x = along(0), y = along(1), z = along(dimensions - 1);
  const auto& omega = fields.force.vorticity;
  const double *about_x = omega[0].data(), *about_y = omega[1].data(), *about_z = omega[2].data();
  core::Field* const forces = &fields.force.on_solids[j * dimensions];
  double *to_x = forces[0].data(), *to_y = forces[1].data(), *to_z = forces[dimensions - 1].data();
  const double diameter = constants.diameter[j], viscosity = constants.fluid.viscosity;
  const double per_volume = 1 / closures::sphere_volume(0.5 * diameter);
  core::for_each_row(constants.grid, boundaries.solids_cells(), [&](Index begin, Index end) {
#pragma GCC ivdep
    for (Index c = begin; c < end; ++c) {
      const closures::Vec3 slip{x.at(c), y.at(c), dimensions == 3 ? z.at(c) : 0.0},
          vorticity{dimensions == 3 ? about_x[c] : 0.0, dimensions == 3 ? about_y[c] : 0.0, about_z[c]};
      const closures::Vec3 force = closures::lift_saffman_mei(slip, vorticity, diameter, density.in_cell(c), viscosity);
      to_x[c] += per_volume * force.x;
      to_y[c] += per_volume * force.y;
      if constexpr (dimensions == 3) to_z[c] += per_volume * force.z;
    }
  });
}

/// Saffman's lift with the share of Mei on each species, from slip and vorticity at the centres of cells: that of one
/// sphere, at any voidage, with the local density of a compressible fluid.
class Lift final : public ForceEffect {
 public:
  Lift(const Constants& constants, const fluid::Boundaries& boundaries)
      : constants_(constants), boundaries_(boundaries) {}

  void add(Fields& fields) override {
    fluid::find_vorticity(constants_.grid, fields.fluid.velocity, fields.force.vorticity);
    fluid::with_density(fields.fluid, constants_.fluid.density, [&]<class Density>(const Density& local) {
      for (std::size_t j = 0; j < constants_.species(); ++j)
        constants_.grid.dimensions == 3
            ? core::in_vectors<lift_loops<3, Density>>(local, constants_, boundaries_, j, fields)
            : core::in_vectors<lift_loops<2, Density>>(local, constants_, boundaries_, j, fields);
    });
  }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
};

/// One cell across has no vorticity: nothing is made.
void make_lift(const Making& m) {
  const core::Grid& grid = m.constants.grid;
  if (grid.column_cells(0) == 1 && (grid.dimensions < 3 || grid.column_cells(2) == 1)) return;
  m.fields.force.on_solids.assign(m.constants.species() * std::size_t(grid.dimensions), core::make_field(grid));
  m.effects.forces.push_back(std::make_unique<Lift>(m.constants, m.boundaries));
}

}  // namespace

namespace makers {

extern const Maker lift;
const Maker lift{&relevance::effects::lift, "Force", make_lift, {"saffman_mei"}};

}  // namespace makers

}  // namespace polybed::tfm
