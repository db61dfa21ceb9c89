#include "tfm/preconditioner.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "core/operators.hpp"
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

constexpr int most_rows = 16;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most_rows, most_rows>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_rows, 1>;

/// Cycles of multigrid per application; two were found to pay.
constexpr int cycles = 2;

std::vector<Field> rows_of_fields(const core::Grid& grid, std::size_t rows) {
  return std::vector<Field>(rows, core::make_field(grid));
}

}  // namespace

Preconditioner::Preconditioner(const Constants& constants, const fluid::Boundaries& boundaries)
    : constants_(constants),
      boundaries_(boundaries),
      rows_(constants.species() + 1),
      slope_(core::make_field(constants.grid)),
      fraction_residual_(constants.species(), core::make_field(constants.grid)),
      pressure_residual_(core::make_field(constants.grid)),
      source_p_(core::make_field(constants.grid)),
      source_s_(core::make_field(constants.grid)),
      dp_(core::make_field(constants.grid)),
      s_(core::make_field(constants.grid)),
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

bool Preconditioner::setup(const Fields& fields, double c) {
  c_ = c;
  const core::Grid& grid = constants_.grid;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    core::Box held_solids = boundaries_.moving_faces(axis, true);
    const core::Box moving = boundaries_.moving_faces(axis, false);
    held_solids.lo[std::size_t(axis)] = moving.hi[std::size_t(axis)];
    fluid::with_density(fields.fluid, constants_.fluid.density, [&](const auto& density) {
      build(fields, density, axis, moving, true);
      build(fields, density, axis, held_solids, false);
    });
  }
  for (core::FaceField& coefficient : coupling_) boundaries_.join(coefficient);
  temperature_row_ = temperature_residual_ = fields.granular.decay;
  for (Field& row : temperature_row_)
    for (double& rate : row) rate += c;
  if (fields.stress.present())
    for (std::size_t cell = 0; cell < slope_.size(); ++cell)
      slope_[cell] = fields.stress.slope[cell] + fields.stress.damping[cell] * c;
  boundaries_.fill_cells(slope_);
  if (fields.fluid.compression.present()) {
    diagonal_ = fields.fluid.compression.kappa;
    for (double& d : diagonal_) d *= c;
  }
  const auto faces = [](const core::FaceField& f) { return std::array<std::span<const double>, 3>{f[0], f[1], f[2]}; };
  return solver_.setup(faces(coupling_[0]), faces(coupling_[1]), faces(coupling_[2]), faces(coupling_[3]), slope_,
                       diagonal_, c);
}

template <class Density>
void Preconditioner::build(const Fields& fields, const Density& density, int axis, const core::Box& box,
                           bool solids_move) {
  const Index s = constants_.grid.stride(axis);
  core::for_each_row(constants_.grid, box, [&](Index begin, Index end) {
    for (Index face = begin; face < end; ++face) {
      for (std::size_t j = 0; j < constants_.species(); ++j)
        fraction_[std::size_t(axis)][j][std::size_t(face)] =
            solids_move ? face_mean(fields.solids.fraction[j].data(), face, s) : 0.0;
      invert_face(fields, density.on_face(face, s), axis, face);
      respond(fields, axis, face, solids_move);
    }
  });
}

/// Diagonal of -div(grad U + grad U^T - 2/3 div U I) for the velocity along an axis, 1/m2. The viscosity of the solids
/// enters S by its diagonal, as if the neighbours stood still.
double Preconditioner::viscous_diagonal(int axis) const {
  double sum = 0;
  for (int d = 0; d < constants_.grid.dimensions; ++d) {
    const double h = constants_.grid.spacing[std::size_t(d)];
    sum += (d == axis ? 8.0 / 3 : 2.0) / (h * h);
  }
  return sum;
}

