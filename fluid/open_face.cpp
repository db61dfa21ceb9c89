#include "fluid/open_face.hpp"

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/inlet.hpp"

namespace polybed::fluid {

using core::Index;

std::vector<OpenFace> open_faces(const core::Grid& grid, const core::Scene& scene) {
  std::vector<OpenFace> faces;
  if (scene.column.closed) return faces;
  for (const core::Discharge& discharge : scene.discharges) {
    if (!discharge.pressure || !is_side(discharge.at)) continue;
    const int axis = axis_of(discharge.at), side = side_of(discharge.at);
    const std::vector<double> share = face_shares(grid, discharge.from, discharge.to, discharge.at);
    const Index out = side == 0 ? -grid.stride(axis) : grid.stride(axis);
    const double outward = side == 0 ? -1 : 1, spacing = grid.spacing[std::size_t(axis)];
    std::size_t n = 0;
    for_each_boundary_row(grid, axis, side, [&](Index begin, Index end) {
      for (Index face = begin; face < end; ++face, ++n)
        if (const Index inside = side == 0 ? face : face - out; share[n] > 0)
          faces.push_back({discharge.at, face, inside, inside + out, face - out, share[n], outward, spacing,
                           outward * *discharge.pressure / spacing});
    });
  }
  return faces;
}

bool has_open_sides(const core::Scene& scene) {
  return std::any_of(scene.discharges.begin(), scene.discharges.end(), [](const auto& d) { return bool(d.pressure); });
}

double outflow(const core::Grid& grid, const std::vector<OpenFace>& faces, const core::FaceField& flux) {
  std::vector<double> terms;
  for (const OpenFace& f : faces) {
    const double open = grid.metric ? grid.metric->open[f.axis()][std::size_t(f.face)] : 1;
    terms.push_back(f.outward * open * grid.cell_volume() / f.spacing * flux[f.axis()][std::size_t(f.face)]);
  }
  return core::sum_of_ranks(grid, terms);
}

}  // namespace polybed::fluid
