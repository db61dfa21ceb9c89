#include "hard/naive/unknowns.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"

namespace polybed::hard::naive {

using core::Index;
using Kind = tfm::StateLayout::Entry::Kind;

namespace {

/// Calls body(species, axis, face, stride) for all faces on which solids move.
template <class Body>
void for_each_face_of_solids(const tfm::Model& model, Body&& body) {
  const tfm::Constants& constants = model.constants();
  for (std::size_t j = 0; j < constants.species(); ++j)
    for (int axis = 0; axis < constants.grid.dimensions; ++axis)
      core::for_each_row(constants.grid, model.boundaries().moving_faces(axis, false), [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) body(j, std::size_t(axis), c, constants.grid.stride(axis));
      });
}

}  // namespace

MomentumUnknowns::MomentumUnknowns(core::DaeProblem& inner, const tfm::Model& model, const tfm::StateLayout& layout)
    : inner_(inner),
      model_(model),
      layout_(layout),
      solids_(model.constants().grid, model.constants().density),
      change_(solids_),
      fluid_(model.constants().grid),
      velocities_(layout.size()),
      zero_(layout.size()),
      rates_(layout.size()) {}

void MomentumUnknowns::load(std::span<const double> y, fluid::Interphase& solids) {
  layout_.unpack(y, solids, fluid_);
  for (core::Field& phi : solids.fraction) model_.boundaries().fill_cells(phi);
}

void MomentumUnknowns::to_velocity(std::span<const double> momenta, std::span<double> velocities) {
  load(momenta, solids_);
  for_each_face_of_solids(model_, [&](std::size_t j, std::size_t a, Index c, Index s) {
    solids_.velocity[j][a][std::size_t(c)] /= std::max(core::face_mean(solids_.fraction[j].data(), c, s), floor);
  });
  layout_.pack(solids_, fluid_, velocities);
}

void MomentumUnknowns::to_momentum(std::span<const double> velocities, std::span<double> momenta) {
  load(velocities, solids_);
  for_each_face_of_solids(model_, [&](std::size_t j, std::size_t a, Index c, Index s) {
    solids_.velocity[j][a][std::size_t(c)] *= core::face_mean(solids_.fraction[j].data(), c, s);
  });
  layout_.pack(solids_, fluid_, momenta);
}

void MomentumUnknowns::change_to_momentum(std::span<const double> of_velocity, std::span<double> of_momentum) {
  load(of_velocity, change_);
  for_each_face_of_solids(model_, [&](std::size_t j, std::size_t a, Index c, Index s) {
    double& change = change_.velocity[j][a][std::size_t(c)];
    change = core::face_mean(solids_.fraction[j].data(), c, s) * change +
             solids_.velocity[j][a][std::size_t(c)] * core::face_mean(change_.fraction[j].data(), c, s);
  });
  layout_.pack(change_, fluid_, of_momentum);
}

void MomentumUnknowns::change_to_velocity(std::span<const double> of_momentum, std::span<double> of_velocity) {
  load(of_momentum, change_);
  for_each_face_of_solids(model_, [&](std::size_t j, std::size_t a, Index c, Index s) {
    double& change = change_.velocity[j][a][std::size_t(c)];
    change -= solids_.velocity[j][a][std::size_t(c)] * core::face_mean(change_.fraction[j].data(), c, s);
    change /= std::max(core::face_mean(solids_.fraction[j].data(), c, s), floor);
  });
  layout_.pack(change_, fluid_, of_velocity);
}

/// dm/dt - (phi dU/dt + U dphi/dt), the rates from the inner residual at dy/dt = 0.
core::Rate MomentumUnknowns::residual(double t, std::span<const double> y, std::span<const double> dydt,
                                      std::span<double> r) {
  to_velocity(y, velocities_);
  if (inner_.residual(t, velocities_, zero_, rates_) != core::Rate::ok) return core::Rate::recoverable;
  change_to_momentum(rates_, r);
  for (const auto& entry : layout_.entries())
    if (entry.kind == Kind::pressure)
      std::copy_n(rates_.begin() + std::ptrdiff_t(entry.begin), entry.size, r.begin() + std::ptrdiff_t(entry.begin));
    else
      for (std::size_t n = entry.begin; n < entry.begin + entry.size; ++n) r[n] += dydt[n];
  return core::Rate::ok;
}

core::Rate MomentumUnknowns::setup(double t, std::span<const double> y, std::span<const double>,
                                   std::span<const double> r, double cj) {
  to_velocity(y, velocities_);
  return inner_.setup(t, velocities_, zero_, r, cj);
}

core::Rate MomentumUnknowns::precondition(double t, std::span<const double> r, std::span<double> z, double cj,
                                          double delta) {
  change_to_velocity(r, rates_);
  if (inner_.precondition(t, rates_, velocities_, cj, delta) != core::Rate::ok) return core::Rate::recoverable;
  change_to_momentum(velocities_, z);
  return core::Rate::ok;
}

core::Rate ClippedRates::residual(double t, std::span<const double> y, std::span<const double> dydt,
                                  std::span<double> r) {
  if (inner_.residual(t, y, dydt, r) != core::Rate::ok) return core::Rate::recoverable;
  for (const auto& entry : layout_.entries()) {
    if (entry.kind != Kind::fraction) continue;
    for (std::size_t n = entry.begin; n < entry.begin + entry.size; ++n)
      if (const double rate = dydt[n] - r[n]; y[n] <= 0 && rate < 0) r[n] = dydt[n];
  }
  return core::Rate::ok;
}

core::Rate JacobiContinuity::setup(double t, std::span<const double> y, std::span<const double> dydt,
                                   std::span<const double> r, double cj) {
  if (inner_.setup(t, y, dydt, r, cj) != core::Rate::ok) return core::Rate::recoverable;
  const core::Grid& grid = equations_.constants().grid;
  const fluid::Interphase& solids = equations_.fields().solids;
  core::Field outflow = core::make_field(grid);
  for (const auto& entry : layout_.entries()) {
    if (entry.kind != Kind::fraction) continue;
    std::fill(outflow.begin(), outflow.end(), 0.0);
    for (int axis = 0; axis < grid.dimensions; ++axis) {
      const double* u = solids.velocity[std::size_t(entry.species)][std::size_t(axis)].data();
      const Index s = grid.stride(axis);
      core::for_each_row(grid, [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c)
          outflow[std::size_t(c)] += (std::max(u[c + s], 0.0) + std::max(-u[c], 0.0)) / grid.spacing[std::size_t(axis)];
      });
    }
    layout_.pack(entry, outflow, diagonal_);
  }
  return core::Rate::ok;
}

core::Rate JacobiContinuity::precondition(double t, std::span<const double> r, std::span<double> z, double cj,
                                          double delta) {
  if (inner_.precondition(t, r, z, cj, delta) != core::Rate::ok) return core::Rate::recoverable;
  for (const auto& entry : layout_.entries())
    if (entry.kind == Kind::fraction)
      for (std::size_t n = entry.begin; n < entry.begin + entry.size; ++n) z[n] = r[n] / (cj + diagonal_[n]);
  return core::Rate::ok;
}

}  // namespace polybed::hard::naive
