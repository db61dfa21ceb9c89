#include "fluid/inlet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/boundaries.hpp"

namespace polybed::fluid {

using core::Index;

/// The first point later than a time; a binary search, as tables can be long.
std::vector<std::pair<double, double>>::const_iterator Ramp::after(double t) const {
  return std::upper_bound(table_.begin(), table_.end(), t,
                          [](double time, const auto& point) { return time < point.first; });
}

double Ramp::velocity(double t) const {
  if (table_.empty()) return 0;
  if (t <= table_.front().first) return table_.front().second;
  const auto next = after(t);
  if (next == table_.end()) return table_.back().second;
  const auto& [t0, v0] = *std::prev(next);
  const auto& [t1, v1] = *next;
  return v0 + (v1 - v0) * (t - t0) / (t1 - t0);
}

double Ramp::rate(double t) const {
  const auto next = after(t);
  if (next == table_.begin() || next == table_.end()) return 0;
  return (next->second - std::prev(next)->second) / (next->first - std::prev(next)->first);
}

double Ramp::integral(double t) const {
  if (table_.empty() || !(t > 0)) return 0;
  const auto& [first, at_first] = table_.front();
  const auto& [last, at_last] = table_.back();
  double sum = at_first * std::clamp(first, 0.0, t) + at_last * std::max(0.0, t - std::max(last, 0.0));
  for (std::size_t n = 1; n < table_.size(); ++n) {
    const auto& [t0, v0] = table_[n - 1];
    const auto& [t1, v1] = table_[n];
    const double from = std::max(t0, 0.0), to = std::min(t1, t);
    if (!(from < to)) continue;
    const double slope = (v1 - v0) / (t1 - t0);
    sum += (to - from) * (v0 + slope * (0.5 * (from + to) - t0));
  }
  return sum;
}

double Ramp::greatest() const {
  double most = 0;
  for (const auto& [t, v] : table_) most = std::max(most, std::abs(v));
  return most;
}

namespace {

/// Share of the column's cell m along an axis that lies in [from, to]; for a ring, by its area.
double overlap(const core::Grid& grid, int axis, int m, double from, double to) {
  const double h = axis == 1 ? grid.height(m) : grid.spacing[std::size_t(axis)];
  const double low = std::max(from, grid.low(axis, m)), high = std::min(to, grid.low(axis, m + 1));
  const bool ring = axis == 0 && grid.metric && grid.metric->around_axis;
  if (constexpr double round_off = 1e-9; high - low < round_off * h) return 0;
  return (high - low) / h * (ring ? (low + high) / ((2 * m + 1) * h) : 1.0);
}

/// Factor for the shares of a part of a round column, so that with the open shares of its faces they have the part's
/// own area. 0 if the part contains only closed cells.
double scale_of_part(const core::Grid& grid, const std::vector<double>& from, const std::vector<double>& to,
                     int level) {
  if (!grid.metric || from.empty()) return 1;
  const bool rings = grid.metric->around_axis;
  if (rings ? !grid.metric->tapered() : from.size() < 2) return 1;
  const core::CrossSection& section = grid.metric->level(level);
  double open = 0;
  for (int k = 0; k < section.depth; ++k)
    for (int i = 0; i < section.width; ++i)
      open += overlap(grid, 0, i, from[0], to[0]) * (rings ? 1.0 : overlap(grid, 2, k, from[1], to[1])) *
              section.open_y[section.at(i, k)];
  const double area =
      rings ? std::numbers::pi * (to[0] * to[0] - from[0] * from[0]) : (to[0] - from[0]) * (to[1] - from[1]);
  const double own = area / (grid.spacing[0] * grid.spacing[2]);
  return open > 0 ? own / open : 0;
}

}  // namespace

std::vector<double> face_shares(const core::Grid& grid, const std::vector<double>& from, const std::vector<double>& to,
                                core::ColumnFace at) {
  std::vector<double> share;
  const double scale = is_side(at) ? 1 : scale_of_part(grid, from, to, side_of(at) * grid.column_cells(1));
  // A ring beside a cone has its part of the open height of its face.
  const bool beside_cones = is_side(at) && grid.metric && grid.metric->around_axis && grid.metric->tapered();
  const auto open_height = [&](int y) {
    const core::CrossSection& section = grid.metric->layer(y);
    const double open = section.face(0, section.width, 0);
    return open > 0 ? 0.5 * open : 1;
  };
  std::array<int, 3> cells = grid.cells, cell{};
  cells[std::size_t(axis_of(at))] = 1;
  for (cell[2] = 0; cell[2] < cells[2]; ++cell[2])
    for (cell[1] = 0; cell[1] < cells[1]; ++cell[1])
      for (cell[0] = 0; cell[0] < cells[0]; ++cell[0]) {
        double product = scale;
        for (std::size_t n = 0; n < from.size(); ++n) {
          const int axis = axis_along(at, grid.dimensions, n);
          const auto a = std::size_t(axis);
          product *= overlap(grid, axis, grid.before[a] + cell[a], from[n], to[n]);
          if (beside_cones) product /= open_height(grid.before[1] + cell[1]);
        }
        share.push_back(product);
      }
  return share;
}

Inlet::Inlet(const core::Grid& grid, const core::Scene& scene) : grid_(grid) {
  if (scene.column.closed) return;
  if (scene.inlet.at == core::ColumnEnd::top)
    above_ = core::open_faces_below(grid, 0) / core::open_faces_below(grid, grid.column_cells(1));
  const std::size_t faces = std::size_t(grid.cells[0]) * std::size_t(grid.cells[2]);
  parts_.push_back({Ramp(scene.inlet.superficial_velocity), std::vector<double>(faces, 1.0), 1, Carries::fluid});
  const auto add = [&](const auto& given, double inward, Carries carries) {
    if (is_side(given.at)) return add_port(given, inward, carries);
    Part part{Ramp(given.superficial_velocity, inward), face_shares(grid, given.from, given.to), 0, carries};
    for (std::size_t f = 0; f < faces; ++f) parts_.front().share[f] -= part.share[f];
    parts_.push_back(std::move(part));
  };
  for (const core::Jet& jet : scene.jets) add(jet, 1, Carries::fluid);
  for (const core::Feed& feed : scene.feeds) {
    if (is_side(feed.at)) add_port(feed, 1, Carries::solids);
    if (feed.at == core::ColumnFace::bottom)
      parts_.push_back({Ramp(feed.superficial_velocity), face_shares(grid, feed.from, feed.to), 0, Carries::solids});
  }
  lid_ = scene.column.outlet == core::Outlet::lid;
  for (const core::Feed& feed : scene.feeds)
    if (feed.at == core::ColumnFace::top && (lid_ || above_ != 0))
      fed_above_.push_back(
          {Ramp(feed.superficial_velocity, -1), face_shares(grid, feed.from, feed.to, feed.at), 0, Carries::solids});
  for (const core::Discharge& discharge : scene.discharges)
    if (!discharge.pressure) add(discharge, -1, scene.bed.held ? Carries::fluid : Carries::both);
  for (Part& part : parts_) part.mean_share = mean_over_bottom(part.share);
}

/// \param inward  1 for inflow, -1 for outflow
template <class Side>
void Inlet::add_port(const Side& part, double inward, Carries carries) {
  const int axis = axis_of(part.at);
  const double along = side_of(part.at) == 0 ? 1 : -1;
  Port port{part.at, Ramp(part.superficial_velocity, inward * along), 0, carries, {}, {}};
  const std::vector<double> share = face_shares(grid_, part.from, part.to, part.at);
  std::size_t f = 0;
  std::vector<double> area;  // in faces of the lowest layer
  for_each_boundary_row(grid_, axis, side_of(part.at), [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c, ++f) {
      if (share[f] == 0) continue;
      port.face.push_back(c);
      port.share.push_back(share[f]);
      area.push_back(share[f] * (grid_.metric ? grid_.metric->open[std::size_t(axis)][std::size_t(c)] : 1.0));
    }
  });
  const double faces = core::sum_of_ranks(grid_, area) * grid_.spacing[1] / grid_.spacing[std::size_t(axis)];
  port.mean_share = along * faces / core::open_faces_below(grid_, 0);
  ports_.push_back(std::move(port));
}

