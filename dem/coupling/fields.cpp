// Fields from particles to the fluid and back: averaged with the kernel, and sent where they are needed.
#include <algorithm>

#include "core/numerics/blocks.hpp"
#include "core/numerics/metric.hpp"
#include "dem/coupling/coupling.hpp"
#include "dem/outflow.hpp"
#include "dem/parallel/exchange.hpp"
#include "fluid/convection.hpp"
#include "fluid/vorticity.hpp"

namespace polybed::dem {

using core::Field;

/// Does nothing without a diffusion kernel, or for an empty field.
void Coupling::smooth(core::FaceField& field) const {
  for (int axis = 0; axis < flow_.grid().dimensions && smoothing_.present(); ++axis)
    if (Field& component = field[std::size_t(axis)]; !component.empty()) smoothing_.smooth_faces(component, axis);
}

void Coupling::smooth_sums() {
  std::fill(phase_.voidage.begin(), phase_.voidage.end(), 1.0);
  for (Field& phi : fraction_) {
    smoothing_.smooth_cells(phi);
    for (std::size_t c = 0; c < phi.size(); ++c) phase_.voidage[c] -= phi[c];
  }
  for (core::FaceField* field : {&phase_.voidage_on, &phase_.flux, &phase_.impulse, &phase_.drag, &phase_.follow,
                                 &phase_.slide, &phase_.yield, &phase_.carry, &phase_.carry_flux})
    smooth(*field);
}

bool Coupling::has_sloping_walls() const { return flow_.grid().metric && flow_.grid().metric->tapered(); }

/// A sloping wall consists of steps of cells. On closed faces particles see the velocity of the adjacent open faces,
/// along the walls of a tapered column the vertical one; otherwise particles along the wall would feel half of the
/// flow.
void Coupling::slip(core::FaceField& velocity) const {
  const core::Grid& grid = flow_.grid();
  if (!has_sloping_walls()) return;
  for (int axis = 0; axis < grid.dimensions; ++axis) flow_.boundaries().join(velocity[1], axis);
  for (int axis = 0; grid.metric->walls && axis < grid.dimensions; axis += 2) {
    core::Field& aside = velocity[std::size_t(axis)];
    for (int across = 0; across < grid.dimensions; ++across) flow_.boundaries().join(aside, across);
    aside = fluid::slipping(grid, flow_.boundaries(), core::Field(aside), axis, grid.metric->steps_inside);
  }
  const core::Field stairs = velocity[1];
  velocity[1] = fluid::slipping(grid, flow_.boundaries(), stairs, 1, grid.metric->steps);
  const core::Taper& taper = grid.metric->taper;
  for (std::size_t n = 1; n < taper.size(); ++n) {
    const int level = int(std::lround(taper[n].first / grid.spacing[1])) - grid.before[1];
    if (taper[n - 1].first != taper[n].first || level < 0 || level > grid.cells[1]) continue;
    const core::Box ledge{{0, level, 0}, {grid.cells[0], level + 1, grid.cells[2]}};  // no flow along it
    core::for_each_row(grid, ledge, [&](core::Index begin, core::Index end) {
      std::copy(stairs.begin() + begin, stairs.begin() + end, velocity[1].begin() + begin);
    });
  }
}

/// Prepares the fields for the particles.
void Coupling::take_fields() {
  if (exchange_) {  // never with a diffusion kernel
    if (sides_.needs_vorticity()) find_vorticity(flow_.state().velocity, vorticity_);
    return fetch();
  }
  core::FaceField velocity = flow_.state().velocity, gradient = flow_.gradient();
  smooth(velocity);
  smooth(gradient);
  if (sides_.needs_vorticity()) find_vorticity(velocity, vorticity_);
  slip(velocity);
  gather_.take(fraction_, velocity, gradient);
  if (own_) own_->take(fraction_);
  if (sides_.needs_vorticity()) gather_.take_vorticity(vorticity_);
}

/// From the velocity that particles see, which is extended to the walls.
void Coupling::find_vorticity(core::FaceField velocity, std::array<Field, 3>& vorticity) const {
  flow_.boundaries().fill_velocity(velocity, fluid::WallSlip::no_slip);
  fluid::find_vorticity(flow_.grid(), velocity, vorticity);
}

Coupling::Vorticity Coupling::vorticity() const {
  core::FaceField velocity = flow_.state().velocity;
  smooth(velocity);
  std::array<Field, 3> own;
  find_vorticity(std::move(velocity), own);
  return {core::whole_column(flow_.grid()), {of_column(own[0]), of_column(own[1]), of_column(own[2])}};
}

void Coupling::send_ahead(Exchange& exchange, const Particles& particles) {
  loads_on_the_way_ = keep(particles, motion_.load);
  exchange.send_ahead(particles, loads_on_the_way_);
  sides_on_the_way_ = keep(particles, sides_.rows());
  exchange.send_ahead(particles, sides_on_the_way_);
}

void Coupling::settle_in(const Particles& particles) {
  recall(loads_on_the_way_, particles, motion_.load);
  relax(particles);
  recall(sides_on_the_way_, particles, sides_.rows());
  loads_on_the_way_ = {};
  sides_on_the_way_ = {};
  if (!exchange_) return;
  exchange_->choose(particles);
  fetch();
}

/// They are wholly beyond a face: they have not contributed to the sums since then, and the fluid does not change.
void Coupling::let_go(const Outflow& outflow, const Particles& particles) {
  SideRows& rows = sides_.rows();
  std::size_t staying = 0;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    if (outflow.takes(particles.place[i])) continue;
    if (i != staying) {
      motion_.load[staying] = motion_.load[i];
      std::copy_n(rows.of(i), rows.width, rows.of(staying));
    }
    ++staying;
  }
  motion_.load.resize(staying);
  rows.numbers.resize(staying * rows.width);
}

