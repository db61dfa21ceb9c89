// Fluidised boxes: the pressure of suspended particles, from their stress in slabs and from the balance of the forces
// above.
#include <algorithm>
#include <array>
#include <cmath>

#include "closures/bed_expansion.hpp"
#include "closures/drag.hpp"
#include "closures/sphere.hpp"
#include "core/case/scene.hpp"
#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "core/timers.hpp"
#include "dem/stress.hpp"
#include "multiscale/calibrate/box_result.hpp"
#include "multiscale/calibrate/slab.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

/// Width of the box and of its cells, in diameters; height of the column over the bed's.
constexpr double width = 8, cell = 2, headroom = 1.6;
/// Times in which the stream crosses the bed: before the average, and during it.
constexpr double settle = 2, average = 8;
/// Deviation of a slab's Gaussian, in diameters.
constexpr double slab = 1.5;
/// Measured part of the bed's height: away from the distributor and from the surface.
constexpr double low_part = 0.3, high_part = 0.7;
/// Solids fraction up to which a narrow column is easily filled with random spheres.
constexpr double most_at_start = 0.4;
constexpr int heights = 9, blocks_of_a_bed = 20;

/// Superficial velocity at which drag balances the buoyant weight at a voidage.
double carrying_velocity(const core::Scene& scene, const MeanSphere& mean, double voidage) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  if (!scene.drag().acts()) throw core::CaseError("calibrate.regime = \"bed\" needs a drag law: [effects] drag = ...");
  const closures::DragLaw law = relevance::drag_law_named(scene.drag().name);
  return closures::carrying_velocity(
      [&](double eps, double reynolds) { return closures::pure_drag_at(law, eps, reynolds); },
      {mean.diameter, std::abs(mean.density - fluid.density), fluid.density, fluid.viscosity, scene.column.gravity},
      voidage);
}

/// Measured values of a bed, at one of the heights or summed over them.
struct Slabs {
  double phi = 0, stress = 0, balance = 0;
  double number = 0, square = 0;  ///< particles there: their number, and their squared velocities relative to the bed's

  [[nodiscard]] std::array<double, 5> all() const { return {phi, stress, balance, number, square}; }
};

class BedRun {
 public:
  BedRun(const core::Scene& scene, const BoxPoint& point, std::shared_ptr<const core::Ranks> ranks)
      : box_(scene_of_bed(scene, point)), ranks_(std::move(ranks)), model_(box_, timers_, ranks_) {
    result_.point = point;
    result_.hash = box_hash(scene, point);
    const dem::Species& s = model_.materials().species()[0];
    result_.diameter = 2 * s.radius;
    result_.density = s.density;
    const double rho = relevance::fluid_constants(box_.fluid).density;
    unit_ = std::abs(s.density - rho) * box_.column.gravity * result_.diameter;
    area_ = box_.column.cross_section();
    height_ = double(box_.bed.particles[0]) * closures::sphere_volume(s.radius) / (area_ * point.phi);
  }

  BoxResult run() {
    const double begin = core::cpu_seconds();
    const double transit = height_ / box_.inlet.superficial_velocity[0].second;
    for (double until = settle * transit; model_.time() < until;) model_.step(1e300);
    std::vector<double> phi, stress, balance, theta;
    // Drag is integrated between the fluid's steps: samples at all phases of a step give its mean.
    const int every = model_.coupling()->every() + 1;
    for (int b = 1; b <= blocks_of_a_bed; ++b) {
      Slabs sum;
      std::int64_t looks = 0;
      for (double until = (settle + average * b / blocks_of_a_bed) * transit; model_.time() < until; ++looks) {
        for (int k = 0; k < every; ++k) model_.step(1e300);
        look(sum);
      }
      std::array<double, 5> all = sum.all();
      core::add_over_ranks(ranks_.get(), all);
      phi.push_back(all[0] / double(looks));
      stress.push_back(all[1] / double(looks) / unit_);
      balance.push_back(all[2] / double(looks) / unit_);
      theta.push_back(all[4] / (3 * std::max(all[3], 1.0)));
    }
    result_.theta = estimate_of(theta);
    result_.velocity = box_.inlet.superficial_velocity[0].second;
    result_.bed_phi = estimate_of(phi).mean;
    result_.bed_pressure = estimate_of(stress);
    result_.bed_balance = estimate_of(balance);
    result_.balance = result_.bed_balance.mean / result_.bed_pressure.mean;
    std::array<double, 1> cpu{core::cpu_seconds() - begin};
    core::add_over_ranks(ranks_.get(), cpu);
    result_.cpu_seconds = cpu[0];
    result_.particle_steps = double(model_.work().particle_steps);
    return result_;
  }

