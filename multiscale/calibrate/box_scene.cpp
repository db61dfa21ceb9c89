// Scenes for the boxes: sheared cubes of spheres, dry or wet.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "closures/lubrication.hpp"
#include "closures/restitution.hpp"
#include "closures/sphere.hpp"
#include "closures/stress_reference.hpp"
#include "core/case/scene.hpp"
#include "core/error.hpp"
#include "multiscale/calibrate/plan.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

using std::numbers::pi;

/// Steps per contact, and the overlap over the diameter from the mean stress in a wet box.
constexpr double steps_per_contact = 20, wet_overlap = 1e-3;
constexpr double least_film = 0.005;  ///< thickness over the diameter, unless dem.roughness is greater

/// Values that determine the stiffness and the step.
struct Scales {
  MeanSphere mean;
  double least_mass;  ///< reduced, kg
};

std::vector<core::Species> species_of(const core::Scene& scene, const BoxPoint& point) {
  std::vector<core::Species> species;
  if (point.binary) {
    species = scene.species;
  } else {
    const MeanSphere mean = mean_sphere(scene.species, scene.bed.volume_share);
    species.resize(1);
    species[0].name = "mean";
    species[0].diameter = mean.diameter;
    species[0].density = mean.density;
  }
  for (core::Species& s : species)
    s.given_restitution = s.given_friction = s.youngs_modulus = s.poisson_ratio = std::nullopt;
  return species;
}

/// Numbers of particles for a share of the volume, about `number` in total.
std::vector<std::int64_t> numbers_of(const std::vector<core::Species>& species, double share, int number) {
  if (species.size() == 1) return {number};
  const double one = (1 - share) / std::pow(species[0].diameter, 3), two = share / std::pow(species[1].diameter, 3);
  return {std::llround(number * one / (one + two)), std::llround(number * two / (one + two))};
}

double reduced_mass(const std::vector<core::Species>& species) {
  double least = 1e300;
  for (const core::Species& s : species)
    least = std::min(least, 0.5 * s.density * closures::sphere_volume(0.5 * s.diameter));
  return least;
}

/// k of a damped contact with a given duration: t_c = pi sqrt(m*/k)/sqrt(1 - beta^2).
double stiffness_of(double mass, double restitution, double duration) {
  const double beta = closures::damping_ratio_kept(restitution), omega = pi / duration;
  return mass * omega * omega / (1 - beta * beta);
}

/// Shear rate of dry boxes, which is arbitrary.
constexpr double dry_shear_rate = 100;

/// A contact lasts `softness` times the time between collisions, sqrt(pi) d/(24 phi g0 sqrt(theta)).
void make_dry(core::Scene& box, const core::Scene& scene, const BoxPoint& point, const Scales& scales) {
  const double e = closures::effective_restitution(point.restitution, point.friction), phi = point.phi;
  const double g0 = closures::radial_distribution_dense(phi).value;
  const auto model = closures::KineticModel::garzo_dufty;
  const double theta = closures::shear_temperature(closures::kinetic_viscosity(model, phi, g0, e),
                                                   closures::kinetic_dissipation(model, phi, g0, e));
  const double speed = std::sqrt(theta) * dry_shear_rate * scales.mean.diameter;
  const double between = std::sqrt(pi) * scales.mean.diameter / (24 * phi * g0 * speed);
  const double duration = scene.calibrate.softness * between;
  box.column.shear_rate = dry_shear_rate;
  box.dem.start_speed = speed;
  box.dem.normal_stiffness = stiffness_of(scales.least_mass, point.restitution, duration);
  box.dem.fixed_step = duration / steps_per_contact;
  box.dem.greatest_speed = 10 * speed + dry_shear_rate * box.column.size[1];
}

