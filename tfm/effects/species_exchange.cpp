// Slot Exchange, solids with solids: from a table, or after Syamlal and Gera.
#include "relevance/effects/species_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "closures/kinetic_theory.hpp"
#include "closures/species_exchange_kinetic.hpp"
#include "closures/species_exchange_syamlal.hpp"
#include "closures/stress_table.hpp"
#include "core/error.hpp"
#include "core/vectors.hpp"
#include "tfm/effects.hpp"
#include "tfm/effects/maker.hpp"
#include "tfm/effects/table_file.hpp"
#include "tfm/solids.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::tfm {

namespace {

using core::Index;

/// Collisions of two species, as measured in sheared boxes with both. K_12 = R(phi) beta_12 + C_s p_f phi_1
/// phi_2/phi^2, with beta_12 from closures/species_exchange_kinetic.hpp at the cell's granular temperatures and drift,
/// and R the ratio in a dry table of two species, at the restitution, friction and share of the whole bed. p_f is the
/// pressure of friction alone: R includes collisions. Outside the table R of its edge is used. Where both species are
/// present, solids fractions outside the table are counted, and drifts, over the root of the mean temperature, faster
/// than all of its measurements.
class TableExchange : public SolidsExchange {
 public:
  /// Needs a granular temperature from the stress of the solids. \param file  of the table
  TableExchange(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                const SolidsTable& table, const std::string& file, Fields& fields)
      : constants_(constants),
        boundaries_(boundaries),
        fastest_(table.exchange_drift),
        contact_(scene.tfm.exchange_pressure),
        use_{"species exchange " + file} {
    const TablePlace place = place_of(scene);
    ratio_ = exchange_at(table, place);
    restitution_ = table.reference_restitution(place.restitution, place.friction);
    fields.species_exchange.push_back(core::make_field(constants.grid));
    if (contact_ > 0 && fields.stress.contact.empty()) fields.stress.contact = core::make_field(constants.grid);
  }

  void evaluate(Fields& fields) override {
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

  [[nodiscard]] std::optional<ClosureUse> use() const override { return use_; }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  closures::MonotoneCurve ratio_;
  double restitution_ = 0, fastest_ = 0;  ///< fastest_: |U_1 - U_2|/sqrt(theta) of the boxes
  double contact_;                        ///< C_s, s/m2
  ClosureUse use_;
};

/// Collisions and contact between species after Syamlal and Gera.
class SyamlalExchange : public SolidsExchange {
 public:
  SyamlalExchange(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                  Fields& fields)
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

  void evaluate(Fields& fields) override {
    core::for_each_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
      core::in_vectors<set_cells>(*this, fields, begin, end);
      std::size_t pair = 0;
      for (std::size_t j = 0; j < constants_.species(); ++j)
        for (std::size_t k = j + 1; k < constants_.species(); ++k, ++pair)
          core::in_vectors<set_pair>(*this, fields, j, k, pair, begin, end);
    });
    boundaries_.fill_cells(fields.species_exchange);
  }

 private:
  /// Computes the values common to all pairs in a cell.
  static void set_cells(SyamlalExchange& of, const Fields& fields, Index begin, Index end) {
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

  static void set_pair(const SyamlalExchange& of, Fields& fields, std::size_t j, std::size_t k, std::size_t pair,
                       Index begin, Index end) {
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

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  std::vector<closures::SpeciesPair> pairs_;
  double contact_;                         ///< C_s, s/m2
  core::Field surface_, contact_of_cell_;  ///< work space: sum phi_m/D_m, 1/m; C_s p_s/phi^2
};

}  // namespace

namespace makers {

namespace {

/// Reads a table of the exchange between two species.
SolidsTable exchange_table(const core::Scene& scene, const std::string& file, std::vector<std::string>& warnings) {
  SolidsTable table = read_solids_table(file);
  for (const std::string& line : beyond(table, place_of(scene)))
    warnings.push_back("species exchange " + file + ": " + line);
  return table;
}

void make_species_exchange(const Making& m) {
  const auto& [scene, constants, boundaries, law, fields, effects] = m;
  if (const auto file = table_file(law)) {
    const SolidsTable table = exchange_table(scene, *file, effects.warnings);
    effects.species_exchange = std::make_unique<TableExchange>(scene, constants, boundaries, table, *file, fields);
  } else if (constants.species() > 1) {
    effects.species_exchange = std::make_unique<SyamlalExchange>(scene, constants, boundaries, fields);
  }
}

}  // namespace

extern const Maker species_exchange;
const Maker species_exchange{&relevance::effects::species_exchange, "Exchange", make_species_exchange};

}  // namespace makers

}  // namespace polybed::tfm
