// The two-relaxation-time collision with a body force, on a row of sites.
#pragma once

#include <array>
#include <cstddef>

#include "core/vectors.hpp"
#include "multiscale/resolve/lattice/lattice.hpp"

namespace polybed::multiscale::lattice {

/// Rates and force, density 1.
template <class Real>
struct Relaxation {
  Real even = 0, odd = 0;       ///< 1/tau+ and 1/tau-
  std::array<Real, 3> force{};  ///< per site
};

/// Rate of the odd part that puts the wall of half-way bounce-back exactly half-way: (1/even - 1/2)(1/odd - 1/2) = 3/16
/// (Ginzburg and d'Humieres, Phys. Rev. E 68 (2003) 066614).
[[nodiscard]] constexpr double odd_rate(double even) { return 1 / (0.5 + 3.0 / 16 / (1 / even - 0.5)); }

/// Collides the sites at place[i][z], z < length: the arriving population along i is read there, the departing one
/// against i is written there. Populations are relative to their values at rest, so that single precision keeps its
/// digits and forces exclude the rest pressure. Equilibrium of an incompressible fluid (He and Luo, J. Stat. Phys. 88
/// (1997) 927); `inertia` adds its terms in the square of the velocity, and the force's after Guo et al. (Phys. Rev. E
/// 65 (2002) 046308).
template <class Real, bool inertia>
inline void collide_row(Real* const* place, std::size_t length, const Relaxation<Real>& r) {
  const Real fx = r.force[0], fy = r.force[1], fz = r.force[2];
  const Real even = r.even, odd = r.odd, push = Real(3) * (1 - odd / 2), stir = 1 - even / 2;
  Real* const p0 = place[0];
  // One local pointer per direction, so that the loop below is one vector loop.
  Real *const p1 = place[1], *const p2 = place[2], *const p3 = place[3], *const p4 = place[4], *const p5 = place[5],
              *const p6 = place[6], *const p7 = place[7], *const p8 = place[8], *const p9 = place[9],
              *const p10 = place[10], *const p11 = place[11], *const p12 = place[12], *const p13 = place[13],
              *const p14 = place[14], *const p15 = place[15], *const p16 = place[16], *const p17 = place[17],
              *const p18 = place[18];
#pragma GCC ivdep
  for (std::size_t z = 0; z < length; ++z) {
    const Real h0 = p0[z];
    const Real s1 = p1[z] + p2[z], d1 = p1[z] - p2[z], s3 = p3[z] + p4[z], d3 = p3[z] - p4[z];
    const Real s5 = p5[z] + p6[z], d5 = p5[z] - p6[z], s7 = p7[z] + p8[z], d7 = p7[z] - p8[z];
    const Real s9 = p9[z] + p10[z], d9 = p9[z] - p10[z], s11 = p11[z] + p12[z], d11 = p11[z] - p12[z];
    const Real s13 = p13[z] + p14[z], d13 = p13[z] - p14[z], s15 = p15[z] + p16[z], d15 = p15[z] - p16[z];
    const Real s17 = p17[z] + p18[z], d17 = p17[z] - p18[z];
    const Real rho = h0 + ((s1 + s3) + (s5 + s7)) + ((s9 + s11) + (s13 + s15)) + s17;
    const Real ux = d1 + (d7 + d9) + (d11 + d13) + fx / 2;
    const Real uy = d3 + (d7 - d9) + (d15 + d17) + fy / 2;
    const Real uz = d5 + (d11 - d13) + (d15 - d17) + fz / 2;
    Real rest = rho, source = 0;
    if constexpr (inertia) {
      rest -= Real(1.5) * (ux * ux + uy * uy + uz * uz);
      source = -3 * stir * (ux * fx + uy * fy + uz * fz);
    }
    p0[z] = h0 - even * (h0 - rest / 3) + source / 3;
    const auto pair = [&](Real* along, Real* against, Real s, Real d, Real u, Real f, Real w) {
      Real whole = rest, added = source;
      if constexpr (inertia) {
        whole += Real(4.5) * u * u;
        added += 9 * stir * u * f;
      }
      const Real symmetric = s / 2 - even * (s / 2 - w * whole) + w * added;
      const Real antisymmetric = d / 2 - odd * (d / 2 - 3 * w * u) + w * push * f;
      along[z] = symmetric - antisymmetric;
      against[z] = symmetric + antisymmetric;
    };
    const Real face = Real(1.0 / 18), edge = Real(1.0 / 36);
    pair(p1, p2, s1, d1, ux, fx, face);
    pair(p3, p4, s3, d3, uy, fy, face);
    pair(p5, p6, s5, d5, uz, fz, face);
    pair(p7, p8, s7, d7, ux + uy, fx + fy, edge);
    pair(p9, p10, s9, d9, ux - uy, fx - fy, edge);
    pair(p11, p12, s11, d11, ux + uz, fx + fz, edge);
    pair(p13, p14, s13, d13, ux - uz, fx - fz, edge);
    pair(p15, p16, s15, d15, uy + uz, fy + fz, edge);
    pair(p17, p18, s17, d17, uy - uz, fy - fz, edge);
  }
}

}  // namespace polybed::multiscale::lattice
