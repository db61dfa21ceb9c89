#include "relevance/situation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "closures/bed_expansion.hpp"
#include "closures/drag_schiller_naumann.hpp"
#include "closures/mixture.hpp"
#include "closures/relevance.hpp"
#include "closures/terminal_velocity.hpp"
#include "core/case/particle_list.hpp"
#include "core/case/scene.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::relevance {

namespace {

constexpr int points = 33;  ///< of a range

/// Volumes of the species in the scene, m3.
std::vector<double> solids_volumes(const core::Scene& scene) {
  const core::Bed& bed = scene.bed;
  std::vector<double> volume(scene.species.size(), 0.0);
  const auto one = [&](std::size_t j) { return closures::sphere_volume(0.5 * scene.species[j].diameter); };
  const double whole = scene.column.even_height(bed.static_height) * bed.solids_fraction * scene.column.cross_section();
  if (bed.start.kind == core::StartKind::list)
    for (const std::int32_t j : core::read_particle_list(scene).species) volume[std::size_t(j)] += one(std::size_t(j));
  else
    for (std::size_t j = 0; j < volume.size(); ++j)
      volume[j] = bed.particles.empty() ? whole * bed.volume_share[j] : double(bed.particles[j]) * one(j);
  return volume;
}

/// Measures the bed at its start: solids fraction and height.
void measure_bed(const core::Scene& scene, Survey& s) {
  const auto& size = scene.column.size;
  const double across = scene.column.around_axis() ? 2 * size[0] : size[0];
  s.width = scene.column.dimensions == 3 ? std::min(across, size[2]) : across;
  s.column_height = size[1];
  const std::vector<double> volume = solids_volumes(scene);
  const double all = std::accumulate(volume.begin(), volume.end(), 0.0);
  const double even_height = scene.column.even_height(s.column_height);
  s.mean_fraction = std::min(all / (scene.column.cross_section() * even_height), 1.0);
  s.solids_fraction = scene.bed.start_solids_fraction;
  const bool spread = scene.bed.start.kind == core::StartKind::list || scene.bed.start.kind == core::StartKind::random;
  if (spread || !(s.solids_fraction > 0)) s.solids_fraction = std::max(s.mean_fraction, 1e-9);
  s.height = scene.column.filled_height(s.mean_fraction * even_height / s.solids_fraction);
  for (const double v : volume) s.share.push_back(all > 0 ? v / all : 1.0 / double(volume.size()));
}

/// Finds the scales that a run can reach, besides those used for weighing.
void find_scales_of_run(const core::Scene& scene, double fluid_density, Survey& s) {
  for (std::size_t a = 0; a < std::size_t(scene.column.dimensions); ++a) {
    if (scene.column.cells[a] <= 1) continue;
    const double spacing = scene.column.cell(a);
    s.cell = s.cell > 0 ? std::min(s.cell, spacing) : spacing;
  }
  const double packed = std::max(s.solids_fraction, scene.bed.solids_fraction);
  for (const core::Species& species : scene.species)
    s.clump_acceleration =
        std::max(s.clump_acceleration,
                 closures::clump_acceleration(packed, species.density, fluid_density, scene.column.gravity));
  s.greatest_packed_slip = s.greatest_velocity / (1 - packed);
}

void find_velocities(const core::Scene& scene, Survey& s) {
  std::vector<double> all;
  for (const auto& [t, v] : scene.inlet.superficial_velocity) all.push_back(std::abs(v));
  for (const core::Jet& jet : scene.jets)
    for (const auto& [t, v] : jet.superficial_velocity) all.push_back(std::abs(v));
  for (const double v : scene.chooser.velocity_range) all.push_back(std::abs(v));
  if (all.empty()) all.push_back(0);
  s.least_velocity = *std::min_element(all.begin(), all.end());
  s.greatest_velocity = *std::max_element(all.begin(), all.end());
}

/// The fluid at the temperatures in the scene; the case's own comes first.
std::vector<core::Fluid> fluids_of(const core::Scene& scene) {
  std::vector<core::Fluid> fluids{scene.fluid};
  for (const double t : scene.chooser.temperature_range) {
    core::Fluid fluid = scene.fluid;
    fluid.temperature = t;
    fluids.push_back(fluid);
  }
  return fluids;
}

/// All situations of a bed in one fluid.
class BedInFluid {
 public:
  BedInFluid(const core::Scene& scene, const core::Fluid& fluid, const closures::DragLaw& law, Survey& survey)
      : scene_(scene), law_(law), survey_(survey), fluid_(fluid_constants(fluid)) {
    temperature_ = fluid.temperature.value_or(0);
    for (const core::Species& species : scene.species) diameter_.push_back(species.diameter);
    double density = 0;
    for (std::size_t j = 0; j < scene.species.size(); ++j) density += survey.share[j] * scene.species[j].density;
    bed_ = {closures::sauter_diameter(survey.share, diameter_), std::abs(density - fluid_.density), fluid_.density,
            fluid_.viscosity, scene.column.gravity};
  }

