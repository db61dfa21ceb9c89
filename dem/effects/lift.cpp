// Lift on spheres in a sheared fluid, closures/lift_saffman_mei.hpp.
#include <vector>

#include "closures/lift_saffman_mei.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/side_forces.hpp"
#include "dem/effects/side_vectors.hpp"
#include "relevance/effects/lift.hpp"

namespace polybed::dem {

namespace {

/// Saffman's lift with Mei's share, from the slip U_f - U_p between the particles and the vorticity of the averaged
/// fluid: as for one sphere, at any voidage. Explicit: it turns the slip at r times the rate at which Stokes' drag
/// stops it, r = 0.17 sqrt(rho_f d^2 |omega|/mu); with exact drag any step is stable for r below 1.
class Lift final : public SideForce {
 public:
  /// \param density, viscosity  of the fluid, kg/m3, Pa s
  Lift(const Materials& materials, double density, double viscosity) : density_(density), viscosity_(viscosity) {
    for (const Species& s : materials.species()) diameter_.push_back(2 * s.radius);
  }
  [[nodiscard]] bool needs_vorticity() const override { return true; }
  void add(const SideView& view, SideRows& rows) override {
    for (std::size_t i = 0; i < view.loads.size(); ++i)
      add_to(rows.of(i),
             closures::lift_saffman_mei(slip_of(view, i), to_vec3(view.vorticity[i]),
                                        diameter_[std::size_t(view.particles.species[i])], density_, viscosity_));
  }

 private:
  std::vector<double> diameter_;  ///< of each species, m
  double density_, viscosity_;
};

}  // namespace

namespace makers {

extern const Maker lift;
const Maker lift{&relevance::effects::lift, "Force", MakeForce([](const ForceMaking& m) -> std::unique_ptr<SideForce> {
                   return std::make_unique<Lift>(m.materials, m.density, m.viscosity);
                 })};

}  // namespace makers

}  // namespace polybed::dem
