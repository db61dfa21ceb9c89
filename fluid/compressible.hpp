// A compressible fluid: density from the total pressure, and the continuity equation for the pressure.
//
//   (5) div J + kappa (dp/dt + U_f.grad P) = 0,   kappa = eps/(rho_f c^2),   P = P_out + p + rho_0 g (H - y)
//
// P is the total pressure, p the net one, H the height of the column, rho_0 the density at P_out. With dphi_j/dt =
// -div F_j and the fluid's own flux Q = J - sum F_j, (5) is the fluid's mass balance over rho_f,
//
//   d(eps rho_f)/dt + div(rho_f Q) = 0,
//
// and is discretised in this form: outflow of one cell is inflow of the next, so mass has only the error in time.
#pragma once

#include <variant>

#include "closures/equation_of_state.hpp"
#include "core/case/scene.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/fluid_state.hpp"
#include "fluid/interphase.hpp"

namespace polybed::fluid {

/// Density as a function of pressure.
using EquationOfState = std::variant<closures::TaitLiquid, closures::IdealGas>;

/// The law in a case, through rho_0 at its outlet pressure; not for an incompressible fluid.
/// \param density  rho_0, kg/m3
[[nodiscard]] EquationOfState equation_of_state(const core::Fluid& fluid, double density);

/// Speed of sound in the fluid alone, m/s, at a total pressure, Pa.
[[nodiscard]] double speed_of_sound(const EquationOfState& law, double pressure);

class Compressible {
 public:
  /// \param outlet_pressure  P_out, Pa  \param density  rho_0, kg/m3  \param gravity  m/s2, downward
  Compressible(const core::Grid& grid, const Boundaries& boundaries, EquationOfState law, double outlet_pressure,
               double density, double gravity);

  /// Creates the fields of a compressible fluid.
  void make_fields(FluidState& fluid) const;
  /// Sets rho_f and kappa from p and eps. Returns false if the law has no density at P (a gas at P <= 0, a torn
  /// liquid). Sets the ghosts of p.
  [[nodiscard]] bool set_density(FluidState& fluid) const;
  /// Adds gravity on the deviation of rho_f from rho_0, which the net pressure lacks: -(1 - rho_0/rho_f) g.
  void add_gravity(const FluidState& fluid, core::FaceField& acceleration) const;
  /// Sets dp/dt from J, Q and dphi_j/dt with (5).
  void set_pressure_rate(const Interphase& solids, FluidState& fluid) const;
  /// P in the owned cells, Pa.
  [[nodiscard]] core::Field total_pressure(const FluidState& fluid) const;
  /// P, Pa, in a cell of height index j with net pressure p, Pa.
  [[nodiscard]] double total_pressure(double p, int j) const;
  /// The shortest time for sound to cross a cell, s, and the cell.
  [[nodiscard]] std::pair<double, core::Index> sound_time(const FluidState& fluid) const;

 private:
  core::Grid grid_;
  Boundaries boundaries_;
  EquationOfState law_;
  double outlet_pressure_, density_, gravity_;
};

}  // namespace polybed::fluid