double Inlet::mean_over_bottom(const std::vector<double>& share) const {
  std::vector<double> here;
  if (grid_.ends(1, 0)) here = share;
  if (grid_.metric && !here.empty()) {
    std::size_t face = 0;
    for_each_boundary_row(grid_, 1, 0, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c, ++face) here[face] *= grid_.metric->open[1][std::size_t(c)];
    });
  }
  return core::sum_of_ranks(grid_, here) / core::open_faces_below(grid_, 0);
}

template <class Value>
void Inlet::set(core::FaceField& faces, Value&& value) const {
  std::size_t face = 0;
  core::Field& upward = faces[1];
  for_each_boundary_row(grid_, 1, 0, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c, ++face) {
      upward[std::size_t(c)] = 0;
      for (const Part& part : parts_) upward[std::size_t(c)] += part.share[face] * value(part.ramp);
    }
  });
  for_each_side_face([&](std::size_t axis, Index f, Index) { faces[axis][std::size_t(f)] = 0; });
  for (const Port& port : ports_)
    for (std::size_t n = 0; n < port.face.size(); ++n)
      faces[std::size_t(axis_of(port.at))][std::size_t(port.face[n])] += port.share[n] * value(port.ramp);
  if (lid_) {
    std::size_t above = 0;
    for_each_boundary_row(grid_, 1, 1, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c, ++above) {
        upward[std::size_t(c)] = 0;
        for (const Part& part : fed_above_) upward[std::size_t(c)] += part.share[above] * value(part.ramp);
      }
    });
  }
  if (above_ == 0) return;
  double even = 0;
  for (const Part& part : parts_) even += above_ * part.mean_share * value(part.ramp);
  for (const Port& port : ports_) even += above_ * port.mean_share * value(port.ramp);
  for_each_boundary_row(grid_, 1, 1,
                        [&](Index begin, Index end) { std::fill(upward.begin() + begin, upward.begin() + end, even); });
}

