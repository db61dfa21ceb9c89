// Creates the stress of the solids: friction, plus collisions.
#include "relevance/effects/solids_stress.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "closures/stress_ratios.hpp"
#include "closures/stress_reference.hpp"
#include "core/case/scene.hpp"
#include "core/numerics/operators.hpp"
#include "relevance/effects/granular_temperature.hpp"
#include "tfm/effects.hpp"
#include "tfm/effects/maker.hpp"
#include "tfm/effects/solids_stress_frictional.hpp"
#include "tfm/effects/solids_stress_kinetic.hpp"
#include "tfm/effects/solids_stress_table.hpp"
#include "tfm/effects/table_file.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::tfm {

namespace {

using core::Index;

/// 1/s, regularises the shear rate at 0.
constexpr double least_shear_rate = 0.01;
/// Solids fraction below which the viscosity over phi is constant: V falls as phi^2, and so dilute solids have no
/// stress.
constexpr double fraction_floor = 1e-3;

/// Stress of sheared solids from a liquid's drag and films, as measured in boxes of particles. p = mu_f gamma (1 +
/// lambda St) V(phi) R_p, mu_s = mu_f (1 + lambda St) V(phi) R_mu, closures/stress_ratios.hpp, with St = rho d^2
/// gamma/mu_f from the cell's Sauter diameter and mean density. Needs no granular temperature. gamma is sqrt(2 D':D' +
/// g^2) - g with g = 0.01 1/s, D' the mean over the solids: 0 and smooth at rest. Outside the table the ratios of its
/// edge are used, which is counted where there are solids.
class WetStress : public CollisionalStress {
 public:
  /// \param jammed  phi_m in V  \param lambda  from the table
  WetStress(const Constants& constants, const fluid::Boundaries& boundaries, closures::StressRatios ratios,
            double jammed, double lambda, const std::string& name, Fields& fields)
      : constants_(constants),
        boundaries_(boundaries),
        ratios_(std::move(ratios)),
        jammed_(jammed),
        lambda_(lambda),
        use_{"solids stress " + name} {
    fields.stress.make_viscous(constants);
  }

  void add(Fields& fields) override {
    const double mu = constants_.fluid.viscosity;
    core::for_each_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        double square = least_shear_rate * least_shear_rate, per_diameter = 0, density = 0;
        for (std::size_t j = 0; j < constants_.species(); ++j) {
          const double share = fields.share[j][c];
          square += share * fields.stress.strain[j][c];
          per_diameter += share / constants_.diameter[j];
          density += share * constants_.density[j];
        }
        const double rate = std::sqrt(square) - least_shear_rate, phi = std::max(fields.solids_fraction[c], 0.0);
        const double stokes = closures::stokes_of_shear(density, 1 / per_diameter, rate, mu);
        const closures::WetStress stress = closures::wet_stress(ratios_, jammed_, lambda_, phi, stokes, mu, rate);
        fields.stress.pressure[c] += stress.pressure;
        fields.stress.slope[c] += stress.slope;
        fields.stress.viscosity[c] += stress.viscosity / std::max(phi, fraction_floor);
        if (phi > fraction_floor && ratios_.outside(phi, stokes)) ++use_.guarded;
      }
      use_.evaluations += std::uint64_t(end - begin);
    });
    boundaries_.fill_cells(fields.stress.pressure);
  }

  [[nodiscard]] std::optional<ClosureUse> use() const override { return use_; }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  closures::StressRatios ratios_;
  double jammed_, lambda_;
  ClosureUse use_;
};

}  // namespace

namespace makers {

namespace {

/// Creates the stress from a table: friction, a fluidised bed's pressure if the file has it, and sheared particles.
void make_table_stress(const Making& m, const std::string& file) {
  const auto& [scene, constants, boundaries, law, fields, effects] = m;
  const core::BoxRegime regime = regime_of_table(file);
  if (const std::string line = missing_checksum(file); !line.empty()) effects.warnings.push_back(line);
  if (regime == core::BoxRegime::bed) {
    effects.solids_stress =
        std::make_unique<TableStress>(scene, constants, boundaries, read_bed_pressure(file), file, fields);
    return;
  }
  const SolidsTable table = read_solids_table(file);
  if (table.bed.phi.empty())
    effects.solids_stress = std::make_unique<FrictionalStress>(scene, constants, boundaries, fields);
  else
    effects.solids_stress =
        std::make_unique<TableStress>(scene, constants, boundaries, bed_curve(table.bed, file), file, fields);
  const TablePlace place = place_of(scene);
  for (const std::string& line : beyond(table, place))
    effects.warnings.push_back("solids stress " + file + ": " + line);
  closures::StressRatios ratios = ratios_at(table, place);
  if (regime == core::BoxRegime::wet) {
    effects.collisions =
        std::make_unique<WetStress>(constants, boundaries, std::move(ratios),
                                    closures::jamming_fraction(place.friction), table.inertia, file, fields);
    return;
  }
  const bool transported = relevance::effects::is_transported(scene);
  auto kinetic = std::make_unique<KineticStress>(scene, constants, boundaries, transported,
                                                 effects.solids_stress->max_packing(), fields);
  std::vector<double> restitution;
  for (const core::Species& s : scene.species)
    restitution.push_back(table.reference_restitution(s.restitution, s.friction));
  kinetic->multiply(std::move(ratios), restitution, file);
  effects.collisions = std::move(kinetic);
}

void make_solids_stress(const Making& m) {
  if (const auto file = table_file(m.law)) {
    make_table_stress(m, *file);
  } else {
    m.effects.solids_stress = std::make_unique<FrictionalStress>(m.scene, m.constants, m.boundaries, m.fields);
    if (relevance::effects::solids_stress.law_has(m.law, relevance::effects::kinetic_theory))
      m.effects.collisions = std::make_unique<KineticStress>(m.scene, m.constants, m.boundaries,
                                                             relevance::effects::is_transported(m.scene),
                                                             m.effects.solids_stress->max_packing(), m.fields);
  }
}

}  // namespace

extern const Maker solids_stress, granular_temperature;
const Maker solids_stress{&relevance::effects::solids_stress, "Stress", make_solids_stress};
const Maker granular_temperature{&relevance::effects::granular_temperature, "Scalar"};

}  // namespace makers

}  // namespace polybed::tfm
