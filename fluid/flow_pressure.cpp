// The pressure of the averaged fluid: the equation for its change, and its gradient.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "core/error.hpp"
#include "fluid/flow.hpp"
#include "fluid/pressure.hpp"

namespace polybed::fluid {

using core::Field;
using core::Index;

/// B for the solver, with the source; sets B itself to 0 at faces closed by a round wall.
const core::FaceField& Flow::open_mobility() {
  if (!grid_.metric) return mobility_;
  open_mobility_ = mobility_;
  core::weigh_faces(grid_, open_mobility_);
  core::weigh_cells(grid_, source_);
  core::hold_closed(grid_, mobility_);
  return open_mobility_;
}

/// Solves for the pressure change with which J satisfies the constraint: -dt div(B grad dp) [+ kappa dp/dt] = -div J.
void Flow::close_pressure(double t, double dt, FlowStep& step) {
  boundaries_.join(fluid_.flux, mobility_);
  core::divergence(grid_, fluid_.flux, source_);
  for (double& s : source_) s = -s / dt;
  if (compressible_) add_compression(dt);
  std::fill(change_.begin(), change_.end(), 0.0);
  const core::PoissonResult result = solver_.solve(core::spans(open_mobility()), shift_, source_, change_, tolerance_);
  step.iterations = result.iterations;
  step.residual = result.residual;
  if (!result.converged)
    throw core::NumericsError(
        fmt::format("t = {:.6g} s: the pressure of the fluid was not found, residual {:.2e}", t + dt, result.residual));
}

/// The pressure that pressures outside the column cause at once. Without it the particles next to a port would feel all
/// of its pressure over one cell until the first step.
void Flow::begin_pressure(double t) {
  const core::FaceField kept = fluid_.flux;
  for (Field& faces : fluid_.flux) std::fill(faces.begin(), faces.end(), 0.0);
  for_each_open_face(
      [&](const OpenFace& f, std::size_t a, std::size_t at) { fluid_.flux[a][at] = -mobility_[a][at] * f.rise; });
  constexpr double second = 1;  // their acceleration over a second
  FlowStep step;
  close_pressure(t, second, step);
  fluid_.pressure = change_;
  fluid_.flux = kept;
}

/// G of a pressure, on all faces.
void Flow::gradient_of(const Field& p, core::FaceField& out) {
  with_ghosts_ = p;
  set_outlet_pressure(grid_, boundaries_, with_ghosts_);
  for (Field& faces : out) std::fill(faces.begin(), faces.end(), 0.0);
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    Field& g = out[std::size_t(axis)];
    for_each_gradient_row(grid_, boundaries_.moving_faces(axis, true), axis, with_ghosts_,
                          [&](Index begin, Index end, auto gradient) {
                            for (Index c = begin; c < end; ++c) g[std::size_t(c)] = gradient(c);
                          });
    const Index s = grid_.stride(axis);
    if (grid_.cells[std::size_t(axis)] < 2) continue;
    for_each_boundary_row(grid_, axis, 0, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) g[std::size_t(c)] = g[std::size_t(c + s)];
    });
    if (axis == 1 && boundaries_.has_outlet()) continue;  // the outlet moves
    for_each_boundary_row(grid_, axis, 1, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) g[std::size_t(c)] = g[std::size_t(c - s)];
    });
  }
  if (grid_.metric) gradient_on_closed(out);
  for_each_open_face([&](const OpenFace& f, std::size_t a, std::size_t at) { out[a][at] = f.gradient(p); });
  boundaries_.join(out);
}

void Flow::set_gradient() {
  gradient_of(fluid_.pressure, gradient_);
  if (mean_gradient_ != 0)
    for (double& g : gradient_[1]) g += mean_gradient_;
  for_each_open_face([&](const OpenFace& f, std::size_t a, std::size_t at) { gradient_[a][at] += f.rise; });
}

/// The mean over the adjacent open faces along their axis, as on walls that follow the grid.
void Flow::gradient_on_closed(core::FaceField& out) {
  std::array<Ghosts, 3> ghosts{};
  for (std::size_t a = 0; a < 3; ++a) ghosts[a] = {Ghosts::Kind::joined, &out[a]};
  boundaries_.fill(std::span(ghosts).first(std::size_t(grid_.dimensions)));
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    const Field& open = grid_.metric->open[std::size_t(axis)];
    Field& g = out[std::size_t(axis)];
    const Index s = grid_.stride(axis);
    core::for_each_row(grid_, core::owned_faces(grid_, axis), [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f) {
        if (open[std::size_t(f)] > 0) continue;
        double sum = 0, count = 0;
        for (const Index next : {f - s, f + s}) {
          if (!(open[std::size_t(next)] > 0)) continue;
          sum += g[std::size_t(next)];
          ++count;
        }
        g[std::size_t(f)] = count > 0 ? sum / count : 0;
      }
    });
  }
}

}  // namespace polybed::fluid
