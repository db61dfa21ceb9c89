#include "dem/coupling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/blocks.hpp"
#include "core/error.hpp"
#include "fluid/properties.hpp"
#include "fluid/vorticity.hpp"

namespace polybed::dem {

using core::Field;
using core::Index;

namespace {

/// Relative residual of the pressure: what it leaves of div J in a step of the fluid.
constexpr double pressure_tolerance = 1e-8;

std::vector<double> diameters(const Materials& materials) {
  std::vector<double> d;
  for (const Species& s : materials.species()) d.push_back(2 * s.radius);
  return d;
}

double width_of(const core::Scene& scene, const core::Grid& grid, const Materials& materials, std::int64_t count) {
  const std::string& kernel = scene.dem.kernel;
  if (kernel == "bilinear") return 0;
  if (scene.dem.kernel_width) return *scene.dem.kernel_width;
  constexpr double in_beds = 4;
  const double automatic =
      fluid::smoothing_width(grid.smallest_spacing(), materials.greatest_diameter(), std::size_t(count));
  return kernel == "auto" ? automatic : std::max(automatic, in_beds * materials.greatest_diameter());
}

}  // namespace

Coupling::Coupling(const core::Scene& scene, const Materials& materials, const core::Ranks* ranks, core::Timers& timers,
                   Units units, double dt, double speed, double volume, std::int64_t count)
    : ranks_(ranks),
      timers_(timers),
      flow_(scene, core::grid_of(scene.column, nullptr), pressure_tolerance),
      phase_(flow_.grid(), false),
      fraction_(materials.species().size(), core::make_field(flow_.grid())),
      width_(width_of(scene, flow_.grid(), materials, count)),
      smoothing_(flow_.grid(), width_, scene.column.closed),
      forces_(scene, materials, flow_.constants().density, flow_.constants().viscosity),
      sides_(scene, materials, flow_.constants().density, flow_.constants().viscosity, dt, scene.dem.fluid_every * dt),
      scatter_(flow_.grid(), materials, has_inertia(), volume, speed),
      gather_(flow_.grid(), diameters(materials)),
      motion_(materials, flow_.constants().density,
              {scene.column.gravity * scene.column.down[0], scene.column.gravity * scene.column.down[1],
               scene.column.gravity * scene.column.down[2]},
              units.force, units.energy),
      every_(scene.dem.fluid_every),
      held_(scene.dem.held),
      dt_(dt) {
  phase_ = fluid::ParticlePhase(flow_.grid(), has_inertia());
}

void Coupling::begin(const Particles& particles) {
  motion_.load.assign(particles.owned, FluidLoad{});
  take_fields();
  collect(particles);
  flow_.begin(0, phase_);
  take_fields();
  forces_.find(particles, gather_, motion_.load);
  sides_.begin(particles, gather_, motion_.load);
}

void Coupling::find_forces(const Particles& particles) {
  forces_.find(particles, gather_, motion_.load);
  sides_.find(particles, gather_, motion_.load);
}

void Coupling::hold(const Particles& particles) {
  for (std::size_t i = 0; i < particles.owned; ++i) {
    FluidLoad& f = motion_.load[i];
    for (std::size_t k = 0; k < 3; ++k) f.impulse[k] += f.drag * dt_ * f.velocity[k];
  }
  sides_.hold(motion_.load);
}

void Coupling::advance(Particles& particles, double t) {
  const double dt = every_ * dt_;
  {
    const auto scope = timers_.scope("fluid: particles' sums");
    collect(particles);
  }
  {
    const auto scope = timers_.scope("fluid");
    last_ = flow_.advance(t - dt, dt, phase_);
  }
  ++steps_;
  iterations_ += std::uint64_t(last_.iterations);
  const auto scope = timers_.scope("fluid: particles' answer");
  if (!held_) answer(particles);
  for (FluidLoad& load : motion_.load) load.impulse = {};
  take_fields();
  forces_.find(particles, gather_, motion_.load);
  sides_.refresh(particles, gather_, motion_.load);
}

void Coupling::collect(const Particles& particles) {
  scatter_.collect(particles, motion_.load, every_ * dt_, held_);
  scatter_.give(ranks_, !flow_.boundaries().closed(), phase_, fraction_);
  if (smoothing_.present()) smooth();
  double least = 1;
  core::for_each_row(flow_.grid(), [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) least = std::min(least, phase_.voidage[std::size_t(c)]);
  });
  if (!(least > fluid::voidage_floor))
    throw core::NumericsError(fmt::format(
        "a cell has a voidage of {:.3g}: its particles do not fit into it; use dem.kernel = \"diffusion\", or "
        "larger cells",
        least));
}

void Coupling::smooth() {
  std::fill(phase_.voidage.begin(), phase_.voidage.end(), 1.0);
  for (Field& phi : fraction_) {
    smoothing_.smooth_cells(phi);
    for (std::size_t c = 0; c < phi.size(); ++c) phase_.voidage[c] -= phi[c];
  }
  for (core::FaceField* field : {&phase_.voidage_on, &phase_.flux, &phase_.impulse, &phase_.drag, &phase_.follow,
                                 &phase_.slide, &phase_.yield, &phase_.carry, &phase_.carry_flux})
    for (int axis = 0; axis < flow_.grid().dimensions; ++axis)
      if (Field& component = (*field)[std::size_t(axis)]; !component.empty()) smoothing_.smooth_faces(component, axis);
}