 private:
  [[nodiscard]] double place(int k) const { return height_ * (low_part + (high_part - low_part) * k / (heights - 1)); }
  [[nodiscard]] Slab slab_at(int k, double floor) const { return {place(k), slab * result_.diameter, floor}; }

  void look(Slabs& sum) {
    const dem::Particles& p = model_.particles();
    const double volume = closures::sphere_volume(0.5 * result_.diameter);
    const dem::FluidMotion& fluid = model_.coupling()->motion();
    const double per = 1 / (heights * area_), radius = 0.5 * result_.diameter;
    for (std::size_t i = 0; i < p.owned; ++i) {
      const double y = p.place[i].x[1], v = p.motion[i].v[1], mass = 1 / p.motion[i].inverse_mass;
      const dem::FluidLoad& load = fluid.load[i];
      const double force =
          load.drag * (load.velocity[1] - v) + load.force[1] + mass * fluid.net_gravity(p.species[i])[1];
      if (y > low_part * height_ && y < high_part * height_) {
        const dem::Vector& u = p.motion[i].v;
        sum.number += 1;
        sum.square += u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
      }
      for (int k = 0; k < heights; ++k) {
        const Slab solids = slab_at(k, 0), passing = slab_at(k, radius);
        sum.phi += volume * solids.weight(y) * per;
        sum.stress += mass * v * v * passing.weight(y) * per;
        sum.balance -= force * passing.below(y) * per;  // particles above press on it
      }
    }
    for (const dem::ContactForce& c : dem::contact_forces(model_)) {
      const double y = p.place[c.first].x[1] - 0.5 * c.length * c.normal[1];
      const double virial = c.length * c.normal[1] * c.force[1] * per;
      for (int k = 0; k < heights; ++k) sum.stress += virial * slab_at(k, radius).weight(y);
    }
  }

  core::Scene box_;
  core::Timers timers_;
  std::shared_ptr<const core::Ranks> ranks_;
  dem::Model model_;
  BoxResult result_;
  double unit_ = 0, area_ = 0, height_ = 0;
};

}  // namespace

core::Scene scene_of_bed(const core::Scene& scene, const BoxPoint& point) {
  const MeanSphere mean = mean_sphere(scene.species, scene.bed.volume_share);
  const double d = mean.diameter, number = scene.calibrate.particles;
  core::Scene box;
  box.title = "a fluidised box of polybed calibrate";
  box.fluid = scene.fluid;
  box.species.resize(1);
  box.species[0].name = "mean";
  box.species[0].diameter = d;
  box.species[0].density = mean.density;
  box.bed.particles = {scene.calibrate.particles};
  const double height = number * closures::sphere_volume(0.5 * d) / (width * width * d * d * point.phi);
  const int cells = int(std::ceil(headroom * height / (cell * d))), across = int(width / cell);
  box.column.dimensions = 3;
  box.column.size = {width * d, cells * cell * d, width * d};
  box.column.given_size = {width * d, width * d, cells * cell * d};
  box.column.cells = {across, cells, across};
  box.column.given_cells = {across, across, cells};
  box.column.gravity = scene.column.gravity;
  box.column.sides = core::Boundary::periodic;
  box.bed.start = {core::StartKind::mixed};
  box.bed.solids_fraction = 0.6;
  box.bed.start_solids_fraction = std::min(point.phi, most_at_start);
  box.bed.static_height = height * point.phi / box.bed.solids_fraction;
  box.bed.volume_share = {1};
  box.bed.seed = std::uint64_t(point.seed);
  const double velocity = carrying_velocity(scene, mean, 1 - point.phi);
  box.inlet.superficial_velocity = {{0, velocity}};
  for (const char* role : {"drag", "partition", "lubrication", "added_mass"})
    if (core::acts(scene, role)) box.effects[role] = core::law_of(scene, role);
  box.effects["contact"] = "hertz_mindlin";
  box.dem = scene.dem;
  box.material = scene.material;
  core::set_friction(box, point.friction);
  core::set_restitution(box, point.restitution);
  box.dem.skin = std::nullopt;
  box.dem.kernel = core::Kernel::bilinear;
  box.dem.kernel_width = std::nullopt;
  box.dem.greatest_speed = scene.dem.greatest_speed.value_or(4 * velocity / (1 - point.phi));
  box.dem.ledger = false;
  box.run.until = (settle + average) * height / velocity;
  return box;
}

BoxResult run_bed_box(const core::Scene& scene, const BoxPoint& point, std::shared_ptr<const core::Ranks> ranks) {
  return BedRun(scene, point, std::move(ranks)).run();
}

}  // namespace polybed::multiscale
