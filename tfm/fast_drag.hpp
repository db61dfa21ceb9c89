// The part of the drag that is too fast for explicit steps, on each face separately: linear in the velocities, with
// coefficients that are constant during a step. The explicit part contains the rest of the equations.
//
//   dU_j/dt = [ b_j (U_f - U_j) - G ] / rho_j,    U_f = (J - sum_k phi_k U_k) / eps,    dJ/dt = 0
//   B G = sum_k phi_k b_k (1/rho_k - 1/rho_f) (U_f - U_k),    B = eps/rho_f + sum_k phi_k/rho_k
//
// G is the gradient of pressure that keeps the total flux constant against the drag for flow along one axis. The
// relaxation rate of the rest is proportional to the squared difference of densities, sum_k phi_k b_k (1/rho_f -
// 1/rho_k)^2/B: a few hundredths of the drag's rate in a liquid, about all of it in a gas. In form B, G is 0: it acts
// on the fluid alone, whose flux is constant.
//
// With added mass, k_j = C_m rho_f/(rho_j + C_m rho_f), and s_j = 1, s_f = eps (form A) or s_j = 0, s_f = 1 (form B):
//
//   dU_j/dt = (1 - k_j) [ b_j (U_f - U_j) - s_j G ] / rho_j + k_j a_f,    eps a_f + sum_k phi_k dU_k/dt = 0
//   (eps rho_f + sum_k phi_k k_k rho_k) a_f = -sum_k phi_k (1 - k_k) b_k (U_f - U_k) - (s_f + sum_k phi_k k_k s_k) G
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

/// The relaxation rate, 1/s, of the drag outside FastDrag; species are added one by one.
class SlowDrag {
 public:
  /// \param voidage  eps  \param fluid_density  rho_f, kg/m3
  SlowDrag(double voidage, double fluid_density) : fluid_density_(fluid_density), mobility_(voidage / fluid_density) {}
  /// \param phi  fraction  \param b  exchange coefficient over phi, kg/(m3 s)  \param density  kg/m3
  void add(double phi, double b, double density) {
    const double lighter = 1 / fluid_density_ - 1 / density;
    sum_ += phi * b * lighter * lighter;
    mobility_ += phi / density;
  }
  [[nodiscard]] double rate() const { return sum_ / mobility_; }

 private:
  double fluid_density_, mobility_, sum_ = 0;
};

class FastDrag {
 public:
  FastDrag(const Constants& constants, const fluid::Boundaries& boundaries, const StateLayout& layout);

  /// Takes the coefficients phi_j, b_j and eps on faces from the fields after a right-hand side.
  void hold(const Fields& fields);
  /// Adds `factor` times the rates above, for a state y, to `rates`.
  void add(double factor, std::span<const double> y, std::span<double> rates) const;
  /// Solves x - gamma A x = r, where A x are the rates above and x contains r at first. \param gamma  s, >= 0
  void solve(double gamma, std::span<double> x) const;

 private:
  /// Data on the faces of one axis, in the order of the state.
  struct Faces {
    std::size_t begin = 0, size = 0;                        ///< begin of the flux in the state, and number of faces
    std::vector<std::size_t> velocity;                      ///< begin of U_j in the state
    std::vector<std::vector<double>> phi, b;                ///< [species][face]; b is 0 on faces where solids are fixed
    std::vector<std::vector<double>> share;                 ///< k_j; empty without added mass
    std::vector<double> voidage, mobility;                  ///< eps, and B in m3/kg
    std::vector<std::pair<std::size_t, std::size_t>> runs;  ///< ranges of adjacent faces where solids move
  };

  template <class Kernel>
  void in_blocks(Kernel&& kernel) const;
  void add_in_block(const Faces& faces, std::size_t begin, std::size_t count, double factor, const double* y,
                    double* rates) const;
  void solve_in_block(const Faces& faces, std::size_t begin, std::size_t count, double gamma, double* x) const;
  void add_with_inertia(const Faces& faces, std::size_t begin, std::size_t count, double factor, const double* y,
                        double* rates) const;
  void solve_with_inertia(const Faces& faces, std::size_t begin, std::size_t count, double gamma, double* x) const;
  static void add_loops(const FastDrag& drag, double factor, const double* y, double* rates);
  static void solve_loops(const FastDrag& drag, double gamma, double* x);

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  const StateLayout& layout_;
  std::vector<Faces> axes_;
  bool inertia_ = false;
  std::vector<double> lighter_;  ///< 1/rho_k - 1/rho_f, m3/kg; 0 in form B
};

}  // namespace polybed::tfm
