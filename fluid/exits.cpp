#include "fluid/exits.hpp"

#include <map>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/boundaries.hpp"

namespace polybed::fluid {

using core::Index;

namespace {

/// For the fluid, or without one for the solids.
bool has_open_top(const core::Scene& scene) {
  if (!scene.fluid.present()) return scene.column.outlet == core::Outlet::open;
  return ends_of(scene) == Ends::outlet && scene.column.ends != core::Boundary::periodic;
}

double whole_face(const core::Grid& grid, std::size_t axis) {
  return axis == 1 ? grid.spacing[0] * grid.spacing[2] : grid.cell_volume() / grid.spacing[axis];
}

}  // namespace

std::vector<std::string> names_of_exits(const core::Scene& scene) {
  std::vector<std::string> names;
  if (scene.column.closed) return names;
  for (std::size_t n = 0; n < scene.discharges.size(); ++n) names.push_back("discharge" + std::to_string(n + 1));
  if (has_open_top(scene)) names.emplace_back("top");
  if (names.size() < 2) names.clear();
  return names;
}

Exits::Exits(const core::Grid& grid, const core::Scene& scene) : grid_(grid), names_(names_of_exits(scene)) {
  if (names_.empty()) return;
  for (const core::Discharge& d : scene.discharges)
    add(d.at, Ramp(d.superficial_velocity), face_shares(grid, d.from, d.to, d.at));
  if (has_open_top(scene)) add(core::ColumnFace::top, Ramp(), face_shares(grid, {}, {}, core::ColumnFace::top));
  // A face in two discharges belongs to both by their areas.
  std::map<std::pair<std::size_t, Index>, double> all;
  for (const Exit& exit : exits_)
    for (std::size_t n = 0; n < exit.face.size(); ++n)
      all[{std::size_t(axis_of(exit.at)), exit.face[n]}] += exit.open[n];
  for (Exit& exit : exits_)
    for (std::size_t n = 0; n < exit.face.size(); ++n)
      exit.part.push_back(exit.open[n] / all[{std::size_t(axis_of(exit.at)), exit.face[n]}]);
}

void Exits::add(core::ColumnFace at, Ramp given, const std::vector<double>& share) {
  const auto axis = std::size_t(axis_of(at));
  Exit exit{at, std::move(given), 0, {}, {}, {}};
  std::size_t n = 0;
  for_each_boundary_row(grid_, int(axis), side_of(at), [&](Index begin, Index end) {
    for (Index face = begin; face < end; ++face, ++n) {
      const double alpha = grid_.metric ? grid_.metric->open[axis][std::size_t(face)] : 1;
      if (!(share[n] * alpha > 0)) continue;
      exit.face.push_back(face);
      exit.open.push_back(share[n] * alpha * whole_face(grid_, axis));
    }
  });
  exit.area = core::sum_of_ranks(grid_, exit.open);
  exits_.push_back(std::move(exit));
}

std::vector<double> Exits::flows(double t, const core::FaceField& flux) const {
  std::vector<double> sums;
  for (const Exit& exit : exits_) {
    const auto axis = std::size_t(axis_of(exit.at));
    const double outward = side_of(exit.at) == 0 ? -1 : 1;
    std::vector<double> terms;
    for (std::size_t n = 0; exit.given.table().empty() && n < exit.face.size(); ++n)
      terms.push_back(outward * flux[axis][std::size_t(exit.face[n])] * whole_face(grid_, axis) *
                      (grid_.metric ? grid_.metric->open[axis][std::size_t(exit.face[n])] : 1));
    sums.push_back(exit.given.table().empty() ? core::sum_of_ranks(grid_, terms) : exit.given.velocity(t) * exit.area);
  }
  return sums;
}

std::vector<std::vector<double>> Exits::passed(const Openings& openings, const Interphase& solids) const {
  std::vector<std::vector<double>> left;
  for (const Exit& exit : exits_) {
    const auto axis = std::size_t(axis_of(exit.at));
    const double outward = side_of(exit.at) == 0 ? -1 : 1;
    left.emplace_back(solids.species(), 0.0);
    for (const Openings::Passage& passage : openings.passages()) {
      if (passage.at != exit.at) continue;
      std::vector<double> terms;
      for (std::size_t n = 0; n < exit.face.size(); ++n) {
        const Index face = exit.face[n];
        if (openings.holds(passage.species, int(axis), face)) continue;  // what is fed there
        terms.push_back(outward * exit.part[n] * whole_face(grid_, axis) *
                        (grid_.metric ? grid_.metric->open[axis][std::size_t(face)] : 1) *
                        solids.passed[passage.species][axis][std::size_t(face)]);
      }
      left.back()[passage.species] = core::sum_of_ranks(grid_, terms);
    }
  }
  return left;
}

}  // namespace polybed::fluid