/// Fetches the fluid's fields for this rank's particles.
void Coupling::fetch() {
  core::FaceField slipping;
  if (has_sloping_walls()) slip(slipping = flow_.state().velocity);
  const core::FaceField& velocity = has_sloping_walls() ? slipping : flow_.state().velocity;
  std::vector<std::pair<const Field*, Field*>> fields;
  for (std::size_t j = 0; j < fraction_.size(); ++j) fields.push_back({&fraction_[j], &fraction_here_[j]});
  for (std::size_t a = 0; a < std::size_t(flow_.grid().dimensions); ++a) {
    fields.push_back({&velocity[a], &velocity_here_[a]});
    fields.push_back({&flow_.gradient()[a], &gradient_here_[a]});
  }
  for (std::size_t k = 0; k < 3 && sides_.needs_vorticity(); ++k) {
    vorticity_here_[k].resize(velocity_here_[0].size());
    fields.push_back({&vorticity_[k], &vorticity_here_[k]});
  }
  exchange_->fetch(fields);
  gather_.take(fraction_here_, velocity_here_, gradient_here_);
  if (own_) own_->take(fraction_here_);
  if (sides_.needs_vorticity()) gather_.take_vorticity(vorticity_here_);
}

/// Converts fields on the block's faces to the faces that this rank's particles touch.
void Coupling::here(std::initializer_list<core::FaceField*> fields) const {
  std::vector<std::pair<const Field*, Field*>> list;
  std::vector<core::FaceField> column(fields.size());
  std::size_t n = 0;
  for (core::FaceField* field : fields) {
    for (std::size_t a = 0; a < 3; ++a) {
      if ((*field)[a].empty()) continue;
      column[n][a].resize(velocity_here_[a].size());
      list.push_back({&(*field)[a], &column[n][a]});
    }
    ++n;
  }
  exchange_->fetch(list);
  n = 0;
  for (core::FaceField* field : fields) *field = std::move(column[n++]);
}

}  // namespace polybed::dem
