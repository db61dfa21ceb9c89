// T14: a suspension settles in a channel that leans, with cells too few for the layers along its walls.
#include <cmath>
#include <numbers>

#include "closures/bed_expansion.hpp"
#include "closures/drag.hpp"
#include "hard/cases.hpp"
#include "hard/scenes.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::hard {

namespace {

/// Length, m, that a suspension still fills of a channel after a time, measured along it. Ponder (1925) and Nakamura
/// and Kuroda (1937), as Acrivos and Herbolzheimer (1979) have it, from memory: clear fluid forms over what the
/// suspension covers of a level surface, dL/dt = -v (cos a + (L/b) sin a). Range: a clear layer much thinner than the
/// channel and sediment that slides down at once; below 0 there is none left.
/// \param start     L at time 0, m
/// \param width     b, distance of the plates, m
/// \param velocity  v, at which the suspension settles in an upright vessel, m/s
/// \param angle     a, of the plates to the vertical, above 0, below pi/2
/// \param time      s
double suspension_length(double start, double width, double velocity, double angle, double time) {
  const double end = -width / std::tan(angle);
  return end + (start - end) * std::exp(-velocity * std::sin(angle) * time / width);
}

constexpr double channel_width = 6e-3, channel_length = 0.12, fraction = 0.1, degree = std::numbers::pi / 180;

/// Glass of 0.1 mm at a fraction of 0.1 in a closed channel of 6 x 120 mm that leans to the right (to the left if the
/// angle is negative), `cells` across. Without a viscosity of the fluid in its walls there would be no layers to miss.
core::Scene leaning_channel(double angle, int cells, double viscosity) {
  core::Scene scene = uniform_bed(1e-4, 2500, 998.207, viscosity, fraction, 60, channel_length);
  scene.column.size = {channel_width, channel_length, channel_width / 3};
  scene.column.cells = {cells, 60, 1};
  scene.column.sides = core::Boundary::wall;
  scene.column.closed = true;
  scene.column.down = {std::sin(angle), -std::cos(angle), 0};
  scene.effects = {{"drag", "wen_yu"}, {"solids_stress", "frictional"}, {"fluid_stress", "newtonian"}};
  scene.tfm.max_packing = 0.62;
  scene.tfm.rtol = 1e-3;
  return scene;
}

/// Speed at which the suspension falls in an upright vessel, m/s: the volume flux is 0, so it is the superficial slip.
double upright_velocity(const core::Scene& scene) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const core::Species& species = scene.species[0];
  const closures::CarriedBed bed{species.diameter, species.density - fluid.density, fluid.density, fluid.viscosity,
                                 scene.column.gravity};
  const closures::DragLaw law = closures::drag_law(scene.effects.at("drag"), closures::Guard::on);
  const auto f = [&](double voidage, double reynolds) { return closures::pure_drag_at(law, voidage, reynolds); };
  return closures::carrying_velocity(f, bed, 1 - fraction);
}

/// Three cells across at 5, 30 and 60 degrees; at 30 to either side: mirror images.
void three_cells(Trial& trial) {
  for (const double angle : {5.0, 30.0, 60.0}) {
    const auto run = trial.begin(leaning_channel(angle * degree, 3, 1.00157e-3));
    trial.advance(*run, 0.6);
  }
  see_mirror_images(trial, 0.2, [&](bool left) {
    core::Scene scene = leaning_channel((left ? 30 : -30) * degree, 3, 1.00157e-3);
    scene.tfm.fixed_step = 1e-3;
    scene.tfm.pressure_tolerance = 1e-13;
    return trial.begin(scene);
  });
}

/// The rate at which the suspension draws back, from 6 to 12 s, over that of theory, in a liquid in which the layers
/// are laminar, with `cells` across.
double rate_over_theory(Trial& trial, int cells) {
  const core::Scene scene = leaning_channel(30 * degree, cells, 1e-2);
  const double settling = upright_velocity(scene);
  const auto run = trial.begin(scene);
  std::vector<double> filled;
  for (const double time : {6.0, 12.0}) {
    trial.advance(*run, time);
    filled.push_back(measures::bed_height(profile_of(*run)).value_or(0));
  }
  return (filled[0] - filled[1]) /
         (filled[0] - suspension_length(filled[0], channel_width, settling, 30 * degree, 6.0));
}

/// Three cells do not hold a clear layer of a tenth of the width; 24 do.
void rate_of_settling(Trial& trial, int cells) {
  const double ratio = rate_over_theory(trial, cells);
  trial.report("rate over theory, " + std::to_string(cells) + " cells", ratio);
  trial.measure("settling rate as in theory", std::abs(ratio - 1), 0.1);
}

}  // namespace

std::vector<HardCase> leaning_cases() {
  const std::vector<Treatment> implicit{{"implicit", "limited", ""}};
  return {{"T14",
           "a channel that leans by 5 to 60 degrees, three cells wide",
           {"central_flux"},
           all_schemes(),
           three_cells},
          {"T14 rate",
           "settling rate in a leaning channel, three cells wide",
           {},
           implicit,
           [](Trial& t) { rate_of_settling(t, 3); }},
          {"T14 fine", "settling rate in a leaning channel, 24 cells wide", {}, implicit, [](Trial& t) {
             rate_of_settling(t, 24);
           }}};
}

}  // namespace polybed::hard
