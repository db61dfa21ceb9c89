#include "fluid/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/case/scene.hpp"
#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/convection.hpp"
#include "fluid/density.hpp"
#include "fluid/fluid_mass.hpp"
#include "fluid/viscous_stress.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::fluid {

using core::Field;
using core::Index;

namespace {

void clear(core::FaceField& faces) {
  for (Field& f : faces) std::fill(f.begin(), f.end(), 0.0);
}

/// Of the solids in the bed; without a bed, of the species alike.
double mean_density(const core::Scene& scene) {
  double sum = 0, shares = 0;
  for (std::size_t j = 0; j < scene.species.size(); ++j) {
    const double share = j < scene.bed.volume_share.size() ? scene.bed.volume_share[j] : 1;
    sum += share * scene.species[j].density;
    shares += share;
  }
  return shares > 0 ? sum / shares : 0;
}

}  // namespace

Flow::Flow(const core::Scene& scene, const core::Grid& grid, double tolerance)
    : grid_(grid),
      boundaries_(grid, ends_of(scene), false, crossed_sides(scene), open_faces(grid, scene)),
      inlet_(grid, scene),
      constants_(relevance::fluid_constants(scene.fluid)),
      gravity_(scene.column.gravity),
      solids_density_(mean_density(scene)),
      tolerance_(tolerance),
      viscous_(core::acts(scene, "fluid_stress")),
      has_open_sides_(fluid::has_open_sides(scene)),
      driven_(std::any_of(scene.discharges.begin(), scene.discharges.end(),
                          [](const core::Discharge& d) { return d.pressure.value_or(0) != 0; })),
      held_(scene.bed.held),
      limited_(scene.scheme.momentum != core::Momentum::conservative),
      solver_(grid),
      fluid_(grid),
      convected_(core::make_face_field(grid)),
      acceleration_(core::make_face_field(grid)),
      velocity_change_(core::make_face_field(grid)),
      gradient_(core::make_face_field(grid)),
      gradient_change_(core::make_face_field(grid)),
      per_inertia_(core::make_face_field(grid)),
      mobility_(core::make_face_field(grid)),
      own_flux_(core::make_face_field(grid)),
      source_(core::make_field(grid)),
      change_(core::make_field(grid)),
      per_square_(viscous_rate(grid)) {
  if (grid.metric) open_mobility_ = core::make_face_field(grid);
  if (!scene.fluid.compressible()) return;
  compressible_.emplace(grid, boundaries_, equation_of_state(scene.fluid, constants_.density),
                        scene.fluid.outlet_pressure, constants_.density, gravity_);
  compressible_->make_fields(fluid_);
  shift_ = core::make_field(grid);
}

void Flow::begin(double t, const ParticlePhase& particles) {
  set_voidage(particles);
  set_inlet(t);
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    core::for_each_row(grid_, boundaries_.moving_faces(axis, true), [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        const double eps = particles.voidage_on[a][c];
        fluid_.flux[a][c] = eps * fluid_.velocity[a][c] + particles.flux[a][c];
        mobility_[a][c] = eps / constants_.density;
        per_inertia_[a][c] = 1 / constants_.density;
      }
    });
  }
  for_each_open_face([&](const OpenFace& f, std::size_t a, std::size_t at) {
    fluid_.flux[a][at] = fluid_.velocity[a][at];
    mobility_[a][at] = per_inertia_[a][at] = f.mobility(constants_.density);
  });
  clear(velocity_change_);
  hold();
  clear(own_flux_);          // an impulse transports nothing
  constexpr double any = 1;  // s: it has no duration
  FlowStep step;
  close_pressure(t, any, step);
  correct(any);
  std::fill(fluid_.pressure.begin(), fluid_.pressure.end(), 0.0);
  if (driven_) begin_pressure(t);
  set_gradient();
  clear(gradient_change_);
  clear(velocity_change_);
}

FlowStep Flow::advance(double t, double dt, const ParticlePhase& particles) {
  FlowStep step;
  set_voidage(particles);
  set_inlet(t + dt);
  find_acceleration(dt, particles);
  with_density(fluid_, constants_.density, [&](const auto& density) { push(density, dt, particles); });
  hold();
  close_pressure(t, dt, step);
  correct(dt);
  if (compressible_) finish_compression(dt, step);
  step.courant = courant(dt);
  if (!(step.courant <= 1)) {
    const bool viscous = step.courant <= viscous_courant(dt);
    throw core::NumericsError(
        fmt::format("t = {:.6g} s: the fluid{} {:.3g} cells in its step of {:.3g} s; {}", t + dt,
                    viscous ? "'s viscosity carries its motion over" : " moves by", step.courant, dt,
                    viscous ? "use larger cells, a smaller dem.fixed_step, or effects.fluid_stress = \"none\""
                            : "lower dem.fluid_every; where it is 1, take larger cells or a smaller dem.fixed_step"));
  }
  return step;
}

void Flow::set_voidage(const ParticlePhase& particles) {
  fluid_.voidage = particles.voidage;
  boundaries_.fill_cells(fluid_.voidage);
  if (compressible_) set_density();
}

