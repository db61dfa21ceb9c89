// Minimum fluidisation of particles: a settled bed leaves its floor where the pressure carries it.
#include <numeric>

#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double diameter = 2e-3, density = 2500, g = 9.81, side = 6.9e-3;
constexpr int rows = 20;
constexpr dem::Vector size{side, rows* side / 2, side};
constexpr double buoyant = (density - water.density) * g;  // N per m3 of solids

core::Scene bed_scene() {
  core::Scene scene = wet_box(diameter, density, water, size, {2, rows, 2});
  scene.species[0].youngs_modulus = 1e7;
  scene.column.closed = false;
  scene.column.sides = core::Boundary::periodic;
  scene.column.gravity = g;
  scene.effects["drag"] = "ergun";
  scene.dem.greatest_speed = 0.1;
  scene.dem.fluid_every = 16;
  return scene;
}

/// 270 spheres on a lattice, uneven so that it does not stay one, after they have fallen without a fluid for 0.2 s.
std::vector<Bead> settled_bed() {
  std::vector<Bead> beads = cubic_lattice("a", 2.3e-3, {side, 30 * 2.3e-3, side});
  int n = 0;
  for (Bead& b : beads) {
    b.x[1] *= 2.04 / 2.3;
    b.x[0] += 0.1e-3 * std::sin(++n * 12.9898);
    b.x[2] += 0.1e-3 * std::sin(n * 78.233);
  }
  core::Scene scene = bed_scene();
  scene.fluid.name = "none";
  scene.effects.erase("drag");
  scene.dem.greatest_speed = 1;
  Beads dry(scene, beads);
  dry.until(0.2);
  for (std::size_t i = 0; i < beads.size(); ++i) {
    beads[i].x = dry.place(std::int64_t(i)).x;
    for (const std::size_t k : {0, 2}) beads[i].x[k] -= std::floor(beads[i].x[k] / side) * side;
  }
  return beads;
}

/// Ergun's gradient, Pa/m (Chem. Eng. Prog. 48, 1952, 89), in a layer of a solids fraction.
double ergun_gradient(double fraction, double flux) {
  const double eps = 1 - fraction, cube = eps * eps * eps;
  return 150 * water.viscosity * fraction * fraction * flux / (cube * diameter * diameter) +
         1.75 * water.density * fraction * flux * flux / (cube * diameter);
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// What share of their buoyant weight layers get from the pressure of a flux past them.
double share_carried(const std::vector<double>& fraction, double flux) {
  double pressure = 0;
  for (const double phi : fraction) pressure += ergun_gradient(phi, flux);
  return pressure / (buoyant * sum(fraction));
}

/// Where layers of solids fractions are carried as a whole, m/s.
double minimum_fluidisation(const std::vector<double>& fraction) {
  double least = 0, most = 1;
  for (int n = 0; n < 60; ++n) {
    const double flux = 0.5 * (least + most);
    (share_carried(fraction, flux) < 1 ? least : most) = flux;
  }
  return least;
}

/// What a bed shows at an instant.
struct Look {
  double flux = 0;              ///< of the inlet, m/s
  std::vector<double> layers;   ///< solids fraction of each row of cells
  double middle = 0, drop = 0;  ///< pressure over the buoyant weight in its way, in the middle of the bed and of all
  double speed = 0;             ///< of the bed's centre upward, m/s
  double floor = 0;             ///< what the floor carries, of the buoyant weight
};

constexpr std::size_t low = 3, high = 8;  ///< rows of cells about the middle half of the bed

/// Solids fractions between the centres of those rows.
std::vector<double> middle_of(const std::vector<double>& layers) {
  std::vector<double> between;
  for (std::size_t j = low; j < high; ++j) between.push_back(0.5 * (layers[j] + layers[j + 1]));
  return between;
}

Look look_at(const Beads& bed) {
  const fluid::Flow& flow = bed.model.coupling()->flow();
  const dem::Particles& particles = bed.model.particles();
  const auto count = double(particles.owned);
  Look look;
  std::vector<double> pressure(rows, 0);
  look.layers.assign(rows, 0);
  for (int j = 0; j < rows; ++j)
    for (const int i : {0, 1})
      for (const int k : {0, 1}) {
        const auto c = std::size_t(flow.grid().index(i, j, k));
        pressure[std::size_t(j)] += 0.25 * flow.state().pressure[c];
        look.layers[std::size_t(j)] += 0.25 * bed.model.coupling()->fraction()[0][c];
      }
  const double weight = count * buoyant * pi / 6 * std::pow(diameter, 3);
  look.flux = flow.inlet().mean_velocity(bed.model.time());
  look.middle = (pressure[low] - pressure[high]) / (buoyant * size[1] / rows * sum(middle_of(look.layers)));
  look.drop = bed.model.coupling()->pressure_drop() * side * side / weight;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    look.speed += particles.motion[i].v[1] / count;
    // Contacts among particles cancel in the sum of all loads: what is left is the floor's.
    look.floor += double(particles.load[i].force[1]) * bed.model.unit_of_force().unit / weight;
  }
  return look;
}

/// Runs the bed under a ramp, and returns how it looked every millisecond.
std::vector<Look> ramped(double first, double last, double time) {
  core::Scene scene = bed_scene();
  scene.inlet.superficial_velocity = {{0.0, first}, {time, last}};
  Beads bed(scene, settled_bed());
  std::vector<Look> looks;
  while (bed.model.time() < time - 1e-3) {
    bed.steps(128);
    looks.push_back(look_at(bed));
  }
  return looks;
}

// Particles follow the flux that is left over: u - U_p is what the law's velocity stands for. Tolerances: the bed is no
// layers but a packing, whose voidages beside each other differ by 0.01; Ergun's curve bends by less than 1 % over
// that.
TEST(DemFluidisation, TheBedLeavesItsFloorAtMinimumFluidisation) {
  constexpr double first = 0.011, last = 0.0275, time = 0.4;  // half to five quarters of it
  const std::vector<Look> looks = ramped(first, last, time);
  const auto at = [&](double flux) {
    return std::find_if(looks.begin(), looks.end(), [&](const Look& l) { return l.flux >= flux; });
  };
  const auto packed = at(0.0165), risen = std::prev(looks.end());
  const double speeding_up =
      water.density * (last - first) / time * rows / (buoyant * sum(packed->layers));  // of water
  compare("packed: pressure drop over buoyant weight", packed->drop,
          share_carried(packed->layers, packed->flux - packed->speed) + speeding_up, 0.02);
  compare("packed: speed over flux", packed->speed, 0, 0.02, packed->flux);  // what the contacts still spring back

  // The start, when the water takes over a share of the weight, shakes the bed until 0.0135 m/s.
  const auto carried = std::find_if(at(0.0135), looks.end(), [](const Look& l) { return l.middle >= 1; });
  ASSERT_NE(carried, looks.end());
  compare("flux at which the pressure carries the middle", carried->flux - carried->speed,
          minimum_fluidisation(middle_of(carried->layers)), 0.02);

  // Risen: the bed goes with all the flux beyond that which carries it. To speed it up takes 0.4 % of its weight.
  compare("flux at which the bed rises", risen->flux - risen->speed, minimum_fluidisation(risen->layers), 0.02);
  EXPECT_GT(risen->speed, 0.1 * risen->flux) << "it has not risen";
  compare("risen: pressure drop over buoyant weight", risen->drop, 1 + speeding_up, 0.02);
  compare("risen: on the floor over buoyant weight", risen->floor, 0, 0.02, 1);
}

}  // namespace
}  // namespace polybed::scenes
