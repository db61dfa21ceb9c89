// Setup of the preconditioner: inverts S on every face, and computes its responses and the elliptic system.
#include <Eigen/Dense>
#include <algorithm>

#include "core/numerics/operators.hpp"
#include "fluid/density.hpp"
#include "fluid/pressure.hpp"
#include "tfm/preconditioner.hpp"
#include "tfm/solids.hpp"
#include "tfm/solids_viscosity.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Field;
using core::Index;

namespace {

constexpr int most_rows = int(Preconditioner::most_rows);
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most_rows, most_rows>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_rows, 1>;

}  // namespace

bool Preconditioner::setup(const Fields& fields, double c) {
  c_ = c;
  const core::Grid& grid = constants_.grid;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const core::Box inner = core::interior_faces(grid, axis);
    core::Box at_top = boundaries_.moving_faces(axis, true);
    at_top.lo[std::size_t(axis)] = inner.hi[std::size_t(axis)];
    fluid::with_density(fields.fluid, constants_.fluid.density, [&](const auto& density) {
      build(fields, density, axis, inner, Place::inside);
      build(fields, density, axis, at_top, boundaries_.open() ? Place::outlet : Place::screen);
    });
  }
  for (const fluid::OpenFace& f : boundaries_.open_faces()) {
    const auto a = f.axis(), at = std::size_t(f.face);
    const double response = fields.flux_rate.mobility[a][at] / c;
    coupling_[0][a][at] = response_pressure_[a][rows_ - 1][at] = response;
    coupling_[2][a][at] = 0;
    for (std::size_t j = 0; j < constants_.species(); ++j) {
      const bool leaves = f.outward * fields.fluid.flux[a][at] > 0;
      fraction_[a][j][at] = leaves ? fields.solids.fraction[j][std::size_t(f.inside)] : 0.0;
      coupling_[2][a][at] += fraction_[a][j][at] * response;
    }
  }
  for (core::FaceField& coefficient : coupling_) {
    boundaries_.join(coefficient);
    core::weigh_faces(grid, coefficient);
  }
  temperature_row_ = temperature_residual_ = fields.granular.decay;
  for (Field& row : temperature_row_)
    for (double& rate : row) rate += c;
  if (fields.stress.present())
    for (std::size_t cell = 0; cell < slope_.size(); ++cell) {
      slope_[cell] = fields.stress.slope[cell] + fields.stress.damping[cell] * c;
      elastic_[cell] = slope_[cell] > 0 ? fields.stress.slope[cell] / slope_[cell] : 1;
    }
  boundaries_.fill_cells(slope_);
  for (std::size_t cell = 0; grid.metric && cell < slope_.size(); ++cell) slope_[cell] *= grid.metric->per_volume[cell];
  if (fields.fluid.compression.present()) {
    diagonal_ = fields.fluid.compression.kappa;
    for (double& d : diagonal_) d *= c;
    core::weigh_cells(grid, diagonal_);
  }
  const auto faces = [](const core::FaceField& f) { return std::array<std::span<const double>, 3>{f[0], f[1], f[2]}; };
  return solver_.setup(faces(coupling_[0]), faces(coupling_[1]), faces(coupling_[2]), faces(coupling_[3]), slope_,
                       diagonal_, c);
}

/// At an open outlet only solids that rise move, and none that is fed there.
template <class Density>
void Preconditioner::build(const Fields& fields, const Density& density, int axis, const core::Box& box, Place place) {
  const Index s = constants_.grid.stride(axis);
  core::for_each_row(constants_.grid, box, [&](Index begin, Index end) {
    for (Index face = begin; face < end; ++face) {
      const auto a = std::size_t(axis), at = std::size_t(face);
      const bool open = !constants_.grid.metric || constants_.grid.metric->open[a][at] > 0;
      for (std::size_t j = 0; j < constants_.species(); ++j) {
        moves_[j] =
            open && (place == Place::inside || (place == Place::outlet && !constants_.openings.holds(j, axis, face)));
        const bool carried = moves_[j] && (place == Place::inside || fields.solids.velocity[j][a][at] > 0);
        fraction_[a][j][at] = carried ? face_mean(fields.solids.fraction[j].data(), face, s) : 0.0;
      }
      invert_face(fields, density.on_face(face, s), axis, face);
      respond(fields, density.on_face(face, s), axis, face);
      if (open) continue;
      for (std::size_t k = 0; k < rows_; ++k) response_pressure_[a][k][at] = 0;
    }
  });
}