void Flow::set_density() {
  if (!compressible_->set_density(fluid_))
    throw core::NumericsError("the pressure of the fluid has left the range of its equation of state");
}

/// Adds the mass that passed the ends in a step, at the density in its equations; then updates the density to the new
/// pressure. No particle crosses an end of a column with a compressible fluid: J is the fluid's own flux there.
void Flow::finish_compression(double dt, FlowStep& step) {
  const MassFlow flow = mass_flow(grid_, boundaries_, fluid_, fluid_.flux);
  step.mass_in = flow.in * dt;
  step.mass_out = flow.out * dt;
  set_density();
}

/// What flows through an end or a side where that is given. The fluid's velocity is its own part of it over the voidage
/// of the cells next to it.
void Flow::set_inlet(double t) {
  if (boundaries_.closed()) return;
  inlet_.set_velocity(t, fluid_.flux);
  inlet_.set_velocity(t, own_flux_);
  inlet_.take_solids_out(t, fluid_.voidage, own_flux_);
  for (const int side : {0, 1}) {
    if (side == 1 && boundaries_.has_outlet()) continue;
    const auto inward = std::size_t(side) * std::size_t(grid_.stride(1));
    for_each_boundary_row(grid_, 1, side, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        fluid_.velocity[1][c] = own_flux_[1][c] / fluid_.voidage[c - inward];
    });
  }
  inlet_.for_each_side_face([&](std::size_t a, Index face, Index inside) {
    fluid_.velocity[a][std::size_t(face)] = own_flux_[a][std::size_t(face)] / fluid_.voidage[std::size_t(inside)];
  });
  for_each_open_face([&](const OpenFace& f, std::size_t a, std::size_t at) {
    const double flux = fluid_.velocity[a][at], out = held_ ? 0 : f.leaving(flux);
    own_flux_[a][at] = flux - (1 - fluid_.voidage[std::size_t(f.inside)]) * out;
  });
  core::hold_closed(grid_, fluid_.velocity);
}

/// Computes a, and dt (U.grad)U.
void Flow::find_acceleration(double dt, const ParticlePhase& particles) {
  boundaries_.fill_velocity(fluid_.velocity, WallSlip::no_slip);
  inlet_.extend(fluid_.velocity);
  std::vector<double> kept;  // between held particles the fluid is faster than the flux
  if (held_)
    for_each_open_face([&](const OpenFace& f, std::size_t a, std::size_t at) {
      kept.push_back(fluid_.velocity[a][at]);
      fluid_.velocity[a][at] /= fluid_.voidage[std::size_t(f.inside)];
    });
  for_each_open_face(
      [&](const OpenFace& f, std::size_t a, std::size_t) { extend_beyond(grid_, f.at, f.face, fluid_.velocity[a]); });
  find_own_flux(particles);
  const auto on_face = [&](std::size_t a, Index c, Index) { return particles.voidage_on[a][std::size_t(c)]; };
  convection(grid_, boundaries_, limited_, true, own_flux_, fluid_.velocity, on_face, acceleration_);
  core::hold_closed(grid_, acceleration_);
  for (std::size_t a = 0; a < std::size_t(grid_.dimensions); ++a)
    for (std::size_t c = 0; c < convected_[a].size(); ++c) convected_[a][c] = -dt * acceleration_[a][c];
  if (viscous_) add_viscous_stress(grid_, boundaries_, fluid_, constants_, acceleration_);
  if (compressible_) compressible_->add_gravity(fluid_, acceleration_);
  if (auto next = kept.begin(); held_)
    for_each_open_face([&](const OpenFace&, std::size_t a, std::size_t at) { fluid_.velocity[a][at] = *next++; });
}

/// eps U. set_inlet has set it where it is given.
void Flow::find_own_flux(const ParticlePhase& particles) {
  const auto dimensions = std::size_t(grid_.dimensions);
  std::array<Ghosts, 3> ghosts{};
  for (std::size_t a = 0; a < dimensions; ++a) {
    core::for_each_row(grid_, boundaries_.moving_faces(int(a), true), [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        own_flux_[a][c] = particles.voidage_on[a][c] * fluid_.velocity[a][c];
    });
    ghosts[a] = {Ghosts::Kind::joined, &own_flux_[a]};
  }
  boundaries_.fill(std::span(ghosts).first(dimensions));
}

