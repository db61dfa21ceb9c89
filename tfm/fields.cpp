#include "tfm/fields.hpp"

#include <algorithm>
#include <type_traits>

namespace polybed::tfm {

Fields::Fields(const Constants& constants)
    : solids(constants.grid, constants.density),
      fluid(constants.grid),
      solids_fraction(core::make_field(constants.grid)),
      share(constants.species(), core::make_field(constants.grid)),
      slip_superficial(constants.species(), core::make_field(constants.grid)),
      solids_flux(constants.species(), core::make_face_field(constants.grid)),
      fluid_acceleration(core::make_face_field(constants.grid)),
      flux_rate(constants.grid) {
  solids.carry_pressure = !constants.form_b;
  if (!constants.openings.present()) return;
  solids.passed.assign(constants.species(), constants.openings.make_passed());
  solids.passed_rate = solids.passed;
}

namespace {

/// Calls body for a field, or for each of a list.
template <class List, class Body>
void for_each_in(List& list, Body&& body) {
  if constexpr (std::is_same_v<std::remove_const_t<List>, core::Field>)
    body(list);
  else
    for (auto& one : list) for_each_in(one, body);
}

/// The list of all fields. Calls body(field, rows_of_solids); rows_of_solids: the solids' equations set its values,
/// only in the rows of Boundaries::with_solids.
template <class AnyFields, class Body>
void for_each_field(AnyFields& fields, Body&& body) {
  const auto take = [&](bool rows_of_solids, auto&... lists) {
    (for_each_in(lists, [&](auto& field) { body(field, rows_of_solids); }), ...);
  };
  auto& solids = fields.solids;
  take(false, solids.fraction, solids.velocity, solids.fraction_rate, solids.temperature, solids.passed,
       solids.passed_rate);
  take(true, solids.acceleration, solids.exchange, solids.temperature_rate);
  auto& fluid = fields.fluid;
  auto& compression = fluid.compression;
  take(false, fluid.flux, fluid.velocity, fluid.voidage, fluid.pressure);
  take(false, compression.density, compression.kappa, compression.pressure_rate, compression.flux);
  take(false, fields.solids_fraction, fields.share, fields.fluid_acceleration);
  take(false, fields.flux_rate.free, fields.flux_rate.mobility);
  take(true, fields.slip_superficial, fields.solids_flux, fields.species_exchange);
  auto& stress = fields.stress;
  take(true, stress.pressure, stress.slope, stress.damping, stress.contact, stress.upwind_work, stress.viscosity,
       stress.strain, stress.wall);
  take(true, fields.granular.conductivity, fields.granular.decay);
  auto& inertia = fields.inertia;
  take(false, fields.force.on_solids, inertia.convection, inertia.fluid_response);
  take(true, inertia.share, inertia.response);
}

}  // namespace

std::size_t bytes_of(const Fields& fields) {
  std::size_t entries = 0;
  for_each_field(fields, [&](const core::Field& field, bool) { entries += field.size(); });
  return entries * sizeof(double);
}

void clear_results_of_solids(Fields& fields) {
  for_each_field(fields, [](core::Field& field, bool rows_of_solids) {
    if (rows_of_solids) std::fill(field.begin(), field.end(), 0.0);
  });
}

}  // namespace polybed::tfm
