#include "fluid/openings.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/metric.hpp"
#include "core/numerics/operators.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/boundaries.hpp"

namespace polybed::fluid {

using core::Field;
using core::Index;

Openings::Openings(const core::Grid& grid, const core::Scene& scene) : grid_(grid) {
  using core::ColumnFace;
  if (scene.column.closed) return;
  open_ = scene.column.outlet == core::Outlet::open;
  open_faces_ = open_faces(grid, scene);
  for (const core::Feed& feed : scene.feeds) greatest_ = std::max(greatest_, std::abs(feed.velocity));
  for (const core::Discharge& discharge : scene.discharges)
    if (!discharge.pressure) add_discharge(discharge);
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    for (const ColumnFace at : {ColumnFace::bottom, ColumnFace::top, ColumnFace::left, ColumnFace::right,
                                ColumnFace::front, ColumnFace::back}) {
      add_gate(scene, j, at);
      const bool fed = !gates_.empty() && gates_.back().species == j && gates_.back().at == at;
      const bool leaves = std::any_of(scene.discharges.begin(), scene.discharges.end(),
                                      [&](const core::Discharge& d) { return d.at == at; });
      if (fed || leaves || (open_ && at == ColumnFace::top)) passages_.push_back({j, at});
    }
}

/// Adds to a gate the block's faces for which covered(n, face) is true, where n counts the faces of its end or side.
template <class Covered>
void Openings::cover(Gate& gate, Covered&& covered) const {
  std::vector<Part> whole(gate.parts.size());
  for (std::size_t p = 0; p < whole.size(); ++p) std::swap(whole[p].share, gate.parts[p].share);
  std::size_t n = 0;
  for_each_boundary_row(grid_, axis_of(gate.at), side_of(gate.at), [&](Index begin, Index end) {
    for (Index face = begin; face < end; ++face, ++n) {
      if (!covered(n)) continue;
      gate.face.push_back(face);
      for (std::size_t p = 0; p < whole.size(); ++p) gate.parts[p].share.push_back(whole[p].share[n]);
    }
  });
}

/// Adds all feeds of one species at one end or side. A face in two of them has the mean of their velocities.
void Openings::add_gate(const core::Scene& scene, std::size_t species, core::ColumnFace at) {
  Gate gate{species, at, {}, {}, {}};
  const double along = side_of(at) == 0 ? 1 : -1;
  std::vector<double> covered, velocity;
  for (const core::Feed& feed : scene.feeds) {
    if (feed.species != scene.species[species].name || feed.at != at) continue;
    Part part{Ramp(feed.superficial_velocity, along), face_shares(grid_, feed.from, feed.to, at)};
    covered.resize(part.share.size());
    velocity.resize(part.share.size());
    for (std::size_t f = 0; f < part.share.size(); ++f) {
      covered[f] += part.share[f];
      velocity[f] += part.share[f] * along * feed.velocity;
    }
    gate.parts.push_back(std::move(part));
  }
  if (gate.parts.empty()) return;
  cover(gate, [&](std::size_t f) {
    if (covered[f] == 0) return false;
    gate.velocity.push_back(velocity[f] / covered[f]);
    return true;
  });
  gates_.push_back(std::move(gate));
}

void Openings::add_discharge(const core::Discharge& discharge) {
  const double outward = side_of(discharge.at) == 0 ? -1 : 1;
  Gate gate{0, discharge.at, {}, {}, {}};
  gate.parts.push_back(
      {Ramp(discharge.superficial_velocity, outward), face_shares(grid_, discharge.from, discharge.to, discharge.at)});
  const std::vector<double> share = gate.parts.front().share;
  cover(gate, [&](std::size_t f) { return share[f] != 0; });
  discharges_.push_back(std::move(gate));
}

double Openings::Gate::flux(std::size_t n, double t) const {
  double sum = 0;
  for (const Part& part : parts) sum += part.share[n] * part.ramp.velocity(t);
  return sum;
}

double Openings::Gate::flux_rate(std::size_t n, double t) const {
  double sum = 0;
  for (const Part& part : parts) sum += part.share[n] * part.ramp.rate(t);
  return sum;
}

std::vector<double> Openings::breakpoints() const {
  std::vector<double> times;
  for (const Gate& gate : gates_)
    for (const Part& part : gate.parts)
      if (part.ramp.table().size() > 1)
        for (const auto& point : part.ramp.table()) times.push_back(point.first);
  return times;
}

template <class Body>
void Openings::for_each_face(const std::vector<Gate>& gates, Body&& body) const {
  for (const Gate& gate : gates) {
    const Index s = grid_.stride(axis_of(gate.at));
    for (std::size_t n = 0; n < gate.face.size(); ++n) {
      const Index above = gate.face[n], below = above - s;
      if (side_of(gate.at) == 0)
        body(gate, n, std::size_t(above), std::size_t(above), std::size_t(below));
      else
        body(gate, n, std::size_t(above), std::size_t(below), std::size_t(above));
    }
  }
}

core::FaceField Openings::make_passed() const {
  core::FaceField passed;
  for (const Passage& passage : passages_) passed[std::size_t(axis_of(passage.at))] = core::make_field(grid_);
  return passed;
}

bool Openings::in_sides() const {
  return std::any_of(passages_.begin(), passages_.end(), [](const Passage& p) { return is_side(p.at); });
}

void Openings::set_velocities(double t, Interphase& solids) const {
  for_each_face(gates_, [&](const Gate& gate, std::size_t n, std::size_t face, std::size_t, std::size_t) {
    solids.velocity[gate.species][gate.axis()][face] = gate.velocity[n];
  });
  for (core::FaceField& velocity : solids.velocity) {
    for_each_face(discharges_, [&](const Gate& gate, std::size_t, std::size_t face, std::size_t, std::size_t) {
      velocity[gate.axis()][face] = 0;
    });
    for_each_face(discharges_, [&](const Gate& gate, std::size_t n, std::size_t face, std::size_t, std::size_t) {
      velocity[gate.axis()][face] += gate.flux(n, t);
    });
  }
}

void Openings::follow(const core::FaceField& flux, Interphase& solids) const {
  for (core::FaceField& velocity : solids.velocity)
    for (const OpenFace& f : open_faces_) velocity[f.axis()][std::size_t(f.face)] = flux[f.axis()][std::size_t(f.face)];
}

void Openings::set_ghosts(double t, Interphase& solids) const {
  for_each_face(gates_, [&](const Gate& gate, std::size_t n, std::size_t face, std::size_t inside, std::size_t beyond) {
    Field& phi = solids.fraction[gate.species];
    phi[beyond] = 2 * gate.flux(n, t) / gate.velocity[n] - phi[inside];
    if (is_side(gate.at)) extend_beyond(grid_, gate.at, Index(face), solids.velocity[gate.species][gate.axis()]);
  });
  for_each_face(discharges_, [&](const Gate& gate, std::size_t, std::size_t face, std::size_t, std::size_t) {
    for (core::FaceField& velocity : solids.velocity) extend_beyond(grid_, gate.at, Index(face), velocity[gate.axis()]);
  });
  for (const OpenFace& f : open_faces_)
    for (core::FaceField& velocity : solids.velocity) extend_beyond(grid_, f.at, f.face, velocity[f.axis()]);
}

void Openings::set_rate_ghosts(double t, std::size_t j, Interphase& solids) const {
  for_each_face(gates_, [&](const Gate& gate, std::size_t n, std::size_t, std::size_t inside, std::size_t beyond) {
    if (gate.species != j) return;
    Field& rate = solids.fraction_rate[j];
    rate[beyond] = 2 * gate.flux_rate(n, t) / gate.velocity[n] - rate[inside];
  });
}

void Openings::cross(double t, std::size_t j, Interphase& solids, core::FaceField& flux) const {
  const int top = side_of(core::ColumnFace::top);
  for (const int side : {0, top})
    for_each_boundary_row(grid_, 1, side, [&](Index begin, Index end) {
      std::fill(flux[1].begin() + begin, flux[1].begin() + end, 0.0);
    });
  const auto clear = [&](const Gate& gate, std::size_t, std::size_t face, std::size_t, std::size_t) {
    if (is_side(gate.at)) flux[gate.axis()][face] = 0;
  };
  for_each_face(gates_, clear);
  for_each_face(discharges_, clear);
  const double* phi = solids.fraction[j].data();
  for (const OpenFace& f : open_faces_) {
    const double u = solids.velocity[j][f.axis()][std::size_t(f.face)];
    flux[f.axis()][std::size_t(f.face)] = f.leaving(u) * phi[f.inside];
  }
  if (open_) {
    const Index s = grid_.stride(1);
    const double* u = solids.velocity[j][1].data();
    for_each_boundary_row(grid_, 1, top, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) flux[1][std::size_t(c)] = std::max(u[c], 0.0) * phi[c - s];
    });
  }
  for_each_face(gates_, [&](const Gate& gate, std::size_t n, std::size_t face, std::size_t, std::size_t) {
    if (gate.species == j) flux[gate.axis()][face] = gate.flux(n, t);
  });
  for_each_face(discharges_, [&](const Gate& gate, std::size_t n, std::size_t face, std::size_t inside, std::size_t) {
    flux[gate.axis()][face] += gate.flux(n, t) * phi[inside];
  });
  for (const Passage& passage : passages_) {
    if (passage.species != j) continue;
    const auto a = std::size_t(axis_of(passage.at));
    for_each_boundary_row(grid_, int(a), side_of(passage.at), [&](Index begin, Index end) {
      std::copy(flux[a].begin() + begin, flux[a].begin() + end, solids.passed_rate[j][a].begin() + begin);
    });
  }
}

