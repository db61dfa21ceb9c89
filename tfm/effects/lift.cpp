// Slot Force: lift of spheres in a sheared fluid, closures/lift_saffman_mei.hpp.
#include "relevance/effects/lift.hpp"

#include <algorithm>
#include <array>

#include "closures/lift_saffman_mei.hpp"
#include "closures/sphere.hpp"
#include "fluid/vorticity.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::tfm {

namespace {

using core::Index;

/// Saffman's lift with the share of Mei on each species, from slip and vorticity at the centres of cells: that of one
/// sphere, at any voidage. Like drag it sees the slip that the flux through both faces has at the cell's voidage, which
/// a surface beside the cell does not change, and the local density of a compressible fluid.
class Lift final : public ForceEffect {
 public:
  Lift(const Constants& constants, const fluid::Boundaries& boundaries)
      : constants_(constants), boundaries_(boundaries) {}

  void add(Fields& fields) override {
    fluid::find_vorticity(constants_.grid, fields.fluid.velocity, fields.force.vorticity);
    const double* density = fields.fluid.compression.present() ? fields.fluid.compression.density.data() : nullptr;
    const auto dimensions = std::size_t(constants_.grid.dimensions);
    for (std::size_t j = 0; j < constants_.species(); ++j) {
      const double diameter = constants_.diameter[j], per_volume = 1 / closures::sphere_volume(0.5 * diameter);
      core::for_each_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) {
          const auto at = std::size_t(c);
          const std::array<core::Field, 3>& omega = fields.force.vorticity;
          const closures::Vec3 force = closures::lift_saffman_mei(
              slip(fields, j, c), {omega[0][at], omega[1][at], omega[2][at]}, diameter,
              density == nullptr ? constants_.fluid.density : density[c], constants_.fluid.viscosity);
          const std::array<double, 3> parts{force.x, force.y, force.z};
          for (std::size_t a = 0; a < dimensions; ++a)
            fields.force.on_solids[j * dimensions + a][at] += per_volume * parts[a];
        }
      });
    }
  }

 private:
  /// U_f - U_j, m/s.
  [[nodiscard]] closures::Vec3 slip(const Fields& fields, std::size_t j, Index c) const {
    std::array<double, 3> w{};
    const double* eps = fields.fluid.voidage.data();
    const double scale = 0.5 / std::max(eps[c], fluid::voidage_floor);
    for (int axis = 0; axis < constants_.grid.dimensions; ++axis) {
      const auto a = std::size_t(axis);
      const Index s = constants_.grid.stride(axis);
      const double *u = fields.fluid.velocity[a].data(), *v = fields.solids.velocity[j][a].data();
      w[a] =
          scale * (core::face_mean(eps, c, s) * (u[c] - v[c]) + core::face_mean(eps, c + s, s) * (u[c + s] - v[c + s]));
    }
    return {w[0], w[1], w[2]};
  }

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