/// Contacts stiff enough for small overlaps under the viscous stress; steps that resolve the thinnest film.
void make_wet(core::Scene& box, const core::Scene& scene, const BoxPoint& point, const Scales& scales) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const double d = scales.mean.diameter, mu = fluid.viscosity;
  const double rate = point.stokes * mu / (scales.mean.density * d * d);
  const double form = closures::viscous_stress_form(point.phi, closures::jamming_fraction(point.friction)).value;
  const double stiffness = mu * rate * d * (1 + form) * (1 + point.stokes) / wet_overlap;
  box.dem.normal_stiffness = stiffness;
  const double beta = closures::damping_ratio_kept(point.restitution);
  const double duration = pi * std::sqrt(scales.least_mass / stiffness) / std::sqrt(1 - beta * beta);
  double step = duration / steps_per_contact;
  box.fluid = scene.fluid;
  box.effects["drag"] = scene.drag().name;
  if (scene.partition().given) box.effects["partition"] = scene.partition().name;
  if (core::acts(scene, "lubrication")) {
    box.effects["lubrication"] = core::law_of(scene, "lubrication");
    box.material.roughness = std::max(scene.material.roughness, least_film * d);
    // A film acts as if it were thicker by 36 pi mu R*^2 dt/m* (dem/effects/lubrication.cpp), R* = d/4.
    step = std::min(step, box.material.roughness * scales.least_mass / (36 * pi * mu * d * d / 16));
  }
  box.column.shear_rate = rate;
  box.dem.start_speed = 0.3 * rate * d;
  box.dem.fixed_step = step;
  box.dem.greatest_speed = rate * (box.column.size[1] + 10 * d);
}

}  // namespace

core::Scene scene_of_box(const core::Scene& scene, const BoxPoint& point) {
  if (point.regime == core::BoxRegime::bed) return scene_of_bed(scene, point);
  core::Scene box;
  box.title = "a box of polybed calibrate";
  box.fluid.name = "none";
  box.species = species_of(scene, point);
  box.bed.particles = numbers_of(box.species, point.share, scene.calibrate.particles);
  double volume = 0;
  for (std::size_t j = 0; j < box.species.size(); ++j)
    volume += double(box.bed.particles[j]) * closures::sphere_volume(0.5 * box.species[j].diameter);
  const double length = std::cbrt(volume / point.phi);
  box.column.dimensions = 3;
  box.column.size = {length, length, length};
  box.column.given_size = {length, length, length};
  box.column.given_cells = {1, 1, 1};
  box.column.gravity = 0;
  box.column.sides = box.column.ends = core::Boundary::periodic;
  box.bed.start = {core::StartKind::random};
  box.bed.start_solids_fraction = point.phi;
  box.bed.seed = std::uint64_t(point.seed);
  box.effects = {{"contact", "linear"}};
  box.dem.tangential = point.friction > 0 ? core::Tangential::linear : core::Tangential::hdd;
  core::set_friction(box, point.friction);
  core::set_restitution(box, point.restitution);
  box.dem.tail = core::Tail::keep;
  box.dem.max_overlap = 0.2;
  Scales scales{{0, 0}, reduced_mass(box.species)};
  std::vector<double> share{1};
  if (point.binary) share = {1 - point.share, point.share};
  scales.mean = mean_sphere(box.species, share);
  if (point.regime == core::BoxRegime::dry)
    make_dry(box, scene, point, scales);
  else
    make_wet(box, scene, point, scales);
  double least = 1e300;
  for (const core::Species& s : box.species) least = std::min(least, s.diameter);
  box.dem.skin = (point.phi < 0.35 ? 0.25 : 0.1) * least;
  box.run.until = (scene.calibrate.discard_strain + scene.calibrate.strain) / box.column.shear_rate;
  return box;
}

double particle_steps_of(const core::Scene& scene, const BoxPoint& point) {
  const core::Scene box = scene_of_box(scene, point);
  double count = 0;
  for (const std::int64_t n : box.bed.particles) count += double(n);
  // The step of a fluidised box follows from its contacts: a rough estimate.
  return count * box.run.until / box.dem.fixed_step.value_or(1e-5);
}

}  // namespace polybed::multiscale
