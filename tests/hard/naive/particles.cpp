#include "hard/naive/particles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/numerics/blocks.hpp"

namespace polybed::hard::naive {

namespace {

double volume_of(double radius) { return 4.0 / 3 * std::numbers::pi * radius * radius * radius; }

double volume_of(const dem::Particles& particles) {
  double sum = 0;
  for (const dem::Place& p : particles.place) sum += volume_of(p.radius);
  return sum;
}

std::vector<double> diameters(const dem::Materials& materials) {
  std::vector<double> d;
  for (const dem::Species& s : materials.species()) d.push_back(2 * s.radius);
  return d;
}

dem::Vector gravity_of(const core::Column& column) {
  return {column.gravity * column.down[0], column.gravity * column.down[1], column.gravity * column.down[2]};
}

}  // namespace

ParticleRun::ParticleRun(const std::string& name, const core::Scene& scene, dem::Particles particles, double dt)
    : treatment_(treatment_of(name)),
      scene_(scene),
      materials_(scene),
      particles_(std::move(particles)),
      dt_(dt),
      every_(scene.dem.fluid_every.value_or(core::most_fluid_every)),
      flow_(scene, core::grid_of(scene.column, nullptr), 1e-8),
      forces_(scene, materials_, flow_.constants().density, flow_.constants().viscosity),
      phase_(flow_.grid(), forces_.has_added_mass() && treatment_ != Treatment::added_mass_lagged),
      fraction_(materials_.species().size(), core::make_field(flow_.grid())),
      smoothing_(flow_.grid(), scene.dem.kernel_width.value_or(0), scene.column.closed),
      scatter_(flow_.grid(), flow_.grid(), materials_, phase_.added_mass(), volume_of(particles_),
               *scene.dem.greatest_speed),
      gather_(flow_.grid(), diameters(materials_)),
      motion_(materials_, (treatment_ == Treatment::double_buoyancy ? 2 : 1) * flow_.constants().density,
              gravity_of(scene.column), {}, {}),
      last_(particles_.owned) {
  motion_.load.resize(particles_.owned);
  take_fields();
  collect();
  flow_.begin(0, phase_);
  take_fields();
}

ParticleRun::Treatment ParticleRun::treatment_of(const std::string& name) {
  if (name == "nothing") return Treatment::nothing;
  if (name == "drag_explicit") return Treatment::drag_explicit;
  if (name == "added_mass_lagged") return Treatment::added_mass_lagged;
  if (name == "pcm_void") return Treatment::pcm_void;
  if (name == "double_buoyancy") return Treatment::double_buoyancy;
  if (name == "last_substep") return Treatment::last_substep;
  throw std::invalid_argument("no textbook treatment of particles called " + name);
}

void ParticleRun::step() {
  for (int n = 0; n < every_; ++n) move();
  if (treatment_ == Treatment::last_substep)
    for (std::size_t i = 0; i < particles_.owned; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        motion_.load[i].impulse[k] = every_ * (motion_.load[i].impulse[k] - last_[i][k]);
  correct();
  collect();
  flow_.advance(time_, every_ * dt_, phase_);
  time_ += every_ * dt_;
  couple_two_way();
  for (dem::FluidLoad& load : motion_.load) load.impulse = {};
  take_fields();
}

/// Half a step of the velocity.
void ParticleRun::kick(std::size_t i) {
  const double h = 0.5 * dt_, mass = 1 / particles_.motion[i].inverse_mass;
  dem::Motion& m = particles_.motion[i];
  dem::FluidLoad& f = motion_.load[i];
  const double added = f.added;
  if (treatment_ == Treatment::added_mass_lagged) {
    for (std::size_t k = 0; k < 3; ++k) f.force[k] -= added * last_[i][k];
    f.added = 0;
  }
  const double inertia = mass + f.added, x = f.drag * h / inertia, mean = dem::mean_decay(x);
  dem::Vector dv;
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = mass * motion_.net_gravity(particles_.species[i])[k], slip = f.velocity[k] - m.v[k];
    const double free = h * (f.force[k] + weight) / inertia;
    dv[k] = treatment_ == Treatment::drag_explicit ? free + h * f.drag / mass * slip : mean * (free + x * slip);
    f.impulse[k] += inertia * (dv[k] - free) - f.added * dv[k];
    m.v[k] += dv[k];
  }
  if (treatment_ != Treatment::added_mass_lagged) return;
  for (std::size_t k = 0; k < 3; ++k) {
    f.force[k] += added * last_[i][k];
    last_[i][k] = dv[k] / h;
  }
  f.added = added;
}

void ParticleRun::move() {
  const core::Grid& grid = flow_.grid();
  for (std::size_t i = 0; i < particles_.owned; ++i) {
    if (treatment_ == Treatment::last_substep) last_[i] = motion_.load[i].impulse;
    kick(i);
    for (std::size_t k = 0; k < 3; ++k) {
      double& x = particles_.place[i].x[k];
      x += particles_.motion[i].v[k] * dt_;
      const double length = scene_.column.size[k];
      if (grid.periodic[k]) x -= std::floor(x / length) * length;
    }
  }
  for (std::size_t i = 0; i < particles_.owned; ++i) kick(i);
}

/// As dem::Coupling::correct.
void ParticleRun::correct() {
  const std::vector<dem::FluidLoad> before = motion_.load;
  forces_.find(particles_, gather_, motion_.load);
  for (std::size_t i = 0; i < particles_.owned; ++i) {
    dem::Motion& m = particles_.motion[i];
    const dem::LoadChange change = dem::change_of(before[i], motion_.load[i], m, every_ * dt_);
    motion_.load[i].impulse = before[i].impulse;
    for (std::size_t k = 0; k < 3; ++k) {
      motion_.load[i].impulse[k] += change.impulse[k];
      m.v[k] += change.dv[k];
    }
  }
}

void ParticleRun::collect() {
  scatter_.collect(particles_, motion_.load, every_ * dt_);
  scatter_.give(nullptr, nullptr, !flow_.boundaries().closed(), phase_, fraction_);
  if (treatment_ == Treatment::pcm_void) crowd_centres();
  if (!smoothing_.present()) return;
  std::fill(phase_.voidage.begin(), phase_.voidage.end(), 1.0);
  for (core::Field& phi : fraction_) {
    smoothing_.smooth_cells(phi);
    for (std::size_t c = 0; c < phi.size(); ++c) phase_.voidage[c] -= phi[c];
  }
  for (core::FaceField* field : {&phase_.voidage_on, &phase_.flux, &phase_.impulse, &phase_.drag, &phase_.follow,
                                 &phase_.slide, &phase_.yield, &phase_.carry, &phase_.carry_flux})
    for (int axis = 0; axis < flow_.grid().dimensions; ++axis)
      if (core::Field& component = (*field)[std::size_t(axis)]; !component.empty())
        smoothing_.smooth_faces(component, axis);
}

/// All of a particle's volume in the cell of its centre; faces have the mean of their cells.
void ParticleRun::crowd_centres() {
  const core::Grid& grid = flow_.grid();
  for (core::Field& phi : fraction_) std::fill(phi.begin(), phi.end(), 0.0);
  std::fill(phase_.voidage.begin(), phase_.voidage.end(), 1.0);
  for (std::size_t i = 0; i < particles_.owned; ++i) {
    std::array<int, 3> at{};
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = std::clamp(int(particles_.place[i].x[k] / grid.spacing[k]), 0, grid.cells[k] - 1);
    const auto c = std::size_t(grid.index(at[0], at[1], at[2]));
    const double share = volume_of(particles_.place[i].radius) / grid.cell_volume();
    fraction_[std::size_t(particles_.species[i])][c] += share;
    phase_.voidage[c] -= share;
  }
  core::Field eps = phase_.voidage;
  flow_.boundaries().fill_cells(eps);
  for (int axis = 0; axis < grid.dimensions; ++axis)
    core::for_each_row(grid, flow_.boundaries().moving_faces(axis, true), [&](core::Index begin, core::Index end) {
      for (core::Index f = begin; f < end; ++f)
        phase_.voidage_on[std::size_t(axis)][std::size_t(f)] =
            0.5 * (eps[std::size_t(f)] + eps[std::size_t(f - grid.stride(axis))]);
    });
}

/// As dem::Coupling::couple_two_way, without a kernel's gathering.
void ParticleRun::couple_two_way() {
  const double dt = every_ * dt_;
  for (std::size_t i = 0; i < particles_.owned; ++i) {
    const dem::FluidLoad& f = motion_.load[i];
    dem::Motion& m = particles_.motion[i];
    const double added = phase_.added_mass() ? f.added : 0, inertia = 1 / m.inverse_mass + added;
    const double x = f.drag * dt / inertia, s = dem::mean_decay(x);
    const dem::Lines lines = gather_.lines(particles_.place[i].x);
    const dem::Vector du = gather_.vector(lines, flow_.velocity_change()),
                      dg = gather_.vector(lines, flow_.gradient_change()),
                      carried = gather_.vector(lines, flow_.convected());
    const double pushed = volume_of(particles_.place[i].radius) / inertia * s * dt;
    for (std::size_t k = 0; k < 3; ++k)
      m.v[k] += x * s * du[k] - pushed * dg[k] + added / inertia * s * (du[k] + carried[k]);
  }
}

void ParticleRun::take_fields() {
  gather_.take(fraction_, flow_.state().velocity, flow_.gradient());
  forces_.find(particles_, gather_, motion_.load);
}

dem::Particles particles_of(const core::Scene& scene, const std::vector<scenes::Bead>& beads) {
  const dem::Materials materials(scene);
  const dem::Species& s = materials.species()[0];
  dem::Particles particles;
  for (const scenes::Bead& b : beads)
    particles.add({{b.x, s.radius}, {b.v, 1 / s.mass, b.w, 1 / s.inertia}, {}, std::int64_t(particles.size()), 0});
  particles.owned = particles.size();
  return particles;
}

}  // namespace polybed::hard::naive