  void add_velocity(double velocity) {
    const double packed = 1 - std::max(survey_.solids_fraction, scene_.bed.solids_fraction);
    const auto f = [&](double eps, double re) { return closures::pure_drag_at(law_, eps, re); };
    // The flow in a packed bed is limited by the velocity that carries it; above, the bed expands.
    const double lifts = bed_.excess * bed_.gravity > 0 ? closures::carrying_velocity(f, bed_, packed) : velocity;
    if (velocity > 0) add(Zone::packed, std::min(velocity, lifts), packed);
    if (const auto known = scene_.chooser.voidage) {
      add_bulk(velocity, *known);
    } else if (velocity > 0) {
      const double eps = closures::carried_voidage(f, bed_, velocity, packed);
      if (eps < 1) add_bulk(velocity, eps);
    }
    if (!scene_.flows_around()) add_freeboard(velocity);
  }

  /// Particles that sink through the fluid while no bed is packed.
  void add_settling() {
    const double eps = 1 - survey_.solids_fraction;
    if (!(eps > 1 - scene_.bed.solids_fraction) && scene_.bed.solids_fraction > 0) return;
    const auto f = [&](double e, double re) { return closures::pure_drag_at(law_, e, re); };
    add_bulk(closures::carrying_velocity(f, bed_, eps), eps);
  }

 private:
  [[nodiscard]] Situation particle(std::size_t j) const {
    Situation s;
    s.species = scene_.species[j].name;
    s.diameter = diameter_[j];
    s.density = scene_.species[j].density;
    s.fluid_density = fluid_.density;
    s.viscosity = fluid_.viscosity;
    s.temperature = temperature_;
    s.width = survey_.width;
    s.gravity = scene_.column.gravity;
    return s;
  }

  void add(Zone zone, double velocity, double voidage) {
    if (!(velocity > 0)) return;
    std::vector<double> slip(diameter_.size(), velocity), f(diameter_.size()), slope(diameter_.size());
    closures::drag_of_mixture(law_, voidage, survey_.share, diameter_, slip, fluid_.density, fluid_.viscosity, f,
                              slope);
    for (std::size_t j = 0; j < diameter_.size(); ++j) {
      Situation s = in_zone(particle(j), zone, velocity, voidage, law_);
      if (f[j] > 0) s.f = f[j];
      survey_.situations.push_back(s);
    }
    if (zone == Zone::bulk) note_mixture(velocity, voidage, f);
  }

  void add_bulk(double velocity, double voidage) {
    add(Zone::bulk, velocity, voidage);
    if (scene_.column.sides == core::Boundary::wall) add(Zone::wall, velocity, voidage);
  }

  /// One particle above the bed: carried upward, or falling back.
  void add_freeboard(double velocity) {
    for (std::size_t j = 0; j < diameter_.size(); ++j) {
      const Situation p = particle(j);
      const closures::ShapeFactor shape = shape_of(scene_, scene_.species[j]);
      const double terminal = closures::settling_velocity(p.diameter, p.density - p.fluid_density, p.fluid_density,
                                                          p.viscosity, scene_.column.gravity, shape);
      if (const double w = std::max(velocity, terminal); w > 0) {
        survey_.situations.push_back(in_zone(p, Zone::freeboard, w, 1, law_));
        survey_.situations.back().f *= shape(1, survey_.situations.back().reynolds());
      }
    }
  }

  /// Records how different the species are where the bed is fluidised.
  void note_mixture(double velocity, double voidage, const std::vector<double>& f) {
    const double sauter = closures::sauter_diameter(survey_.share, diameter_);
    const double mean = closures::drag_of_mean(law_, voidage, fluid_.density * velocity * sauter / fluid_.viscosity,
                                               survey_.share, diameter_, f);
    double least = 1e300, most = 0;
    for (std::size_t j = 0; j < diameter_.size(); ++j) {
      survey_.mixture_part = std::max(survey_.mixture_part, std::abs(f[j] / mean - 1));
      const auto base = [law = law_.alone(j)](double eps, double re) { return closures::pure_drag_at(law, eps, re); };
      closures::CarriedBed alone = bed_;
      alone.diameter = diameter_[j];
      alone.excess = std::abs(scene_.species[j].density - fluid_.density);
      const double slip = closures::carrying_velocity(base, alone, voidage) / voidage;
      least = std::min(least, slip);
      most = std::max(most, slip);
    }
    if (most - least > survey_.greatest_slip_difference) {
      survey_.greatest_slip_difference = most - least;
      survey_.voidage_of_difference = voidage;
    }
  }

