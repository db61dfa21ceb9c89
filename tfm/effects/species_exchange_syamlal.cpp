#include "tfm/effects/species_exchange_syamlal.hpp"

#include <algorithm>
#include <cmath>

#include "tfm/solids.hpp"

namespace polybed::tfm {

using core::Index;

SyamlalExchange::SyamlalExchange(const core::Scene& scene, const Constants& constants,
                                 const fluid::Boundaries& boundaries, Fields& fields)
    : constants_(constants), boundaries_(boundaries), contact_(scene.tfm.exchange_pressure) {
  for (std::size_t j = 0; j < constants.species(); ++j)
    for (std::size_t k = j + 1; k < constants.species(); ++k) {
      const auto mean = [&](double core::Species::*member) {
        return 0.5 * (scene.species[j].*member + scene.species[k].*member);
      };
      pairs_.push_back({constants.diameter[j], constants.diameter[k], constants.density[j], constants.density[k],
                        mean(&core::Species::restitution), mean(&core::Species::friction)});
      fields.species_exchange.push_back(core::make_field(constants.grid));
    }
}

void SyamlalExchange::evaluate(Fields& fields) {
  const core::Grid& grid = constants_.grid;
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      const auto at = std::size_t(c);
      double surface = 0;
      for (std::size_t m = 0; m < constants_.species(); ++m)
        surface += std::max(fields.solids.fraction[m][at], 0.0) / constants_.diameter[m];
      const double eps = std::max(fields.fluid.voidage[at], fluid::voidage_floor);
      const double phi = std::max(fields.solids_fraction[at], stress_fraction_floor);
      const double contact =
          fields.stress.present() ? contact_ * std::max(fields.stress.pressure[at], 0.0) / (phi * phi) : 0.0;
      std::size_t pair = 0;
      for (std::size_t j = 0; j < constants_.species(); ++j)
        for (std::size_t k = j + 1; k < constants_.species(); ++k, ++pair) {
          double speed2 = 0;
          for (int axis = 0; axis < grid.dimensions; ++axis) {
            const double *u = fields.solids.velocity[j][std::size_t(axis)].data(),
                         *v = fields.solids.velocity[k][std::size_t(axis)].data();
            const Index s = grid.stride(axis);
            const double w = 0.5 * ((u[c] - v[c]) + (u[c + s] - v[c + s]));
            speed2 += w * w;
          }
          fields.species_exchange[pair][at] = closures::species_exchange(
              pairs_[pair], closures::radial_distribution(pairs_[pair], eps, surface), std::sqrt(speed2), contact);
        }
    }
  });
  boundaries_.fill_cells(fields.species_exchange);
}

}  // namespace polybed::tfm