void Openings::hold(std::vector<core::FaceField>& acceleration) const {
  for_each_face(gates_, [&](const Gate& gate, std::size_t, std::size_t face, std::size_t, std::size_t) {
    acceleration[gate.species][gate.axis()][face] = 0;
  });
}

void Openings::hold(const Interphase& solids, core::FaceField& mobility) const {
  if (!open_) return;
  for_each_face(gates_, [&](const Gate& gate, std::size_t, std::size_t face, std::size_t inside, std::size_t beyond) {
    const Field& phi = solids.fraction[gate.species];
    if (gate.at == core::ColumnFace::top && solids.carry_pressure)
      mobility[1][face] -= 0.5 * (phi[inside] + phi[beyond]) / solids.density[gate.species];
  });
}

bool Openings::holds(std::size_t j, int axis, Index face) const {
  return std::any_of(gates_.begin(), gates_.end(), [&](const Gate& gate) {
    return gate.species == j && axis_of(gate.at) == axis &&
           std::binary_search(gate.face.begin(), gate.face.end(), face);
  });
}

std::vector<Passed> Openings::passed(const Interphase& solids) const {
  std::vector<Passed> result(solids.species());
  if (!present()) return result;
  for (const Passage& passage : passages_) {
    const int axis = axis_of(passage.at);
    const auto a = std::size_t(axis);
    const double area = a == 1 ? grid_.spacing[0] * grid_.spacing[2] : grid_.cell_volume() / grid_.spacing[a];
    const double inward = side_of(passage.at) == 0 ? 1 : -1;
    const double* open = grid_.metric ? grid_.metric->open[a].data() : nullptr;
    for_each_boundary_row(grid_, axis, side_of(passage.at), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) {
        const double along = (open ? open[c] : 1.0) * area * solids.passed[passage.species][a][std::size_t(c)];
        Passed& sum = result[passage.species];
        if (holds(passage.species, axis, c))
          sum.in += inward * along;
        else
          sum.out -= inward * along;
      }
    });
  }
  std::vector<double> sums;
  for (const Passed& p : result) sums.insert(sums.end(), {p.in, p.out});
  core::add_over_ranks(grid_, sums);
  for (std::size_t j = 0; j < result.size(); ++j) result[j] = {sums[2 * j], sums[2 * j + 1]};
  return result;
}

}  // namespace polybed::fluid