  const core::Scene& scene_;
  const closures::DragLaw& law_;
  Survey& survey_;
  FluidConstants fluid_;
  double temperature_ = 0;
  std::vector<double> diameter_;
  closures::CarriedBed bed_{};
};

/// Species at rest on each other, without a fluid.
std::vector<Situation> dry_bed(const core::Scene& scene) {
  std::vector<Situation> bed;
  for (const core::Species& species : scene.species) {
    Situation s;
    s.zone = Zone::packed;
    s.species = species.name;
    s.diameter = species.diameter;
    s.density = species.density;
    s.gravity = scene.column.gravity;
    bed.push_back(s);
  }
  return bed;
}

}  // namespace

double Situation::relaxation_time() const {
  return closures::slip_relaxation_time(diameter, density, viscosity, voidage, f);
}

double Situation::reference() const {
  const double weight = closures::buoyant_weight(diameter, density, fluid_density, gravity);
  return weight > 0 ? weight : closures::drag_per_slip(diameter, viscosity, voidage, f) * slip;
}

double Situation::time() const { return closures::time_of_scene(width, slip, relaxation_time()); }

double Situation::exchange() const { return 18 * viscosity * voidage * (1 - voidage) * f / (diameter * diameter); }

std::string name_of(Zone zone) {
  constexpr std::array names{"packed", "bulk", "wall", "freeboard"};
  return names.at(std::size_t(zone));
}

Situation in_zone(Situation s, Zone zone, double velocity, double voidage, const closures::DragLaw& law) {
  const bool alone = zone == Zone::freeboard, at_wall = alone || zone == Zone::wall;
  s.zone = zone;
  s.velocity = velocity;
  s.voidage = voidage;
  s.slip = velocity / voidage;
  s.f = alone ? closures::DragSchillerNaumann{}(1, s.reynolds()).f : closures::pure_drag_at(law, voidage, s.reynolds());
  s.shear = at_wall ? closures::shear_rate_at_wall(s.slip, s.width, s.diameter)
                    : closures::shear_rate_inside(s.slip, s.diameter);
  return s;
}

Survey survey(const core::Scene& scene) {
  Survey s;
  measure_bed(scene, s);
  find_velocities(scene, s);
  s.has_fluid = scene.fluid.present();
  if (!s.has_fluid) {
    if (scene.column.gravity > 0) s.dry = dry_bed(scene);
    return s;
  }
  const FluidConstants fluid = fluid_constants(scene.fluid);
  s.fluid_density = fluid.density;
  s.viscosity = fluid.viscosity;
  s.temperature = scene.fluid.temperature.value_or(0);
  find_scales_of_run(scene, fluid.density, s);
  s.is_gas = scene.fluid.substance() == core::Substance::air ||
             scene.fluid.equation_of_state == core::Compressibility::ideal_gas || fluid.density < lightest_liquid;
  s.drag_scene = drag_scene_of(scene, s);
  s.drag = drag_taken(scene, s);
  const closures::DragLaw law = with_shape(drag_law_named(s.drag.law, s.drag.partition), scene);
  for (const core::Fluid& state : fluids_of(scene)) {
    BedInFluid bed(scene, state, law, s);
    const bool one = s.least_velocity == s.greatest_velocity;
    for (int n = 0; n < (one ? 1 : points); ++n)
      bed.add_velocity(s.least_velocity + (s.greatest_velocity - s.least_velocity) * n / (points - 1));
    bed.add_settling();
  }
  s.situations = only_zones(s.situations, scene.chooser.zones);
  return s;
}

std::vector<Situation> only_zones(const std::vector<Situation>& all, const std::vector<std::string>& zones) {
  std::vector<Situation> chosen;
  for (const Situation& s : all)
    if (zones.empty() || std::find(zones.begin(), zones.end(), name_of(s.zone)) != zones.end()) chosen.push_back(s);
  return chosen;
}

}  // namespace polybed::relevance
