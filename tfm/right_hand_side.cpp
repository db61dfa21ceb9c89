#include "tfm/right_hand_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/ranks.hpp"
#include "fluid/pressure.hpp"
#include "tfm/granular_temperature.hpp"
#include "tfm/mean_flow.hpp"
#include "tfm/mixture.hpp"
#include "tfm/particle_forces.hpp"
#include "tfm/solids_viscosity.hpp"

namespace polybed::tfm {

using core::Index;

RightHandSide::RightHandSide(const core::Scene& scene, Constants constants, fluid::Boundaries boundaries,
                             fluid::Inlet inlet, Discretisation discretisation, core::Timers& timers)
    : constants_(std::move(constants)),
      boundaries_(std::move(boundaries)),
      inlet_(std::move(inlet)),
      discretisation_(discretisation),
      timers_(timers),
      fields_(constants_),
      effects_(make_effects(scene, constants_, boundaries_, fields_)),
      convection_(constants_, boundaries_, discretisation_.momentum == Scheme::limited, fields_),
      viscous_weight_(fields_.stress.viscosity) {
  using Kind = fluid::Ghosts::Kind;
  for (core::Field& phi : fields_.solids.fraction) state_ghosts_.push_back({Kind::cells, &phi});
  for (core::FaceField& velocity : fields_.solids.velocity)
    for (int axis = 0; axis < constants_.grid.dimensions; ++axis)
      state_ghosts_.push_back({Kind::velocity, &velocity[std::size_t(axis)], axis, discretisation_.solids_wall});
  for (int axis = 0; axis < constants_.grid.dimensions; ++axis)
    state_ghosts_.push_back({Kind::joined, &fields_.fluid.flux[std::size_t(axis)]});
}

// Per unit mass of each phase, from T(1.27), T(1.28) and T(1.16) with the pressure gradient of T(1.17):
//
//   (1) dphi_j/dt = -div(phi_j U_j)
//   (2) dU_j/dt   = a_j - grad p / rho_j
//       a_j = -(U_j.grad)U_j + (1 - rho_f/rho_j) g + (b_j/rho_j)(U_f - U_j) - grad p_s/(phi rho_j)
//             + div(phi_j T_j)/((phi_j + 1e-4 X_j) rho_j) + sum_k K_jk (U_k - U_j)/(phi_j rho_j) + f_j/rho_j
//   (3) a_f = -(U_f.grad)U_f + div(eps tau)/(eps rho_f) - sum_j phi_j [b_j (U_f - U_j) + f_j]/(eps rho_f)
//   (4) dJ/dt = eps a_f + sum_j phi_j a_j + sum_j (U_j - U_f) dphi_j/dt - B grad p
//
// f_j is the closures' force on individual particles (lift) over their volume. Added mass couples the accelerations and
// replaces 1/rho_j and 1/rho_f in (2) and B: effects/added_mass.cpp. A compressible fluid adds (5) of
// fluid/compressible.hpp; rho_f in (2) is then rho_0, and (3) has the additional term -(1 - rho_0/rho_f) g.
bool RightHandSide::evaluate(double t, const StateLayout& layout, std::span<const double> y) {
  const auto timed = [&](const char* term, auto&& work) {
    const auto scope = timers_.scope(term);
    work();
  };
  timed("boundaries", [&] {
    layout.unpack(y, fields_.solids, fields_.fluid);
    set_inlet_velocity(t);
    fill_ghosts(t);
  });
  if (!admissible()) return false;
  if (!equation_of_state()) return false;
  timed("mixture", [&] {
    superficial_slip(constants_, boundaries_, fields_);
    if (effects_.compressible) weigh_slip_by_density(constants_, fields_);
  });
  timed("continuity",
        [&] { continuity(constants_, boundaries_, discretisation_.flux, side_of(t), fields_, first_order_); });
  timed("convection", [&] { convection_.set(); });
  if (effects_.inertia) timed("added mass", [&] { effects_.inertia->keep_convection(fields_); });
  if (effects_.fluid_stress) timed("fluid stress", [&] { effects_.fluid_stress->add(fields_); });
  timed("gravity", [&] {
    add_gravity(constants_, boundaries_, fields_);
    if (mean_gradient_ != 0) subtract_mean_gradient(constants_, boundaries_, mean_gradient_, fields_);
    if (effects_.compressible) effects_.compressible->add_gravity(fields_.fluid, fields_.fluid_acceleration);
  });
  if (effects_.drag)
    timed("drag", [&] {
      effects_.drag->evaluate(fields_);
      add_exchange(constants_, boundaries_, fields_);
      fluid::subtract_exchange(constants_.grid, boundaries_, fields_.solids, fields_.fluid, constants_.fluid.density,
                               fields_.fluid_acceleration);
    });
  if (effects_.solids_stress) timed("solids stress", [&] { add_solids_stress(); });
  if (effects_.species_exchange)
    timed("species exchange", [&] {
      effects_.species_exchange->evaluate(fields_);
      add_species_exchange(constants_, boundaries_, fields_);
    });
  if (!effects_.forces.empty()) timed("particle forces", [&] { add_particle_forces(); });
  if (effects_.inertia) timed("added mass", [&] { effects_.inertia->couple(fields_); });
  timed("volume flux", [&] { set_flux_rate(t); });
  if (effects_.compressible)
    timed("fluid continuity", [&] { effects_.compressible->set_pressure_rate(fields_.solids, fields_.fluid); });
  return true;
}

/// Computes the density of a compressible fluid; false if a pressure has none.
bool RightHandSide::equation_of_state() {
  if (!effects_.compressible) return true;
  const auto scope = timers_.scope("equation of state");
  return effects_.compressible->set_density(fields_.fluid);
}

void RightHandSide::drive(const StateLayout& layout, std::span<const double> y) {
  if (!constants_.grid.periodic[1]) return;
  layout.unpack(y, fields_.solids, fields_.fluid);
  mean_gradient_ = tfm::mean_gradient(constants_, fields_.solids);
}

void RightHandSide::hold_solids_above(int row) {
  if (row == solids_rows_) return;
  solids_rows_ = row;
  boundaries_.hold_solids_above(row);
  clear_results_of_solids(fields_);  // older ones above the row
}

std::optional<fluid::MassFlow> RightHandSide::mass_flow(double t, const StateLayout& layout,
                                                        std::span<const double> y) {
  layout.unpack(y, fields_.solids, fields_.fluid);
  set_inlet_velocity(t);
  constants_.openings.follow(fields_.fluid.flux, fields_.solids);
  if (!effects_.compressible->set_density(fields_.fluid)) return std::nullopt;
  fluid_flux_through_ends(constants_, boundaries_, side_of(t), fields_);
  return fluid::mass_flow(constants_.grid, boundaries_, fields_.fluid, fields_.fluid.compression.flux);
}

/// Adds the pressure of the solids and, with the corresponding effects, viscosity and granular temperature.
void RightHandSide::add_solids_stress() {
  SolidsStress& stress = fields_.stress;
  effects_.solids_stress->evaluate(fields_);
  if (stress.viscous()) {
    strain_rates(constants_, boundaries_, fields_);
    std::fill(stress.viscosity.begin(), stress.viscosity.end(), 0.0);
    if (effects_.solids_viscosity) effects_.solids_viscosity->add(fields_);
    if (effects_.collisions) effects_.collisions->add(fields_);
    if (!fields_.solids.temperature_rate.empty())
      add_temperature_transport(constants_, boundaries_, discretisation_.flux, fields_);
    boundaries_.fill_cells(stress.viscosity);
    if (effects_.solids_wall) effects_.solids_wall->fill_ghosts(fields_);
    add_solids_viscosity(constants_, boundaries_, fields_, viscous_weight_);
  }
  if (boundaries_.open())  // nothing outside pushes back
    fluid::set_outlet_pressure(constants_.grid, boundaries_, stress.pressure);
  subtract_stress(constants_, boundaries_, fields_);
}

/// Adds the closures' forces on individual particles to the solids and, with the opposite sign, to the fluid.
void RightHandSide::add_particle_forces() {
  for (int axis = 0; axis < constants_.grid.dimensions; ++axis) {
    for (core::Field& force : fields_.force.on_solids) std::fill(force.begin(), force.end(), 0.0);
    for (const auto& effect : effects_.forces) effect->add(axis, fields_);
    share_particle_forces(constants_, boundaries_, axis, fields_);
  }
}

void RightHandSide::set_flux_rate(double t) {
  const bool openings = constants_.openings.present();
  if (openings) constants_.openings.hold(fields_.solids.acceleration);
  fluid::flux_rate(constants_.grid, boundaries_, fields_.solids, fields_.fluid, constants_.fluid.density,
                   fields_.fluid_acceleration, fields_.flux_rate);
  if (effects_.inertia)
    effects_.inertia->set_mobility(fields_);
  else if (openings)
    constants_.openings.hold(fields_.solids, fields_.flux_rate.mobility);
  core::hold_closed(constants_.grid, fields_.flux_rate.free);
  set_inlet_rate(t);
}

/// Fills ghosts of the unknowns, and computes composition and fluid velocity, which need no closure.
void RightHandSide::fill_ghosts(double t) {
  if (constants_.openings.present()) {
    constants_.openings.set_velocities(side_of(t), fields_.solids);
    constants_.openings.follow(fields_.fluid.flux, fields_.solids);
  }
  boundaries_.fill(state_ghosts_);
  if (constants_.openings.present()) {
    constants_.openings.set_ghosts(side_of(t), fields_.solids);
    const int every = constants_.openings.in_sides() ? 1 : 2;
    for (core::Field& phi : fields_.solids.fraction)  // the row beyond the end, for lateral neighbours
      for (int axis = 0; axis < constants_.grid.dimensions; axis += every) boundaries_.join(phi, axis);
  }
  composition(constants_, fields_);
  fluid::fluid_velocity(constants_.grid, fields_.solids, fields_.fluid);
  boundaries_.fill_velocity(fields_.fluid.velocity, fluid::WallSlip::no_slip);
  inlet_.extend(fields_.fluid.velocity);
  for (const fluid::OpenFace& f : boundaries_.open_faces())
    fluid::extend_beyond(constants_.grid, f.at, f.face, fields_.fluid.velocity[f.axis()]);
}

/// The side of a breakpoint or jump of the inlet for a time: the end of a step lies before it.
double RightHandSide::side_of(double t) const {
  return t > begin_ ? std::nextafter(t, -std::numeric_limits<double>::infinity()) : t;
}

/// Sets the flux through the distributor to the inlet's value, as its integrated rate has an error.
void RightHandSide::set_inlet_velocity(double t) {
  if (boundaries_.closed()) return;
  inlet_.set_velocity(side_of(t), fields_.fluid.flux);
}

void RightHandSide::set_inlet_rate(double t) {
  if (boundaries_.closed()) return;
  inlet_.set_rate(side_of(t), fields_.flux_rate.free);
}

bool RightHandSide::admissible() const {
  double most = 0, speed = 0;
  core::for_each_row(constants_.grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      most = std::max(most, fields_.solids_fraction[c]);
      for (int axis = 0; axis < constants_.grid.dimensions; ++axis)
        speed += fields_.fluid.velocity[std::size_t(axis)][c];
    }
  });
  return core::on_all_ranks(constants_.grid, most < 1 && std::isfinite(speed));
}

}  // namespace polybed::tfm
