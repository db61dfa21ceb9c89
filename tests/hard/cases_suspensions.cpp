// Hard cases of particles in a fluid: C1, C4 to C10. C2 and C3 are in cases_one_sphere.cpp.
#include <algorithm>
#include <cmath>

#include "closures/lubrication.hpp"
#include "core/error.hpp"
#include "core/numerics/random.hpp"
#include "hard/cases.hpp"
#include "hard/grains.hpp"
#include "hard/suspension.hpp"

namespace polybed::hard {

namespace {

using scenes::Bead;
using scenes::Beads;
using scenes::Liquid;

constexpr double earth_gravity = 9.81;

double fastest(const dem::Particles& particles) {
  double most = 0;
  for (std::size_t i = 0; i < particles.owned; ++i)
    for (const double v : particles.motion[i].v) most = std::isfinite(v) ? std::max(most, std::abs(v)) : 1e300;
  return most;
}

/// C1: one sphere larger than a cell: least voidage, and its greatest jump when the sphere goes 1e-6 of its diameter.
void larger_than_cells(Trial& trial) {
  for (const auto& [diameter, cell] : {std::pair{9.5e-3, 8e-3}, {15e-3, 11.4e-3}}) {
    core::Scene scene = scene_of(diameter, 2800, scenes::water, cell, {7, 9, 7}, 1);
    // There is no kernel in the textbook's treatment.
    if (!trial.naive()) scene.dem.kernel_width = 6 * diameter;
    scene.dem.kernel = trial.naive() ? core::Kernel::bilinear : core::Kernel::diffusion;
    for (int n = 0; n < 10; ++n) {
      core::Field before;
      for (const double step : {-0.5e-6, 0.5e-6}) {
        const Bead bead{"a", {3.5 * cell, (3.5 + n / 10.0) * cell + step * diameter, 3.5 * cell}};
        const core::Field now = begin_suspension(trial, scene, {bead}, 1e-6)->voidage();
        double jump = 0, least = 1;
        for (std::size_t c = 0; c < now.size(); ++c) {
          least = std::min(least, now[c]);
          if (!before.empty()) jump = std::max(jump, std::abs(now[c] - before[c]));
        }
        trial.measure("V2 voidage below 0.2", std::max(0.2 - least, 0.0), 0);
        // 1e-6 of the diameter, of a voidage that changes by less than 1 over a cell.
        trial.measure("jump of the voidage", jump, 1e-5);
        before = now;
      }
    }
  }
}

/// C4: a light sphere is let go: its acceleration is that with the fluid which it carries.
void light_spheres(Trial& trial) {
  for (const double ratio : {1.5, 0.5, 0.1, 0.001}) {
    if (trial.naive() && ratio < 0.1) continue;  // it has diverged at 0.1
    core::Scene scene = scene_of(1e-3, ratio * 1000, scenes::water, 20e-3, {5, 5, 5}, 1);
    scene.column.gravity = earth_gravity;
    scene.effects = {{"contact", "hertz_mindlin"}, {"added_mass", "half"}};
    scene.dem.greatest_speed = 5;
    const auto run = begin_suspension(trial, scene, {{"a", {47e-3, 52e-3, 51e-3}}}, 2e-5);
    for (int n = 0; n < 24; ++n) run->step();
    const double expected = earth_gravity * (1 - ratio) / (ratio + 0.5),
                 found = run->particles().motion[0].v[1] / (24 * 2e-5);
    trial.measure("acceleration", std::abs(found / expected - 1), 1e-3);
  }
}

/// C5: 60 um grains in air, steps of six relaxation times and more: slip ends, and nothing grows.
void stiff_drag(Trial& trial) {
  const double kappa = 18 * 1.8e-5 / (2500 * 60e-6 * 60e-6);
  for (const double steps : {6.0, 1000.0}) {
    const core::Scene scene = scene_of(60e-6, 2500, scenes::gas, 1e-3, {4, 4, 4}, 4);
    const auto run = begin_suspension(trial, scene, {{"a", {2.1e-3, 1.8e-3, 1.9e-3}, {1e-7, 0, 0}}}, steps / kappa);
    for (int n = 0; n < 25; ++n) run->step();
    // What is left is what the gas has taken of the momentum, m/(rho_f psi) = 2e-1 and spreading.
    trial.measure("speed left", fastest(run->particles()) / 1e-7, 0.3);
  }
}

/// C6: 1, 7, 16, 1000 steps of the particles to one of the fluid: momentum of both together stays.
void many_steps_to_one(Trial& trial) {
  for (const int every : {1, 7, 16, 1000}) {
    core::Scene scene = scene_of(0.5e-3, 2500, scenes::water, 2e-3, {4, 3, 4}, every);
    scene.column.sides = core::Boundary::periodic;
    scene.dem.greatest_speed = 0.01;
    const double phi = scenes::pi / 6 / 64, relaxation = 2500 * 0.25e-6 / 18e-3;
    const auto beads = scenes::cubic_lattice("a", 2e-3, scene.column.size, {1e-3, 0, 0});
    const auto run = begin_suspension(trial, scene, beads, relaxation / every);
    run->step();
    const core::Grid grid = core::grid_of(scene.column, nullptr);
    const double fluid = run->flow().state().velocity[0][std::size_t(grid.index(1, 1, 1))];
    const double kept = ((1 - phi) * 1000 * fluid + phi * 2500 * run->particles().motion[0].v[0]) / (phi * 2500 * 1e-3);
    trial.measure("V4 momentum of both", std::abs(kept - 1), 1e-12);
  }
}

/// C7: drag laws where particles are packed to a solids fraction of 0.80: positive and finite.
void beyond_packing(Trial& trial) {
  const auto guard = trial.naive() ? closures::Guard::off : closures::Guard::on;
  for (const std::string& name : trial.naive() ? std::vector<std::string>{"cello"} : closures::drag_law_names())
    for (double reynolds = 1e-6; reynolds < 1e5; reynolds *= 2)
      for (const double eps : {0.2, 0.26, 0.34, 0.36}) {
        const closures::DragLaw law = closures::drag_law(name, guard);
        std::array<double, 1> f{}, slope{};
        closures::GuardCount count;
        closures::drag_of_points(law, std::array{eps}, std::array{reynolds}, f, slope, count);
        trial.measure("V13 drag power below 0", f[0] > 0 ? 0 : 1 - f[0], 0);
        trial.measure("V3 finite f and derivative", std::isfinite(f[0]) && std::isfinite(slope[0]) ? 0 : 1, 0);
      }
}

/// C8: an uneven suspension of the fluid's density: nothing moves.
void neutral_at_rest(Trial& trial) {
  core::Scene scene = scene_of(1e-3, 1000, scenes::water, 2.5e-3, {4, 6, 4}, 10);
  scene.column.gravity = earth_gravity;
  scene.effects["drag"] = "cello";
  std::vector<Bead> beads;
  for (std::uint64_t n = 0; n < 60; ++n)  // one in each of some cubes of 1.25 mm, off their centres
    beads.push_back({"a",
                     {(double(n % 8) + 0.4 + 0.2 * core::uniform(3, 0, n)) * 1.25e-3,
                      (double(n / 8 % 8) + 0.4 + 0.2 * core::uniform(3, 1, n)) * 1.25e-3,
                      (0.4 + 0.2 * core::uniform(3, 2, n)) * 1.25e-3}});
  const auto run = begin_suspension(trial, scene, beads, 1e-4);
  for (int n = 0; n < 20; ++n) run->step();
  trial.measure("speed of what should rest, m/s", fastest(run->particles()), 1e-12);
}

/// C9: a held bed from creeping flow to ten times what would lift it: the pressure drop is that of the law.
void held_bed(Trial& trial) {
  constexpr double d = 2e-3, spacing = 2.5e-3;
  const dem::Vector size{10e-3, 20e-3, 5e-3};
  for (const auto& [law, velocity] : {std::pair{"ergun", 1e-4}, {"ergun", 0.5}, {"gidaspow", 0.2}, {"cello", 0.5}}) {
    core::Scene scene = scenes::wet_box(d, 2500, scenes::water, size, {2, 4, 1});
    scene.column.closed = false;
    scene.column.sides = core::Boundary::periodic;
    scene.inlet.superficial_velocity = {{0.0, velocity}};
    scene.effects["drag"] = law;
    scene.bed.held = true;
    scene.dem.fluid_every = 4;
    scene.dem.fixed_step = 0.1 * spacing / velocity / 4;
    Beads bed(scene, scenes::cubic_lattice("a", spacing, size));
    bed.steps(120);
    const double eps = 1 - scenes::pi / 6 * std::pow(d / spacing, 3);
    const double expected = 18 * 1e-3 * velocity * (1 - eps) * scenes::drag_of(law, eps, d, velocity, scenes::water) /
                            (eps * d * d) * size[1];
    trial.measure("pressure drop of the law", std::abs(bed.model.coupling()->pressure_drop() / expected - 1), 5e-3);
  }
}

/// C10: a sphere meets the floor in a liquid at Stokes numbers 5 to 1000: what rebounds over what a dry one does falls
/// to nothing below 10.
void impact_in_liquid(Trial& trial) {
  constexpr double d = 5e-3;
  const Liquid liquid{1000, 0.01};
  for (const double stokes : {5.0, 50.0, 1000.0}) {
    const double speed = stokes / closures::stokes_of_impact(2500, liquid.density, d, 1, liquid.viscosity);
    core::Scene scene = scene_of(d, 2500, liquid, 50e-3, {3, 3, 3}, 16);
    scene.species[0].youngs_modulus = 1e9;
    scene.effects.erase("drag");
    scene.effects["contact"] = "hertz_mindlin";
    if (!trial.naive()) scene.effects["lubrication"] = "wet_restitution";
    core::set_restitution(scene, 0.9);
    scene.dem.tail = core::Tail::keep;  // a clipped one leaves 0.05 at least, where less than 0.001 is asked for
    scene.dem.steps_per_contact = 400;  // a strongly damped impact to 1 %
    scene.dem.max_overlap = 0.2;
    scene.dem.greatest_speed = 2 * speed;
    Beads run(scene, {{"a", {75e-3, 0.5 * d * (1 + 1e-9), 75e-3}, {0, -speed, 0}}});
    for (int n = 0; n < 100'000 && (run.motion(0).v[1] < 0 || run.place(0).x[1] < 0.5 * d); ++n) run.steps(1);
    const double left = run.motion(0).v[1] / (0.9 * speed), expected = std::exp(-35 / stokes);
    trial.measure("rebound over that of a dry sphere", std::abs(left - expected), 0.03);
  }
}

}  // namespace

std::vector<HardCase> suspension_cases() {
  const std::vector<Treatment> coupled{{"coupled", "", ""}};
  return {{"C1", "a sphere larger than its cells", {"pcm_void"}, coupled, larger_than_cells},
          {"C4", "release of spheres lighter than the fluid", {"added_mass_lagged"}, coupled, light_spheres},
          {"C5", "steps of six to a thousand relaxation times", {"drag_explicit"}, coupled, stiff_drag},
          {"C6", "1 to 1000 solid steps to a fluid step", {"last_substep"}, coupled, many_steps_to_one},
          {"C7", "drag at a solids fraction of 0.80", {"raw_drag"}, coupled, beyond_packing},
          {"C8", "neutrally buoyant particles at rest", {"double_buoyancy"}, coupled, neutral_at_rest},
          {"C9", "flow through fixed particles at any velocity", {}, coupled, held_bed, false},
          {"C10", "impact of a sphere in a liquid", {"dry_restitution"}, coupled, impact_in_liquid, false}};
}

}  // namespace polybed::hard