/// The fields as particles see them.
void Coupling::take_fields() {
  if (!smoothing_.present()) {
    gather_.take(fraction_, flow_.state().velocity, flow_.gradient());
    if (sides_.needs_vorticity()) take_vorticity(flow_.state().velocity);
    return;
  }
  core::FaceField velocity = flow_.state().velocity, gradient = flow_.gradient();
  for (int axis = 0; axis < flow_.grid().dimensions; ++axis) {
    smoothing_.smooth_faces(velocity[std::size_t(axis)], axis);
    smoothing_.smooth_faces(gradient[std::size_t(axis)], axis);
  }
  gather_.take(fraction_, velocity, gradient);
  if (sides_.needs_vorticity()) take_vorticity(std::move(velocity));
}

/// Of the velocity as particles see it, which holds at the walls.
void Coupling::take_vorticity(core::FaceField velocity) {
  flow_.boundaries().fill_velocity(velocity, fluid::WallSlip::no_slip);
  std::array<Field, 3> vorticity;
  fluid::find_vorticity(flow_.grid(), velocity, vorticity);
  gather_.take_vorticity(vorticity);
}

/// What the change of the fluid would have done to the particles meanwhile: see fluid::ParticlePhase.
void Coupling::answer(Particles& particles) {
  const double dt = every_ * dt_;
  core::FaceField change = flow_.velocity_change(), push = flow_.gradient_change(), carried;
  if (phase_.added_mass()) carried = flow_.convected();
  for (int axis = 0; axis < flow_.grid().dimensions && smoothing_.present(); ++axis)
    for (core::FaceField* field : {&change, &push, &carried})
      if (!(*field)[0].empty()) smoothing_.smooth_faces((*field)[std::size_t(axis)], axis);
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const FluidLoad& f = motion_.load[i];
    Motion& m = particles.motion[i];
    const double r = particles.place[i].radius, volume = 4.0 / 3 * M_PI * r * r * r;
    const double inertia = 1 / m.inverse_mass + f.added, x = f.drag * dt / inertia, s = mean_decay(x);
    const Lines lines = gather_.lines(particles.place[i].x);
    const Vector du = gather_.vector(lines, change), dg = gather_.vector(lines, push);
    Vector dv;
    for (std::size_t k = 0; k < 3; ++k) dv[k] = x * s * du[k] - volume / inertia * s * dt * dg[k];
    if (phase_.added_mass()) {
      const Vector c = gather_.vector(lines, carried);
      for (std::size_t k = 0; k < 3; ++k) dv[k] += f.added / inertia * s * (du[k] + c[k]);
    }
    motion_.account_answer(m, dv);
    for (std::size_t k = 0; k < 3; ++k) m.v[k] += dv[k];
  }
}

double Coupling::pressure_drop() const {
  const core::Grid& grid = flow_.grid();
  const double dt = every_ * dt_, h = grid.spacing[1];
  const Field& p = flow_.state().pressure;
  double sum = 0;
  core::for_each_row(grid, {0, 0, 0}, {grid.cells[0], 1, grid.cells[2]}, [&](Index begin, Index end) {
    // The particles of the lower half of the lowest cells rest on the fluid at the distributor.
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
      sum += p[c] + h * phase_.impulse[1][c] / (dt * phase_.voidage[c]);
  });
  const double share = flow_.boundaries().closed() ? 1 : 0.5;  // p = 0 half a cell above an outlet
  core::for_each_row(grid, {0, grid.cells[1] - 1, 0}, {grid.cells[0], grid.cells[1], grid.cells[2]},
                     [&](Index begin, Index end) {
                       for (auto c = std::size_t(begin); c < std::size_t(end); ++c) sum -= share * p[c];
                     });
  return sum / (double(grid.cells[0]) * grid.cells[2]);
}

void Coupling::write(core::Checkpoint& checkpoint) const {
  for (std::size_t a = 0; a < std::size_t(flow_.grid().dimensions); ++a)
    checkpoint.arrays[fmt::format("fluid_velocity_{}", a)] = flow_.state().velocity[a];
  checkpoint.arrays["fluid_pressure"] = flow_.state().pressure;
  for (std::size_t j = 0; j < fraction_.size(); ++j)
    checkpoint.arrays[fmt::format("fluid_fraction_{}", j)] = fraction_[j];
  checkpoint.integers["fluid_steps"] = std::int64_t(steps_);
  checkpoint.integers["fluid_iterations"] = std::int64_t(iterations_);
}

void Coupling::read(const core::Checkpoint& checkpoint) {
  const auto take = [&](const std::string& name, Field& field) {
    core::on_first(ranks_, [&] {
      const auto found = checkpoint.arrays.find(name);
      if (found == checkpoint.arrays.end() || found->second.size() != field.size())
        throw core::FileError("the checkpoint is of a case without a fluid, or on another grid");
      field = found->second;
    });
    core::take_from_first(ranks_, field);
  };
  fluid::FluidState& fluid = flow_.state();
  for (std::size_t a = 0; a < std::size_t(flow_.grid().dimensions); ++a)
    take(fmt::format("fluid_velocity_{}", a), fluid.velocity[a]);
  take("fluid_pressure", fluid.pressure);
  for (std::size_t j = 0; j < fraction_.size(); ++j) take(fmt::format("fluid_fraction_{}", j), fraction_[j]);
  flow_.set_gradient();
  flow_.forget();
  take_fields();
  steps_ = std::uint64_t(checkpoint.integers.contains("fluid_steps") ? checkpoint.integers.at("fluid_steps") : 0);
}

}  // namespace polybed::dem
