// Partial slip of the solids along walls, after Johnson and Jackson.
#include <algorithm>
#include <cmath>

#include "closures/kinetic_theory.hpp"
#include "core/error.hpp"
#include "core/numerics/operators.hpp"
#include "tfm/effects.hpp"
#include "tfm/solids.hpp"

namespace polybed::tfm {

namespace {

using core::face_mean;
using core::Index;

/// mu_s dU_t/dn = -B U_t with B = pi sqrt(3 theta) s rho phi g0/(6 phi_max) + p_f tan(delta_w)/|U_t|, n outward: sets
/// the ghosts of the velocities so that the wall's shear stress matches U_t half way between ghost and cell. The
/// collisional part is stress.wall, which is absent without kinetic theory.
class JohnsonJacksonWall : public SolidsWall {
 public:
  JohnsonJacksonWall(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields)
      : constants_(constants),
        boundaries_(boundaries),
        tangent_(scene.tfm.wall_friction),
        least_shear_rate_(scene.tfm.least_shear_rate) {
    if (!fields.stress.viscous())
      throw core::StartError(
          "tfm.solids_wall = \"johnson_jackson\" acts through a viscosity of the solids: effects.solids_viscosity, or "
          "effects.solids_stress = \"kinetic\"");
    fields.stress.contact = core::make_field(constants.grid);
  }

  void fill_ghosts(Fields& fields) override {
    const core::Grid& grid = constants_.grid;
    for (int wall = 0; wall < grid.dimensions; ++wall)
      for (int side = 0; side < 2; ++side) {
        if (!boundaries_.stops_solids(wall, side)) continue;
        for (int along = 0; along < grid.dimensions; ++along)
          for (std::size_t j = 0; j < constants_.species() && along != wall; ++j) fill(fields, j, along, wall, side);
      }
  }

 private:
  /// Fills the layer of ghosts beyond one wall for the velocity of one species along one axis.
  void fill(Fields& fields, std::size_t species, int along, int wall, int side) const {
    const core::Grid& grid = constants_.grid;
    const auto w = std::size_t(wall), a = std::size_t(along);
    const Index s = grid.stride(along), outward = side == 0 ? -grid.stride(wall) : grid.stride(wall);
    const int third = grid.dimensions == 3 ? 3 - wall - along : along;
    const double h = grid.size_at_end(wall, side);
    const double *phi = fields.solids_fraction.data(), *viscosity = fields.stress.viscosity.data(),
                 *contact = fields.stress.contact.data(),
                 *v = fields.solids.velocity[species][std::size_t(third)].data();
    const double* collisions = fields.stress.wall.empty() ? nullptr : fields.stress.wall.data();
    double* u = fields.solids.velocity[species][a].data();
    core::Box box = core::owned_faces(grid, along);
    box.lo[w] = side == 0 ? 0 : grid.cells[w] - 1;
    box.hi[w] = box.lo[w] + 1;
    core::for_each_row(grid, box, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) {
        const Index t = grid.stride(third);
        const double across = third == along ? 0.0 : 0.25 * ((v[c] + v[c - s]) + (v[c + t] + v[c - s + t]));
        double friction = closures::wall_friction(std::max(face_mean(contact, c, s), 0.0), tangent_,
                                                  std::sqrt(u[c] * u[c] + across * across),
                                                  least_shear_rate_ * constants_.diameter[species]) /
                          std::max(face_mean(phi, c, s), stress_fraction_floor);
        if (collisions != nullptr) friction += face_mean(collisions, c, s);
        const double inner = face_mean(viscosity, c, s) / h;  // (mu/h)(u_ghost - u) = -B (u_ghost + u)/2
        u[c + outward] = inner > 0 ? u[c] * (inner - 0.5 * friction) / (inner + 0.5 * friction) : u[c];
      }
    });
  }

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  double tangent_, least_shear_rate_;
};

}  // namespace

std::unique_ptr<SolidsWall> johnson_jackson_wall(const core::Scene& scene, const Constants& constants,
                                                 const fluid::Boundaries& boundaries, Fields& fields) {
  return std::make_unique<JohnsonJacksonWall>(scene, constants, boundaries, fields);
}

}  // namespace polybed::tfm
