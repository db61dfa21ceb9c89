// Spin of spheres in a fluid, closures/magnus_rubinow_keller.hpp: the side force, and the torque that damps the spin.
#include <cmath>
#include <vector>

#include "closures/magnus_rubinow_keller.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/side_forces.hpp"
#include "dem/effects/side_vectors.hpp"
#include "relevance/effects/magnus.hpp"

namespace polybed::dem {

namespace {

using closures::Vec3;

/// The force is explicit; it turns the slip at a rate of at most (3/4) rho_f |Omega - omega/2|/rho_p. The torque is
/// integrated exactly in a frozen fluid, Omega - omega/2 falling as exp(-60 mu t/(rho_p d^2)): any step is stable. The
/// averaged fluid has no spin of its own: the torque's reaction becomes heat in it.
class Magnus final : public SideForce {
 public:
  /// \param density, viscosity  of the fluid, kg/m3, Pa s  \param dt  step of the particles, s
  Magnus(const Materials& materials, double density, double viscosity, double dt)
      : density_(density), viscosity_(viscosity) {
    for (const Species& s : materials.species())
      constants_.push_back(
          {2 * s.radius, -std::expm1(-closures::spin_resistance(viscosity, 2 * s.radius) * dt / s.inertia)});
  }
  [[nodiscard]] bool needs_vorticity() const override { return true; }
  void add(const SideView& view, SideRows& rows) override {
    for (std::size_t i = 0; i < view.loads.size(); ++i) {
      const Vec3 spin =
          closures::spin_relative_to_fluid(to_vec3(view.particles.motion[i].w), to_vec3(view.vorticity[i]));
      const double d = constants_[std::size_t(view.particles.species[i])].diameter;
      add_to(rows.of(i), closures::magnus_rubinow_keller(slip_of(view, i), spin, d, density_, viscosity_));
    }
  }

  void turn(std::span<const Vector> vorticity, Particles& particles, FluidMotion& motion) override {
    for (std::size_t i = 0; i < particles.owned; ++i) {
      Motion& m = particles.motion[i];
      const Vec3 before = to_vec3(m.w), relative = closures::spin_relative_to_fluid(before, to_vec3(vorticity[i]));
      const Vec3 change = -constants_[std::size_t(particles.species[i])].turned * relative;
      motion.account_work(closures::dot(before + 0.5 * change, change) / m.inverse_inertia);
      put(m.w.data(), before + change);
    }
  }

 private:
  struct Constants {
    double diameter;  ///< m
    double turned;    ///< 1 - exp(-60 mu dt/(rho_p d^2)): relaxation of the spin to the fluid's in a step
  };
  std::vector<Constants> constants_;  ///< of each species
  double density_, viscosity_;
};

}  // namespace

namespace makers {

extern const Maker magnus;
const Maker magnus{&relevance::effects::magnus, "Force",
                   MakeForce([](const ForceMaking& m) -> std::unique_ptr<SideForce> {
                     return std::make_unique<Magnus>(m.materials, m.density, m.viscosity, m.dt);
                   })};

}  // namespace makers

}  // namespace polybed::dem