/// S of one face, inverted into its place.
void Preconditioner::invert_face(const Fields& fields, double fluid_density, int axis, Index face) {
  const auto a = std::size_t(axis), at = std::size_t(face);
  const Index stride = constants_.grid.stride(axis);
  const std::size_t n = constants_.species();
  const double eps = std::max(face_mean(fields.fluid.voidage.data(), face, stride), fluid::voidage_floor);
  const auto row = [](std::size_t k) { return Eigen::Index(k); };
  Matrix system = Matrix::Identity(row(rows_), row(rows_)) * c_;
  Vector fluid_velocity = Vector::Zero(row(rows_));  // dU_f as a combination of the unknowns
  for (std::size_t j = 0; j < n; ++j) fluid_velocity[row(j)] = -fraction_[a][j][at] / eps;
  fluid_velocity[row(n)] = 1 / eps;
  for (std::size_t j = 0; j < n; ++j) {
    const double slip = fields.fluid.velocity[a][at] - fields.solids.velocity[j][a][at];
    const double b = fluid::exchange_on_face(fields.solids.exchange[j].data(), face, stride, slip);
    const double phi = fraction_[a][j][at];
    const double on_solid = b / constants_.density[j];
    const double on_flux = phi * b * (1 / fluid_density - 1 / constants_.density[j]);
    system.row(row(j)) -= on_solid * fluid_velocity.transpose();
    system(row(j), row(j)) += on_solid;
    system.row(row(n)) += on_flux * fluid_velocity.transpose();
    system(row(n), row(j)) -= on_flux;
    if (fields.stress.viscous()) {
      const double rate = face_mean(fields.stress.viscosity.data(), face, stride) * viscous_diagonal(axis) * phi /
                          (phi + diffusion_floor(constants_, j)) / constants_.density[j];
      system(row(j), row(j)) += rate;
      system(row(n), row(j)) += phi * rate;
    }
    for (std::size_t k = 0; k < n && !fields.species_exchange.empty(); ++k) {
      if (k == j) continue;
      const Field& pair = fields.species_exchange[pair_index(std::min(j, k), std::max(j, k), n)];
      const double rate = face_mean(pair.data(), face, stride) * fraction_[a][k][at] / constants_.density[j];
      system(row(j), row(j)) += rate;
      system(row(j), row(k)) -= rate;
      system(row(n), row(j)) += phi * rate;
      system(row(n), row(k)) -= phi * rate;
    }
  }
  Eigen::Map<Matrix>(inverse_[a].data() + inverse_at(face), row(rows_), row(rows_)) = system.inverse();
}

/// Responses of a face to unit gradients of dp and of L s, and the coefficients of the elliptic system.
void Preconditioner::respond(const Fields& fields, int axis, Index face, bool solids_move) {
  const auto a = std::size_t(axis), at = std::size_t(face);
  const Index stride = constants_.grid.stride(axis);
  const std::size_t n = constants_.species();
  const double phi = std::max(face_mean(fields.solids_fraction.data(), face, stride), stress_fraction_floor);
  Vector pressure = Vector::Zero(Eigen::Index(rows_)), stress = pressure;
  for (std::size_t j = 0; j < n; ++j) {
    const auto row = Eigen::Index(j);
    pressure[row] = solids_move ? 1 / constants_.density[j] : 0;
    stress[row] = pressure[row] / phi;
    stress[Eigen::Index(n)] += fraction_[a][j][at] * stress[row];
  }
  pressure[Eigen::Index(n)] = fields.flux_rate.mobility[a][at];
  const Eigen::Map<const Matrix> inverse(inverse_[a].data() + inverse_at(face), Eigen::Index(rows_),
                                         Eigen::Index(rows_));
  const Vector to_pressure = inverse * pressure, to_stress = inverse * stress;
  double solids_pressure = 0, solids_stress = 0;
  for (std::size_t k = 0; k < rows_; ++k) {
    response_pressure_[a][k][at] = to_pressure[Eigen::Index(k)];
    response_stress_[a][k][at] = to_stress[Eigen::Index(k)];
    if (k == n) break;
    solids_pressure += fraction_[a][k][at] * to_pressure[Eigen::Index(k)];
    solids_stress += fraction_[a][k][at] * to_stress[Eigen::Index(k)];
  }
  coupling_[0][a][at] = to_pressure[Eigen::Index(n)];
  coupling_[1][a][at] = to_stress[Eigen::Index(n)];
  coupling_[2][a][at] = solids_pressure;
  coupling_[3][a][at] = solids_stress;
}

void Preconditioner::apply(const StateLayout& layout, std::span<const double> r, std::span<double> z) {
  unpack(layout, r);
  solve_faces();
  elliptic_sources();
  solver_.apply(source_p_, source_s_, dp_, s_, cycles);
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
      const bool held_above = axis == 1 && grid.ends(1, 1) && begin >= grid.index(0, grid.cells[1], 0);
      std::array<double, most_rows> value{};
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
      for (const Field& residual : fraction_residual_) source_s_[c] += residual[c];
    }
  });
}

/// Step 3: v -= R_q grad dp + R_g grad(L s).
void Preconditioner::correct_faces() {
  const core::Grid& grid = constants_.grid;
  fluid::set_outlet_pressure(grid, boundaries_, dp_);
  for (std::size_t c = 0; c < work_.size(); ++c) work_[c] = slope_[c] * s_[c];
  boundaries_.fill_cells(work_);
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
}

/// Step 4, and everything to its place.
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
      case Kind::pressure:
        layout.pack(entry, dp_, z);
        break;
    }
  }
}

}  // namespace polybed::tfm
