// A settled bed of glass beads of 0.5 mm, to show that it rests.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/numerics/operators.hpp"
#include "scenes/beds.hpp"
#include "tfm/model.hpp"

namespace polybed::scenes {

/// 0.1 m of them in water, or in air, in 40 layers of 3 mm, closed.
inline core::Scene settled_glass(bool gas = false) {
  core::Scene scene = gas ? uniform_bed(0.5e-3, 2500, 1.2, 1.8e-5, 0.58, 40, 0.12)
                          : uniform_bed(0.5e-3, 2500, 998.207, 1.00157e-3, 0.58, 40, 0.12);
  scene.column.closed = true;
  scene.effects["solids_stress"] = "frictional";
  scene.bed.start = {core::StartKind::settled};
  scene.bed.static_height = 0.1;
  scene.tfm.max_packing = 0.64;
  return scene;
}

/// The greatest velocity of the fluid, and of the solids on faces next to a cell with more than 1e-6 of them, m/s.
inline double greatest_beside_solids(const tfm::Model& model) {
  const core::Grid& grid = model.constants().grid;
  const tfm::Fields& fields = model.fields();
  const double* phi = fields.solids_fraction.data();
  double most = 0;
  core::for_each_row(grid, core::interior_faces(grid, 1), [&](core::Index begin, core::Index end) {
    for (core::Index f = begin; f < end; ++f) {
      most = std::max(most, std::abs(fields.fluid.velocity[1][std::size_t(f)]));
      if (std::max(phi[f], phi[f - grid.stride(1)]) > 1e-6)
        most = std::max(most, std::abs(fields.solids.velocity[0][1][std::size_t(f)]));
    }
  });
  return most;
}

}  // namespace polybed::scenes
