#include "tfm/effects/species_exchange_syamlal.hpp"

#include <algorithm>
#include <cmath>

#include "core/vectors.hpp"
#include "tfm/solids.hpp"

namespace polybed::tfm {

using core::Index;

SyamlalExchange::SyamlalExchange(const core::Scene& scene, const Constants& constants,
                                 const fluid::Boundaries& boundaries, Fields& fields)
    : constants_(constants),
      boundaries_(boundaries),
      contact_(scene.tfm.exchange_pressure),
      surface_(core::make_field(constants.grid)),
      contact_of_cell_(core::make_field(constants.grid)) {
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
  core::for_each_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
    core::in_vectors<set_cells>(*this, fields, begin, end);
    std::size_t pair = 0;
    for (std::size_t j = 0; j < constants_.species(); ++j)
      for (std::size_t k = j + 1; k < constants_.species(); ++k, ++pair)
        core::in_vectors<set_pair>(*this, fields, j, k, pair, begin, end);
  });
  boundaries_.fill_cells(fields.species_exchange);
}

/// What all pairs of a cell have in common.
void SyamlalExchange::set_cells(SyamlalExchange& of, const Fields& fields, Index begin, Index end) {
  double *surface = of.surface_.data(), *contact = of.contact_of_cell_.data();
  std::fill(surface + begin, surface + end, 0.0);
  for (std::size_t m = 0; m < of.constants_.species(); ++m) {
    const double *phi = fields.solids.fraction[m].data(), per_diameter = 1 / of.constants_.diameter[m];
#pragma GCC ivdep
    for (Index c = begin; c < end; ++c) surface[c] += std::max(phi[c], 0.0) * per_diameter;
  }
  if (!fields.stress.present()) return;
  const double *p = fields.stress.pressure.data(), *solids = fields.solids_fraction.data(), scale = of.contact_;
#pragma GCC ivdep
  for (Index c = begin; c < end; ++c) {
    const double phi = std::max(solids[c], stress_fraction_floor);
    contact[c] = scale * std::max(p[c], 0.0) / (phi * phi);
  }
}

void SyamlalExchange::set_pair(const SyamlalExchange& of, Fields& fields, std::size_t j, std::size_t k,
                               std::size_t pair, Index begin, Index end) {
  double* out = fields.species_exchange[pair].data();
  std::fill(out + begin, out + end, 0.0);
  for (int axis = 0; axis < of.constants_.grid.dimensions; ++axis) {
    const double *u = fields.solids.velocity[j][std::size_t(axis)].data(),
                 *v = fields.solids.velocity[k][std::size_t(axis)].data();
    const Index s = of.constants_.grid.stride(axis);
#pragma GCC ivdep
    for (Index c = begin; c < end; ++c) {
      const double w = 0.5 * ((u[c] - v[c]) + (u[c + s] - v[c + s]));
      out[c] += w * w;
    }
  }
  const closures::SpeciesPair between = of.pairs_[pair];
  const double *voidage = fields.fluid.voidage.data(), *surface = of.surface_.data(),
               *contact = of.contact_of_cell_.data();
#pragma GCC ivdep
  for (Index c = begin; c < end; ++c) {
    const double eps = std::max(voidage[c], fluid::voidage_floor);
    out[c] = closures::species_exchange(between, closures::radial_distribution(between, eps, surface[c]),
                                        std::sqrt(out[c]), contact[c]);
  }
}

}  // namespace polybed::tfm