void Inlet::set_velocity(double t, core::FaceField& flux) const {
  set(flux, [t](const Ramp& ramp) { return ramp.velocity(t); });
}

void Inlet::take_solids_out(double t, const core::Field& voidage, core::FaceField& flux) const {
  const auto take = [&](const auto& part, std::size_t axis, double share, Index face, Index inside) {
    if (part.carries == Carries::fluid) return;
    const double solids = part.carries == Carries::solids ? 1 : 1 - voidage[std::size_t(inside)];
    flux[axis][std::size_t(face)] -= share * part.ramp.velocity(t) * solids;
  };
  std::size_t face = 0;
  for_each_boundary_row(grid_, 1, 0, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c, ++face)
      for (const Part& part : parts_) take(part, 1, part.share[face], c, c);
  });
  std::size_t above = 0;
  for_each_boundary_row(grid_, 1, 1, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c, ++above)
      for (const Part& part : fed_above_) take(part, 1, part.share[above], c, c - grid_.stride(1));
  });
  for (const Port& port : ports_) {
    const auto axis = std::size_t(axis_of(port.at));
    const Index inward = side_of(port.at) == 0 ? 0 : -grid_.stride(int(axis));
    for (std::size_t n = 0; n < port.face.size(); ++n)
      take(port, axis, port.share[n], port.face[n], port.face[n] + inward);
  }
}

void Inlet::set_rate(double t, core::FaceField& rate) const {
  set(rate, [t](const Ramp& ramp) { return ramp.rate(t); });
}

void Inlet::extend(core::FaceField& velocity) const {
  for (const Port& port : ports_)
    for (const Index face : port.face) extend_beyond(grid_, port.at, face, velocity[std::size_t(axis_of(port.at))]);
}

double Inlet::mean_velocity(double t) const {
  double sum = 0;
  for (const Part& part : parts_) sum += part.mean_share * part.ramp.velocity(t);
  return sum;
}

double Inlet::greatest_below() const {
  double most = 0;
  for (const Part& part : parts_) most = std::max(most, part.ramp.greatest());
  return most;
}

double Inlet::greatest() const {
  double most = greatest_below();
  for (const Port& port : ports_) most = std::max(most, port.ramp.greatest());
  return most;
}

std::vector<double> Inlet::breakpoints() const {
  std::vector<double> times;
  const auto add = [&](const auto& list) {
    for (const auto& one : list)
      if (one.ramp.table().size() > 1)
        for (const auto& point : one.ramp.table()) times.push_back(point.first);
  };
  add(parts_);
  add(ports_);
  add(fed_above_);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

bool Inlet::shuts() const {
  std::vector<double> times = breakpoints();
  times.push_back(0);
  return std::any_of(times.begin(), times.end(), [&](double t) {
    const auto rests = [t](const auto& one) { return one.ramp.velocity(t) == 0; };
    return std::all_of(parts_.begin(), parts_.end(), rests) && std::all_of(ports_.begin(), ports_.end(), rests);
  });
}

}  // namespace polybed::fluid
