// Parts of the sides through which a mixture leaves because the pressure outside is lower: discharges with a pressure.
//
// Fluid and solids move alike in them, without friction, as a mixture of density rho_m: for the share s of a face,
// J = s u, and the outward normal n, with the pressure p_out half a cell outside,
//
//   dJ/dt = -s [max(u, 0) (u - u_in)/h - min(u, 0) u/h + (p_out - p_in)/(rho_m h)],
//
// u_in the fluid's velocity on the next face inside; outside the fluid is at rest. Solids leave with the mixture and
// never come back.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/case/scene.hpp"
#include "core/numerics/field.hpp"

namespace polybed::fluid {

struct OpenFace {
  core::ColumnFace at;
  core::Index face, inside, beyond;  ///< the cells on either side
  core::Index within;                ///< the next face inside
  double share;                      ///< of the face
  double outward;                    ///< 1 or -1 along the axis
  double spacing;                    ///< h, m
  double rise;                       ///< p_out/h along the axis, Pa/m

  [[nodiscard]] std::size_t axis() const { return std::size_t(axis_of(at)); }
  /// The part between particles that do not move, for the fluid alone.
  [[nodiscard]] OpenFace between(double voidage) const {
    OpenFace part = *this;
    part.share *= voidage;
    return part;
  }
  /// B, m3/kg. \param density  rho_m, kg/m3
  [[nodiscard]] double mobility(double density) const { return share / density; }
  /// Acceleration of J by its own convection, along the axis, m/s2.
  [[nodiscard]] double convection(const core::Field& flux, const core::Field& velocity) const {
    const double u = outward * flux[std::size_t(face)] / share;
    const double before = u > 0 ? outward * velocity[std::size_t(within)] : 0;
    return -outward * share * std::abs(u) * (u - before) / spacing;
  }
  /// Gradient of a pressure that is 0 outside, along the axis, Pa/m.
  [[nodiscard]] double gradient(const core::Field& pressure) const {
    return -outward * pressure[std::size_t(inside)] / spacing;
  }
  /// The part of a flux that flows out, along the axis, m/s.
  [[nodiscard]] double leaving(double flux) const { return outward * std::max(outward * flux, 0.0); }
};

/// Those of a block.
[[nodiscard]] std::vector<OpenFace> open_faces(const core::Grid& grid, const core::Scene& scene);

[[nodiscard]] bool has_open_sides(const core::Scene& scene);

/// Volume flow of the mixture out through them, m3/s; negative: back in. Collective.
[[nodiscard]] double outflow(const core::Grid& grid, const std::vector<OpenFace>& faces, const core::FaceField& flux);

}  // namespace polybed::fluid
