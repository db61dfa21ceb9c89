#include "tfm/preconditioner.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "fluid/density.hpp"
#include "fluid/pressure.hpp"
#include "tfm/solids.hpp"
#include "tfm/solids_viscosity.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Field;
using core::Index;
using Kind = StateLayout::Entry::Kind;

namespace {

/// Multigrid cycles per application, where multigrid is used; two were found to pay.
constexpr int cycles = 2;

std::vector<Field> rows_of_fields(const core::Grid& grid, std::size_t rows) {
  return std::vector<Field>(rows, core::make_field(grid));
}

}  // namespace

Preconditioner::Preconditioner(const Constants& constants, const fluid::Boundaries& boundaries)
    : constants_(constants),
      boundaries_(boundaries),
      rows_(constants.species() + 1),
      moves_(constants.species(), true),
      slope_(core::make_field(constants.grid)),
      elastic_(slope_.size(), 1.0),
      fraction_residual_(constants.species(), core::make_field(constants.grid)),
      passed_residual_(constants.species(), constants.openings.make_passed()),
      pressure_residual_(core::make_field(constants.grid)),
      source_p_(core::make_field(constants.grid)),
      source_s_(core::make_field(constants.grid)),
      dp_(core::make_field(constants.grid)),
      work_(core::make_field(constants.grid)),
      flux_(core::make_face_field(constants.grid)),
      solver_(constants.grid) {
  for (int axis = 0; axis < constants.grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    inverse_[a].resize(constants.grid.padded_size() * rows_ * rows_);
    response_pressure_[a] = rows_of_fields(constants.grid, rows_);
    response_stress_[a] = rows_of_fields(constants.grid, rows_);
    fraction_[a] = rows_of_fields(constants.grid, constants.species());
    face_value_[a] = rows_of_fields(constants.grid, rows_);
  }
  for (core::FaceField& c : coupling_) c = core::make_face_field(constants.grid);
}

void Preconditioner::apply(const StateLayout& layout, std::span<const double> r, std::span<double> z) {
  unpack(layout, r);
  solve_faces();
  elliptic_sources();
  solver_.apply(source_p_, source_s_, dp_, work_, cycles);
  correct_faces();
  pack(layout, z);
}

void Preconditioner::unpack(const StateLayout& layout, std::span<const double> r) {
  for (const StateLayout::Entry& entry : layout.entries()) {
    const auto j = std::size_t(entry.species), a = std::size_t(entry.axis);
    switch (entry.kind) {
      case Kind::fraction:
        layout.unpack(entry, r, fraction_residual_[j]);
        break;
      case Kind::velocity:
        layout.unpack(entry, r, face_value_[a][j]);
        break;
      case Kind::flux:
        layout.unpack(entry, r, face_value_[a][rows_ - 1]);
        break;
      case Kind::temperature:
        layout.unpack(entry, r, temperature_residual_[j]);
        break;
      case Kind::passed:
        layout.unpack(entry, r, passed_residual_[j][a]);
        break;
      case Kind::pressure:
        layout.unpack(entry, r, pressure_residual_);
        break;
    }
  }
}

/// Step 1: v = S^-1 r; on held faces the row is c v = r.
void Preconditioner::solve_faces() {
  const core::Grid& grid = constants_.grid;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    for (int side = 0; side < 2; ++side)
      fluid::for_each_boundary_row(grid, axis, side, [&](Index begin, Index end) {
        for (Field& value : face_value_[a])
          for (Index face = begin; face < end; ++face) value[std::size_t(face)] /= c_;
      });
    core::for_each_row(grid, boundaries_.moving_faces(axis, true), [&](Index begin, Index end) {
      const Index height = begin / grid.stride(1) % grid.extent(1) - grid.ghosts(1);
      const bool held_above = axis == 1 && grid.ends(1, 1) && height == grid.cells[1];
      std::array<double, Preconditioner::most_rows> value{};
      for (Index face = begin; face < end; ++face) {
        const auto at = std::size_t(face);
        const double scale = held_above ? c_ : 1.0;  // the outlet's faces were divided by c above
        for (std::size_t k = 0; k < rows_; ++k) value[k] = scale * face_value_[a][k][at];
        const double* inverse = inverse_[a].data() + inverse_at(face);
        for (std::size_t k = 0; k < rows_; ++k) {
          double sum = 0;
          for (std::size_t m = 0; m < rows_; ++m) sum += inverse[k * rows_ + m] * value[m];
          face_value_[a][k][at] = sum;
        }
      }
    });
  }
}

