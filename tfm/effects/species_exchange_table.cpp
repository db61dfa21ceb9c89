#include "tfm/effects/species_exchange_table.hpp"

#include <algorithm>
#include <cmath>

#include "closures/kinetic_theory.hpp"
#include "core/start_error.hpp"
#include "tfm/solids.hpp"

namespace polybed::tfm {

using core::Index;

TableExchange::TableExchange(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                             const fluid::SolidsTable& table, const std::string& file, Fields& fields)
    : constants_(constants),
      boundaries_(boundaries),
      fastest_(table.exchange_drift),
      contact_(scene.tfm.exchange_pressure),
      use_{"species exchange " + file} {
  const std::string law = "effects.species_exchange = \"table:" + file + "\" ";
  if (constants.species() != 2)
    throw core::StartError(law + "is of two species, the case has " + std::to_string(constants.species()));
  if (table.exchange.value.empty())
    throw core::StartError(law + "holds no beta_12: polybed calibrate measures it in dry boxes, with calibrate.share");
  if (fields.solids.temperature.empty())
    throw core::StartError(law + "needs granular temperatures: solids_stress = \"kinetic\" or a dry table");
  const fluid::TablePlace place = fluid::place_of(scene);
  ratio_ = fluid::exchange_at(table, place);
  restitution_ = table.reference_restitution(place.restitution, place.friction);
  fields.species_exchange.push_back(core::make_field(constants.grid));
  if (contact_ > 0 && fields.stress.contact.empty()) fields.stress.contact = core::make_field(constants.grid);
}

void TableExchange::evaluate(Fields& fields) {
  const core::Grid& grid = constants_.grid;
  core::for_each_row(grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      const auto at = std::size_t(c);
      closures::DriftingSpecies one{constants_.diameter[0], constants_.density[0], 1, 0},
          two{constants_.diameter[1], constants_.density[1], 1, 0};
      one.theta = std::max(fields.solids.temperature[0][at], 0.0);
      two.theta = std::max(fields.solids.temperature[1][at], 0.0);
      double square = 0;
      for (int axis = 0; axis < grid.dimensions; ++axis) {
        const double *u = fields.solids.velocity[0][std::size_t(axis)].data(),
                     *v = fields.solids.velocity[1][std::size_t(axis)].data();
        const Index s = grid.stride(axis);
        const double w = 0.5 * ((u[c] - v[c]) + (u[c + s] - v[c + s]));
        square += w * w;
      }
      const double phi_1 = std::max(fields.solids.fraction[0][at], 0.0),
                   phi_2 = std::max(fields.solids.fraction[1][at], 0.0), phi = fields.solids_fraction[at];
      const double eps = std::max(fields.fluid.voidage[at], fluid::voidage_floor);
      const double g12 =
          closures::radial_of_pair(eps, phi_1 / one.diameter + phi_2 / two.diameter, one.diameter, two.diameter);
      const double thin = std::max(phi, stress_fraction_floor);
      const double contact = contact_ > 0 ? contact_ * std::max(fields.stress.contact[at], 0.0) / (thin * thin) : 0.0;
      fields.species_exchange[0][at] =
          ratio_(phi).pressure * closures::species_exchange_kinetic(one, two, g12, restitution_, std::sqrt(square)) +
          contact;
      if (std::min(phi_1, phi_2) < stress_fraction_floor) continue;
      const double mass_1 = phi_1 * one.density, mass_2 = phi_2 * two.density,
                   theta = (mass_1 * one.theta + mass_2 * two.theta) / (mass_1 + mass_2);
      if (phi < ratio_.first() || phi > ratio_.last() || square > fastest_ * fastest_ * theta) ++use_.guarded;
    }
    use_.evaluations += std::uint64_t(end - begin);
  });
  boundaries_.fill_cells(fields.species_exchange);
}

}  // namespace polybed::tfm