/// Computes dU without the change of pressure, the corresponding J, and B.
template <class Density>
void Flow::push(const Density& density, double dt, const ParticlePhase& particles) {
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const Index s = grid_.stride(axis);
    core::for_each_row(grid_, boundaries_.moving_faces(axis, true), [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f) {
        const auto c = std::size_t(f);
        const double eps = particles.voidage_on[a][c], inertia = eps * density.on_face(f, s);
        const double whole = inertia + particles.drag[a][c];
        double force = dt * (inertia * acceleration_[a][c] - eps * gradient_[a][c]) - particles.impulse[a][c];
        double flux = eps * fluid_.velocity[a][c] + particles.flux[a][c];
        if (particles.added_mass()) {
          force -= particles.carry[a][c] * convected_[a][c];
          flux += particles.carry_flux[a][c] * convected_[a][c];
        }
        const double change = force / whole;
        velocity_change_[a][c] = change;
        fluid_.flux[a][c] = flux + (eps + particles.follow[a][c]) * change;
        per_inertia_[a][c] = (eps + particles.slide[a][c]) / whole;
        mobility_[a][c] = (eps + particles.follow[a][c]) * per_inertia_[a][c] + particles.yield[a][c];
      }
    });
  }
  for_each_open_face([&](const OpenFace& f, std::size_t a, std::size_t at) {
    const double eps = fluid_.voidage[std::size_t(f.inside)];
    const double own = density.on_face(f.face, grid_.stride(int(a)));
    const OpenFace open = held_ ? f.between(eps) : f;
    mobility_[a][at] = per_inertia_[a][at] = open.mobility(held_ ? own : eps * own + (1 - eps) * solids_density_);
    velocity_change_[a][at] =
        dt * (open.convection(fluid_.velocity[a], fluid_.velocity[a]) - mobility_[a][at] * gradient_[a][at]);
    fluid_.flux[a][at] = fluid_.velocity[a][at] + velocity_change_[a][at];
  });
}

/// Nothing moves at faces closed by a round wall, whatever the pressure.
void Flow::hold() {
  core::hold_closed(grid_, velocity_change_);
  core::hold_closed(grid_, fluid_.flux);
  core::hold_closed(grid_, per_inertia_);
}

/// Adds compressibility to the constraint, over dt: div J = -kappa dP/dt - (Q.grad) rho_f/rho_f. The last term is
/// differenced between faces and cell: with div J it equals div(rho_f Q), and outflow of a cell is inflow of the next.
void Flow::add_compression(double dt) {
  const LocalDensity density{fluid_.compression.density.data()};
  core::with_metric(grid_, [&](const auto& metric) {
    core::for_each_row(grid_, [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f) {
        const auto c = std::size_t(f);
        const double here = density.cells[c];
        double carried = 0;  // (Q.grad) rho_f, kg/(m3 s)
        for (int axis = 0; axis < grid_.dimensions; ++axis) {
          const auto a = std::size_t(axis);
          const Index s = grid_.stride(axis);
          carried += (metric.open(a, f + s) * own_flux_[a][c + std::size_t(s)] * (density.on_face(f + s, s) - here) -
                      metric.open(a, f) * own_flux_[a][c] * (density.on_face(f, s) - here)) /
                     grid_.spacing[a];
        }
        shift_[c] = metric.volume(f) * fluid_.compression.kappa[c] / (dt * dt);
        source_[c] -= metric.per_volume(f) * carried / (here * dt);
      }
    });
  });
}

/// Applies the change of pressure.
void Flow::correct(double dt) {
  gradient_of(change_, gradient_change_);
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    core::for_each_row(grid_, boundaries_.moving_faces(axis, true), [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        velocity_change_[a][c] -= dt * per_inertia_[a][c] * gradient_change_[a][c];
        fluid_.velocity[a][c] += velocity_change_[a][c];
        fluid_.flux[a][c] -= dt * mobility_[a][c] * gradient_change_[a][c];
      }
    });
  }
  for_each_open_face([&](const OpenFace&, std::size_t a, std::size_t at) {
    velocity_change_[a][at] -= dt * mobility_[a][at] * gradient_change_[a][at];
    fluid_.velocity[a][at] += velocity_change_[a][at];
    fluid_.flux[a][at] = fluid_.velocity[a][at];
  });
  core::for_each_row(grid_, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) fluid_.pressure[c] += change_[c];
  });
  set_gradient();  // from the sum, so that a resumed run has the same bits
  boundaries_.join(fluid_.velocity, fluid_.flux);
}

void Flow::shift(const std::array<double, 3>& velocity) {
  for (std::size_t a = 0; a < std::size_t(grid_.dimensions); ++a) {
    for (double& u : fluid_.velocity[a]) u += velocity[a];
    for (double& j : fluid_.flux[a]) j += velocity[a];
  }
}

double Flow::courant(double dt) const {
  double most = 0;
  core::with_metric(grid_, [&]<class Metric>(const Metric& metric) {
    for (int axis = 0; axis < grid_.dimensions; ++axis) {
      const auto a = std::size_t(axis);
      const double h = grid_.spacing[a], *u = fluid_.velocity[a].data();
      const Index s = grid_.stride(axis);
      core::for_each_row(grid_, core::owned_faces(grid_, axis), [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) {
          double crossed = std::abs(u[c]) * dt / h;
          if constexpr (Metric::radial)  // the smaller of the two adjacent cells
            crossed *= metric.open(a, c) * std::max(metric.per_volume(c - s), metric.per_volume(c));
          most = crossed <= most ? most : crossed;  // written so that NaN is kept
        }
      });
    }
  });
  return std::max(core::greatest_of_ranks(grid_, most), viscous_courant(dt));
}

double Flow::viscous_courant(double dt) const {
  return viscous_ ? 2 * constants_.viscosity / constants_.density * dt * per_square_ : 0;
}

}  // namespace polybed::fluid
