// Models A and B: the pressure's gradient may act on particles and fluid, or on the fluid alone with a drag that is
// 1/eps times as great.
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double diameter = 2e-3, spacing = 2.5e-3, density = 2500, g = 9.81;
constexpr dem::Vector size{20e-3, 40e-3, 10e-3};
const double volume = pi / 6 * std::pow(diameter, 3);
const double voidage = 1 - pi / 6 * std::pow(diameter / spacing, 3);

core::Scene open_box(const std::string& law, double velocity, const Liquid& fluid) {
  core::Scene scene = wet_box(diameter, density, fluid, size, {4, 8, 1});
  scene.column.closed = false;
  scene.column.sides = core::Boundary::periodic;
  scene.inlet.superficial_velocity = {{0.0, velocity}};
  scene.effects["drag"] = law;
  return scene;
}

/// k, kg/s: force of the drag law alone over the slip of the fluid between the particles.
double drag_over_slip(const std::string& law, double slip, const Liquid& fluid) {
  return 3 * pi * fluid.viscosity * diameter * voidage * drag_of(law, voidage, diameter, voidage * slip, fluid);
}

/// Drag and pressure gradient together on every particle of a held bed.
void compare_with_model_b(const std::string& law, double velocity, const Liquid& fluid) {
  core::Scene scene = open_box(law, velocity, fluid);
  scene.bed.held = true;
  scene.dem.fluid_every = 4;
  scene.dem.fixed_step = 0.1 * spacing / velocity / 4;
  Beads bed(scene, cubic_lattice("a", spacing, size));
  bed.steps(30 * 4);
  const double slip = velocity / voidage, model_b = drag_over_slip(law, slip, fluid) * slip / voidage;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const dem::FluidLoad& load : bed.model.coupling()->motion().load) {
    const double force = load.drag * load.velocity[1] + load.force[1];
    least = std::min(least, force);
    most = std::max(most, force);
  }
  // The fields are even: what is left is the residual of the pressure solve, 1e-8.
  const std::string name = fmt::format("{}, {:g} m/s", law, velocity);
  compare(name + ": least force", least, model_b, 1e-6);
  compare(name + ": greatest force", most, model_b, 1e-6);
}

// T(1.22): without a pressure gradient on the solids, their drag is 1/eps times as great.
TEST(DemForms, TheForceInAHeldBedIsThatOfModelB) {
  for (const std::string& law : closures::drag_law_names()) compare_with_model_b(law, 0.02, water);
  compare_with_model_b("gidaspow", 1, gas);
}

/// Model B by hand for an even suspension, whose fluxes phi U_p + eps U_f are the inlet's at every height:
///   rho_p dU_p/dt = -(rho_p - rho_f) g + rho_f dU_f/dt + k (U_f - U_p)/(eps V),  phi dU_p + eps dU_f = 0.
double acceleration_of_model_b(const std::string& law, double flux, double velocity, const Liquid& fluid) {
  const double slip = (flux - velocity) / voidage;
  return (-(density - fluid.density) * g + drag_over_slip(law, std::abs(slip), fluid) * slip / (voidage * volume)) /
         (density + fluid.density * (1 - voidage) / voidage);
}

/// Velocity at a time from rest: Runge-Kutta, 1e-10 at 200 steps within two relaxation times.
double velocity_of_model_b(const std::string& law, double flux, double time, const Liquid& fluid) {
  constexpr int steps = 200;
  const double h = time / steps;
  const auto rate = [&](double v) { return acceleration_of_model_b(law, flux, v, fluid); };
  double v = 0;
  for (int n = 0; n < steps; ++n) {
    const double a = rate(v), b = rate(v + 0.5 * h * a), c = rate(v + 0.5 * h * b), d = rate(v + h * c);
    v += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return v;
}

/// Of a particle half way up, where nothing has come from the ends.
double velocity_of_suspension(double flux, double time, int fluid_steps, const Liquid& fluid) {
  core::Scene scene = open_box("ergun", flux, fluid);
  scene.column.gravity = g;
  scene.dem.fluid_every = 2;
  scene.dem.fixed_step = time / fluid_steps / 2;
  scene.dem.greatest_speed = 0.1;
  const std::vector<Bead> lattice = cubic_lattice("a", spacing, size);
  Beads bed(scene, lattice);
  bed.steps(2 * fluid_steps);
  const auto middle = std::find_if(lattice.begin(), lattice.end(), [](const Bead& b) { return b.x[1] > size[1] / 2; });
  return bed.motion(middle - lattice.begin()).v[1];
}

// Flow a third above that in which it would hover, for about a relaxation time; in water, whose own inertia counts.
TEST(DemForms, ASuspensionSpeedsUpAsModelBHasIt) {
  constexpr double flux = 0.1, time = 0.01;
  const double expected = velocity_of_model_b("ergun", flux, time, water);
  const double coarse = velocity_of_suspension(flux, time, 100, water),
               fine = velocity_of_suspension(flux, time, 200, water);
  testing::Test::RecordProperty("by 100 steps", fmt::format("{:.3g}", coarse / expected - 1));
  // First order: a step is 0.5 % of the time, and its error a share of that. What is left after both is of second
  // order.
  compare("velocity after 10 ms, by 200 steps", fine, expected, 1e-3);
  compare("extrapolated to no step", 2 * fine - coarse, expected, 2e-5);
}

}  // namespace
}  // namespace polybed::scenes
