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
  if (scene.column.closed) return;
  open_ = scene.column.outlet == core::Outlet::open;
  for (const core::Feed& feed : scene.feeds) greatest_ = std::max(greatest_, std::abs(feed.velocity));
  for (std::size_t j = 0; j < scene.species.size(); ++j) {
    for (const Side side : {bottom, top}) add_gate(scene, j, side);
    const auto fed = [&](Side side) {
      return std::any_of(gates_.begin(), gates_.end(), [&](const Gate& g) { return g.species == j && g.side == side; });
    };
    if (fed(bottom)) passages_.push_back({j, bottom});
    if (fed(top) || open_) passages_.push_back({j, top});
  }
}

/// All feeds of one species at one end. On a face that two of them share the velocity is the mean of theirs.
void Openings::add_gate(const core::Scene& scene, std::size_t species, Side side) {
  Gate gate{species, side, {}, {}, {}};
  const std::size_t faces = std::size_t(grid_.cells[0]) * std::size_t(grid_.cells[2]);
  const double upward = side == bottom ? 1 : -1;
  std::vector<double> covered(faces, 0.0), velocity(faces, 0.0);
  std::vector<Gate::Part> parts;
  for (const core::Feed& feed : scene.feeds) {
    if (feed.species != scene.species[species].name || (feed.at == core::ColumnEnd::top) != (side == top)) continue;
    Gate::Part part{Ramp(feed.superficial_velocity, upward), face_shares(grid_, feed.from, feed.to, side == top)};
    for (std::size_t f = 0; f < faces; ++f) {
      covered[f] += part.share[f];
      velocity[f] += part.share[f] * upward * feed.velocity;
    }
    parts.push_back(std::move(part));
  }
  if (parts.empty()) return;
  for (const Gate::Part& part : parts) gate.parts.push_back({part.ramp, {}});
  std::size_t f = 0;
  for_each_boundary_row(grid_, 1, side, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c, ++f) {
      if (covered[f] == 0) continue;
      gate.face.push_back(c);
      gate.velocity.push_back(velocity[f] / covered[f]);
      for (std::size_t p = 0; p < parts.size(); ++p) gate.parts[p].share.push_back(parts[p].share[f]);
    }
  });
  gates_.push_back(std::move(gate));
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
    for (const Gate::Part& part : gate.parts)
      if (part.ramp.table().size() > 1)
        for (const auto& point : part.ramp.table()) times.push_back(point.first);
  return times;
}

template <class Body>
void Openings::for_each_fed_face(Body&& body) const {
  const Index s = grid_.stride(1);
  for (const Gate& gate : gates_)
    for (std::size_t n = 0; n < gate.face.size(); ++n) {
      const Index above = gate.face[n], below = above - s;
      if (gate.side == bottom)
        body(gate, n, std::size_t(above), std::size_t(above), std::size_t(below));
      else
        body(gate, n, std::size_t(above), std::size_t(below), std::size_t(above));
    }
}

void Openings::set_velocities(Interphase& solids) const {
  for_each_fed_face([&](const Gate& gate, std::size_t n, std::size_t face, std::size_t, std::size_t) {
    solids.velocity[gate.species][1][face] = gate.velocity[n];
  });
}

void Openings::set_ghosts(double t, Interphase& solids) const {
  for_each_fed_face([&](const Gate& gate, std::size_t n, std::size_t, std::size_t inside, std::size_t beyond) {
    Field& phi = solids.fraction[gate.species];
    phi[beyond] = 2 * gate.flux(n, t) / gate.velocity[n] - phi[inside];
  });
}

void Openings::set_rate_ghosts(double t, std::size_t j, Interphase& solids) const {
  for_each_fed_face([&](const Gate& gate, std::size_t n, std::size_t, std::size_t inside, std::size_t beyond) {
    if (gate.species != j) return;
    Field& rate = solids.fraction_rate[j];
    rate[beyond] = 2 * gate.flux_rate(n, t) / gate.velocity[n] - rate[inside];
  });
}

void Openings::cross(double t, std::size_t j, Interphase& solids, Field& flux) const {
  for (const int side : {bottom, top})
    for_each_boundary_row(grid_, 1, side,
                          [&](Index begin, Index end) { std::fill(flux.begin() + begin, flux.begin() + end, 0.0); });
  if (open_) {
    const Index s = grid_.stride(1);
    const double *phi = solids.fraction[j].data(), *u = solids.velocity[j][1].data();
    for_each_boundary_row(grid_, 1, top, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) flux[std::size_t(c)] = std::max(u[c], 0.0) * phi[c - s];
    });
  }
  for_each_fed_face([&](const Gate& gate, std::size_t n, std::size_t face, std::size_t, std::size_t) {
    if (gate.species == j) flux[face] = gate.flux(n, t);
  });
  for (const Passage& passage : passages_)
    if (passage.species == j)
      for_each_boundary_row(grid_, 1, passage.side, [&](Index begin, Index end) {
        std::copy(flux.begin() + begin, flux.begin() + end, solids.passed_rate[j].begin() + begin);
      });
}

void Openings::hold(std::vector<core::FaceField>& acceleration) const {
  for_each_fed_face([&](const Gate& gate, std::size_t, std::size_t face, std::size_t, std::size_t) {
    acceleration[gate.species][1][face] = 0;
  });
}

void Openings::hold(const Interphase& solids, core::FaceField& mobility) const {
  if (!open_) return;
  for_each_fed_face([&](const Gate& gate, std::size_t, std::size_t face, std::size_t inside, std::size_t beyond) {
    const Field& phi = solids.fraction[gate.species];
    if (gate.side == top && solids.carry_pressure)
      mobility[1][face] -= 0.5 * (phi[inside] + phi[beyond]) / solids.density[gate.species];
  });
}

bool Openings::holds(std::size_t j, Index face) const {
  return std::any_of(gates_.begin(), gates_.end(), [&](const Gate& gate) {
    return gate.species == j && std::binary_search(gate.face.begin(), gate.face.end(), face);
  });
}

std::vector<Passed> Openings::passed(const Interphase& solids) const {
  std::vector<Passed> result(solids.species());
  if (!present()) return result;
  const double area = grid_.spacing[0] * grid_.spacing[2];
  const double* open = grid_.metric ? grid_.metric->open[1].data() : nullptr;
  for (const Passage& passage : passages_)
    for_each_boundary_row(grid_, 1, passage.side, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) {
        const double upward = (open ? open[c] : 1.0) * area * solids.passed[passage.species][std::size_t(c)];
        Passed& sum = result[passage.species];
        if (passage.side == bottom)
          sum.in += upward;
        else if (holds(passage.species, c))
          sum.in -= upward;
        else
          sum.out += upward;
      }
    });
  std::vector<double> sums;
  for (const Passed& p : result) sums.insert(sums.end(), {p.in, p.out});
  core::add_over_ranks(grid_, sums);
  for (std::size_t j = 0; j < result.size(); ++j) result[j] = {sums[2 * j], sums[2 * j + 1]};
  return result;
}

}  // namespace polybed::fluid
