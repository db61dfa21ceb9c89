// Stress of the particles: the purpose of a sheared box, and the pressure of a gas of spheres.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/model.hpp"

namespace polybed::dem {

using Tensor = std::array<std::array<double, 3>, 3>;

/// sigma = (1/V) [sum m v' v' + sum_pairs r_ij F_ij], Pa, positive in compression (Irving and Kirkwood, J. Chem. Phys.
/// 18, 1950, 817). v' is the velocity relative to a sheared box's own flow, v - gamma y e_x; r_ij = x_i - x_j, F_ij the
/// force on i: component (a, b) is the flux of b-momentum along a. V is the volume of the box. Walls are excluded: it
/// is meant for boxes with periodic sides all round.
struct Stress {
  Tensor kinetic{}, contact{};
  std::vector<Tensor> kinetic_of;   ///< by species; their sum is `kinetic`
  std::vector<double> temperature;  ///< theta_j = <v'^2>/3 by species, m2/s2
  std::int64_t contacts = 0;        ///< touching pairs
  double shear_rate = 0;            ///< 1/s, of the box

  [[nodiscard]] double component(std::size_t a, std::size_t b) const { return kinetic[a][b] + contact[a][b]; }
  /// p_s = tr sigma/3, Pa.
  [[nodiscard]] double pressure() const { return (component(0, 0) + component(1, 1) + component(2, 2)) / 3; }
  /// -sigma_yx, Pa: flux of x-momentum along y. Times gamma it is the work of the shear. -sigma_xy differs from it by
  /// the torque of friction on spheres whose spin still changes: with few contacts by 5 % for a long time.
  [[nodiscard]] double shear() const { return -component(1, 0); }
  /// mu_s = -sigma_yx/gamma, Pa s; meaningless without shear.
  [[nodiscard]] double viscosity() const { return shear() / shear_rate; }
};

/// For the last step, at the velocities of the full step. Changes no state: contacts are evaluated again, with a copy
/// of their memory. Collective: the same on any number of ranks to the bit.
[[nodiscard]] Stress stress_of(Model& model);

/// An interacting pair of particles, without walls.
struct ContactForce {
  std::size_t first;     ///< index of the particle
  Vector normal, force;  ///< from the second to the first; on the first, N
  double length;         ///< between the centres, m
  bool touches;          ///< not just near, for example with a film between them
};

/// For the last step, those that this rank counts; like stress_of it changes no state. Collective.
[[nodiscard]] std::vector<ContactForce> contact_forces(Model& model);

}  // namespace polybed::dem
