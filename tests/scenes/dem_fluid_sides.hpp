// Forces of the fluid beside drag: particles in fields that the test holds, and in a fluid that moves.
#pragma once

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "dem/coupling/particle_forces.hpp"
#include "dem/effects/side_forces.hpp"
#include "dem/verlet.hpp"
#include "fluid/vorticity.hpp"
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {

/// One species of spheres in a closed box of water, without gravity, that only feel what the test names.
inline core::Scene sphere_in_water(double diameter, double density, dem::Vector size, std::array<int, 3> cells) {
  core::Scene scene = dry_box(0.5 * diameter, {1e6, 0.25, density}, size);
  scene.column.cells = cells;
  scene.column.closed = true;
  scene.fluid.name = "test fluid";
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 1e-3;
  scene.effects["drag"] = "stokes";
  scene.dem.kernel = core::Kernel::bilinear;
  scene.dem.fluid_every = 4;
  return scene;
}

/// The loops of the effects over particles in the shear U_x = rate y that the test holds: no fluid is solved for.
/// \param every  steps of dt, s, in one of the fluid
class HeldShear {
 public:
  HeldShear(const core::Scene& scene, double rate, double dt, int every = 1, double gravity = 0,
            const std::vector<const dem::Maker*>& list = dem::effects())
      : materials_(scene),
        grid_(core::grid_of(scene.column, nullptr)),
        gather_(grid_, {2 * materials_.species()[0].radius}),
        drag_(scene, materials_, scene.fluid.density.value(), scene.fluid.viscosity.value()),
        sides(scene, materials_, scene.fluid.density.value(), scene.fluid.viscosity.value(), dt, every * dt, list),
        motion(materials_, scene.fluid.density.value(), {0, -gravity, 0}, {1, 1}, energy),
        every_(every),
        verlet_(false, dt, {}, {1, 1}, {1, 1}, 0) {
    core::FaceField velocity = core::make_face_field(grid_);
    for (int k = -2; k < grid_.cells[2] + 2; ++k)
      for (int j = -2; j < grid_.cells[1] + 2; ++j)
        for (int i = -2; i < grid_.cells[0] + 2; ++i)
          velocity[0][std::size_t(grid_.index(i, j, k))] = rate * grid_.centre(1, j);
    gather_.take({core::make_field(grid_)}, velocity, core::make_face_field(grid_));
    std::array<core::Field, 3> vorticity;
    fluid::find_vorticity(grid_, velocity, vorticity);
    gather_.take_vorticity(vorticity);
  }

  void add(const dem::Vector& x, const dem::Vector& v, const dem::Vector& w = {}) {
    const dem::Species& s = materials_.species()[0];
    particles.add({{x, s.radius}, {v, 1 / s.mass, w, 1 / s.inertia}, {}, std::int64_t(particles.size()), 0});
    particles.owned = particles.size();
    motion.load.resize(particles.owned);
  }
  void begin() {
    drag_.find(particles, gather_, motion.load);
    sides.begin(particles, gather_, motion.load);
    relax();
  }
  void step() {
    verlet_.begin(particles, {&motion});
    drag_.find(particles, gather_, motion.load);
    sides.find(particles, gather_, motion.load);
    relax();
    verlet_.mark(particles);
    verlet_.end(particles, {&motion}, 0);
    sides.turn(particles, motion);
    if (++steps_ % every_ != 0) return;
    drag_.find(particles, gather_, motion.load);
    sides.refresh(particles, gather_, motion.load);
    relax();
  }

  static constexpr dem::FixedPoint energy{0x1p80, 0x1p-80};  ///< J

 private:
  void relax() { motion.relax(particles, 0.5 * verlet_.dt()); }

  dem::Materials materials_;
  core::Grid grid_;
  dem::Gather gather_;
  dem::ParticleForces drag_;

 public:
  dem::SideForces sides;
  dem::FluidMotion motion;
  dem::Particles particles;

 private:
  int every_;
  std::int64_t steps_ = 0;
  dem::Verlet verlet_;
};

}  // namespace polybed::scenes
