#include "tfm/pressure_coupling.hpp"

namespace polybed::tfm {

using core::Index;
using Kind = StateLayout::Entry::Kind;

void subtract_pressure_gradient(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  const core::Grid& grid = constants.grid;
  core::Field& p = fields.fluid.pressure;
  fluid::set_outlet_pressure(grid, boundaries, p);
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    double* flux = fields.flux_rate.free[a].data();
    const double* mobility = fields.flux_rate.mobility[a].data();
    fluid::for_each_gradient_row(grid, boundaries.moving_faces(axis, true), axis, p,
                                 [&](Index begin, Index end, auto gradient) {
                                   for (Index c = begin; c < end; ++c) flux[c] -= mobility[c] * gradient(c);
                                 });
    for (std::size_t j = 0; j < fields.inertia.response.size(); ++j) {
      double* acceleration = fields.solids.acceleration[j][a].data();
      const double* response = fields.inertia.response[j][a].data();
      fluid::for_each_gradient_row(grid, boundaries.moving_faces(axis, false), axis, p,
                                   [&](Index begin, Index end, auto gradient) {
                                     for (Index c = begin; c < end; ++c) acceleration[c] -= response[c] * gradient(c);
                                   });
    }
    const bool by_density = fields.solids.carry_pressure && !fields.inertia.present();
    for (std::size_t j = 0; j < constants.species() && by_density; ++j) {
      double* acceleration = fields.solids.acceleration[j][a].data();
      const double per_density = fields.solids.response(j);
      fluid::for_each_gradient_row(grid, boundaries.moving_faces(axis, false), axis, p,
                                   [&](Index begin, Index end, auto gradient) {
                                     for (Index c = begin; c < end; ++c) acceleration[c] -= per_density * gradient(c);
                                   });
    }
  }
  for (const fluid::OpenFace& f : boundaries.open_faces()) {
    const auto at = std::size_t(f.face);
    fields.flux_rate.free[f.axis()][at] -= fields.flux_rate.mobility[f.axis()][at] * f.gradient(p);
  }
  if (constants.openings.present()) constants.openings.hold(fields.solids.acceleration);
  core::hold_closed(grid, fields.flux_rate.free);
  for (core::FaceField& acceleration : fields.solids.acceleration) core::hold_closed(grid, acceleration);
}

void pack_rates(const StateLayout& layout, const Fields& fields, std::span<double> dydt) {
  for (const StateLayout::Entry& entry : layout.entries()) {
    const auto j = std::size_t(entry.species), a = std::size_t(entry.axis);
    switch (entry.kind) {
      case Kind::fraction:
        layout.pack(entry, fields.solids.fraction_rate[j], dydt);
        break;
      case Kind::velocity:
        layout.pack(entry, fields.solids.acceleration[j][a], dydt);
        break;
      case Kind::flux:
        layout.pack(entry, fields.flux_rate.free[a], dydt);
        break;
      case Kind::temperature:
        layout.pack(entry, fields.solids.temperature_rate[j], dydt);
        break;
      case Kind::passed:
        layout.pack(entry, fields.solids.passed_rate[j][a], dydt);
        break;
      case Kind::pressure:
        if (fields.fluid.compression.present()) layout.pack(entry, fields.fluid.compression.pressure_rate, dydt);
        break;
    }
  }
}

}  // namespace polybed::tfm