/// out = div(sum_j phi_j v_j) for the species in [first, last).
void Preconditioner::divergence_of_solids(std::size_t first, std::size_t last, Field& out) {
  const core::Grid& grid = constants_.grid;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    Field& flux = flux_[a];
    std::fill(flux.begin(), flux.end(), 0.0);
    for (std::size_t j = first; j < last; ++j)
      core::for_each_row(grid, boundaries_.moving_faces(axis, false), [&](Index begin, Index end) {
        for (auto f = std::size_t(begin); f < std::size_t(end); ++f)
          flux[f] += fraction_[a][j][f] * face_value_[a][j][f];
      });
    for (const fluid::OpenFace& f : boundaries_.open_faces())  // solids move as the mixture there
      for (std::size_t j = first; j < last && f.axis() == a; ++j)
        flux[std::size_t(f.face)] +=
            fraction_[a][j][std::size_t(f.face)] * face_value_[a][rows_ - 1][std::size_t(f.face)];
    boundaries_.join(flux, axis);
  }
  core::divergence(grid, flux_, out);
}

/// Step 2: sources of the elliptic system.
void Preconditioner::elliptic_sources() {
  const core::Grid& grid = constants_.grid;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    flux_[std::size_t(axis)] = face_value_[std::size_t(axis)][rows_ - 1];
    boundaries_.join(flux_[std::size_t(axis)], axis);
  }
  core::divergence(grid, flux_, source_p_);
  divergence_of_solids(0, constants_.species(), source_s_);
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      source_p_[c] = pressure_residual_[c] - source_p_[c];
      source_s_[c] = -source_s_[c];
      for (const Field& residual : fraction_residual_) source_s_[c] += elastic_[c] * residual[c];
    }
  });
  core::weigh_cells(grid, source_p_);
  core::weigh_cells(grid, source_s_);
}

/// Step 3: v -= R_q grad dp + R_g grad q, q in the work space.
void Preconditioner::correct_faces() {
  const core::Grid& grid = constants_.grid;
  fluid::set_outlet_pressure(grid, boundaries_, dp_);
  boundaries_.open() ? fluid::set_outlet_pressure(grid, boundaries_, work_) : boundaries_.fill_cells(work_);
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    for (std::size_t k = 0; k < rows_; ++k) {
      double* v = face_value_[a][k].data();
      const double *to_pressure = response_pressure_[a][k].data(), *to_stress = response_stress_[a][k].data();
      fluid::for_each_gradient_row(grid, boundaries_.moving_faces(axis, true), axis, dp_,
                                   [&](Index begin, Index end, auto gradient) {
                                     for (Index f = begin; f < end; ++f) v[f] -= to_pressure[f] * gradient(f);
                                   });
      fluid::for_each_gradient_row(grid, boundaries_.moving_faces(axis, false), axis, work_,
                                   [&](Index begin, Index end, auto gradient) {
                                     for (Index f = begin; f < end; ++f) v[f] -= to_stress[f] * gradient(f);
                                   });
    }
  }
  for (const fluid::OpenFace& f : boundaries_.open_faces()) {
    const auto a = f.axis(), at = std::size_t(f.face);
    face_value_[a][rows_ - 1][at] -= response_pressure_[a][rows_ - 1][at] * f.gradient(dp_);
  }
}

/// Step 4, and copies everything to its place.
void Preconditioner::pack(const StateLayout& layout, std::span<double> z) {
  for (const StateLayout::Entry& entry : layout.entries()) {
    const auto j = std::size_t(entry.species), a = std::size_t(entry.axis);
    switch (entry.kind) {
      case Kind::fraction:
        divergence_of_solids(j, j + 1, work_);
        for (std::size_t c = 0; c < work_.size(); ++c) work_[c] = (fraction_residual_[j][c] - work_[c]) / c_;
        layout.pack(entry, work_, z);
        break;
      case Kind::velocity:
        layout.pack(entry, face_value_[a][j], z);
        break;
      case Kind::flux:
        layout.pack(entry, face_value_[a][rows_ - 1], z);
        break;
      case Kind::temperature:
        for (std::size_t c = 0; c < work_.size(); ++c) work_[c] = temperature_residual_[j][c] / temperature_row_[j][c];
        layout.pack(entry, work_, z);
        break;
      case Kind::passed:
        divergence_of_solids(j, j + 1, work_);  // leaves the flux of the correction in flux_
        for (std::size_t f = 0; f < work_.size(); ++f) work_[f] = (passed_residual_[j][a][f] + flux_[a][f]) / c_;
        layout.pack(entry, work_, z);
        break;
      case Kind::pressure:
        // Unchanged in closed cells: the solver's values there would grow from step to step.
        for (std::size_t c = 0; constants_.grid.metric && c < dp_.size(); ++c)
          if (!(constants_.grid.metric->volume[c] > 0)) dp_[c] = 0;
        layout.pack(entry, dp_, z);
        break;
    }
  }
}

}  // namespace polybed::tfm
