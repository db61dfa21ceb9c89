// Memory use of a model.
#include "tfm/fields.hpp"

namespace polybed::tfm {

namespace {

std::size_t entries(const core::Field& field) { return field.size(); }

template <class Inner, std::size_t n>
std::size_t entries(const std::array<Inner, n>& list);

template <class Inner>
std::size_t entries(const std::vector<Inner>& list) {
  std::size_t sum = 0;
  for (const Inner& inner : list) sum += entries(inner);
  return sum;
}

template <class Inner, std::size_t n>
std::size_t entries(const std::array<Inner, n>& list) {
  std::size_t sum = 0;
  for (const Inner& inner : list) sum += entries(inner);
  return sum;
}

}  // namespace

std::size_t bytes_of(const Fields& fields) {
  const fluid::Interphase& s = fields.solids;
  const std::size_t solids = entries(s.fraction) + entries(s.velocity) + entries(s.fraction_rate) +
                             entries(s.acceleration) + entries(s.exchange) + entries(s.temperature) +
                             entries(s.temperature_rate);
  const fluid::FluidState& f = fields.fluid;
  const std::size_t fluid = entries(f.flux) + entries(f.velocity) + entries(f.voidage) + entries(f.pressure) +
                            entries(f.compression.density) + entries(f.compression.kappa) +
                            entries(f.compression.pressure_rate) + entries(f.compression.flux);
  const std::size_t working =
      entries(fields.solids_fraction) + entries(fields.share) + entries(fields.slip_superficial) +
      entries(fields.solids_flux) + entries(fields.fluid_acceleration) + entries(fields.flux_rate.free) +
      entries(fields.flux_rate.mobility) + entries(fields.stress.pressure) + entries(fields.stress.slope) +
      entries(fields.stress.damping) + entries(fields.stress.viscosity) + entries(fields.stress.strain) +
      entries(fields.stress.contact) + entries(fields.stress.wall) + entries(fields.stress.upwind_work) +
      entries(fields.granular.conductivity) + entries(fields.granular.decay) + entries(fields.species_exchange) +
      entries(fields.force.on_solids) + entries(fields.inertia.convection) + entries(fields.inertia.share) +
      entries(fields.inertia.response) + entries(fields.inertia.fluid_response);
  return (solids + fluid + working) * sizeof(double);
}

}  // namespace polybed::tfm