/// Diagonal of -div(grad U + grad U^T - 2/3 div U I) for the velocity on a face, 1/m2. The viscosity of the solids
/// enters S through its diagonal, as if the neighbours were at rest.
double Preconditioner::viscous_diagonal(int axis, Index face) const {
  const core::Grid& grid = constants_.grid;
  double sum = 0;
  core::with_metric(grid, [&](const auto& metric) {
    const Index s = grid.stride(axis);
    for (int d = 0; d < grid.dimensions; ++d) {
      const auto b = std::size_t(d);
      const Index t = grid.stride(d);
      const auto through = [&](Index f, Index edge) { return metric.open(b, f) * metric.per_distance(b, edge); };
      const auto within = [&](Index c) {
        return 2 * metric.volume(c) * metric.per_length(b, c) * metric.per_length(b, c);
      };
      const double open = d == axis && grid.graded(d)
                              ? within(face - s) + within(face)
                              : through(face - s, face) + through(face, face) + through(face + t - s, face + t) +
                                    through(face + t, face + t);
      sum += (d == axis ? 8.0 / 3 : 2.0) * 0.25 * open * metric.per_volume_on(std::size_t(axis), face) /
             (grid.spacing[b] * grid.spacing[b]);
    }
  });
  return sum;
}

/// Added mass, as in effects/added_mass.cpp: converts rows with the effect of forces on U_1..U_N and J of a face, for
/// each phase alone, into rows for all phases coupled.
template <class Rows>
void Preconditioner::couple(const Fields& fields, double fluid_density, int axis, Index face, Rows& rows) const {
  const auto a = std::size_t(axis), at = std::size_t(face);
  const auto flux = Eigen::Index(constants_.species());
  const double eps =
      std::max(face_mean(fields.fluid.voidage.data(), face, constants_.grid.stride(axis)), fluid::voidage_floor);
  double mass = eps * fluid_density;
  Rows fluid = rows.row(flux);
  for (std::size_t j = 0; j < constants_.species(); ++j) fluid -= fraction_[a][j][at] * rows.row(Eigen::Index(j));
  fluid *= fluid_density;
  for (std::size_t j = 0; j < constants_.species(); ++j) {
    const double weight = fraction_[a][j][at] * fields.inertia.share[j][a][at] * constants_.density[j];
    fluid += weight * rows.row(Eigen::Index(j));
    mass += weight;
  }
  fluid /= mass;
  rows.row(flux) = eps * fluid;
  for (std::size_t j = 0; j < constants_.species(); ++j) {
    const double k = moves_[j] ? fields.inertia.share[j][a][at] : 0;
    rows.row(Eigen::Index(j)) = (1 - k) * rows.row(Eigen::Index(j)) + k * fluid;
    rows.row(flux) += fraction_[a][j][at] * rows.row(Eigen::Index(j));
  }
}

/// Inverts S on one face in place; the row of a species that is held there is c dU_j.
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
    if (!moves_[j]) continue;
    const double slip = fields.fluid.velocity[a][at] - fields.solids.velocity[j][a][at];
    double b = 0;
    fluid::with_form(fields.solids, [&]<class Form>(Form) {
      b = Form::at(fields.solids.exchange[j].data(), fields.fluid.voidage.data(), face, stride, slip);
    });
    const double phi = fraction_[a][j][at];
    const double on_solid = b / constants_.density[j];
    const double on_flux = phi * b * (1 / fluid_density - 1 / constants_.density[j]);
    system.row(row(j)) -= on_solid * fluid_velocity.transpose();
    system(row(j), row(j)) += on_solid;
    system.row(row(n)) += on_flux * fluid_velocity.transpose();
    system(row(n), row(j)) -= on_flux;
    if (fields.stress.viscous()) {
      const double rate = face_mean(fields.stress.viscosity.data(), face, stride) * viscous_diagonal(axis, face) * phi /
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
  if (fields.inertia.present()) {
    system.diagonal().array() -= c_;
    couple(fields, fluid_density, axis, face, system);
    system.diagonal().array() += c_;
  }
  Eigen::Map<Matrix>(inverse_[a].data() + inverse_at(face), row(rows_), row(rows_)) = system.inverse();
}

/// Responses of a face to unit gradients of dp and of L s, and the coefficients of the elliptic system.
void Preconditioner::respond(const Fields& fields, double fluid_density, int axis, Index face) {
  const auto a = std::size_t(axis), at = std::size_t(face);
  const Index stride = constants_.grid.stride(axis);
  const std::size_t n = constants_.species();
  const double phi = std::max(face_mean(fields.solids_fraction.data(), face, stride), stress_fraction_floor);
  Vector pressure = Vector::Zero(Eigen::Index(rows_)), stress = pressure;
  for (std::size_t j = 0; j < n; ++j) {
    const auto row = Eigen::Index(j);
    pressure[row] = moves_[j] ? fields.solids.response(j) : 0;
    stress[row] = (moves_[j] ? 1 / constants_.density[j] : 0) / phi;
    stress[Eigen::Index(n)] += fraction_[a][j][at] * stress[row];
  }
  pressure[Eigen::Index(n)] = fields.flux_rate.mobility[a][at];
  if (fields.inertia.present()) {
    couple(fields, fluid_density, axis, face, stress);
    for (std::size_t j = 0; j < n; ++j) pressure[Eigen::Index(j)] = moves_[j] ? fields.inertia.response[j][a][at] : 0;
  }
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

}  // namespace polybed::tfm
