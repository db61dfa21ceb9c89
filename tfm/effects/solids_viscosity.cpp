// Slot Stress: shear viscosity of packed solids from their frictional pressure, Schaeffer's or mu(I).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "closures/frictional_viscosity.hpp"
#include "relevance/effects/solids_viscosity.hpp"
#include "tfm/effects.hpp"
#include "tfm/effects/maker.hpp"
#include "tfm/solids.hpp"

namespace polybed::tfm {

namespace {

using core::Index;

constexpr double friction_angle = 28.5;  ///< delta in Schaeffer's viscosity, degrees: glass beads

/// mu_s from p_f in the cell, the mean diameter and density of its solids, and |gamma|^2 = sum_j x_j 2 D'_j:D'_j.
class FrictionalViscosity : public SolidsViscosity {
 public:
  FrictionalViscosity(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                      const std::string& law, Fields& fields)
      : constants_(constants),
        boundaries_(boundaries),
        inertial_(relevance::effects::solids_viscosity.law_has(law, relevance::effects::by_inertial_number)),
        sine_(std::sin(friction_angle * std::numbers::pi / 180)),
        cap_(scene.tfm.viscosity_cap),
        least_rate_(scene.tfm.least_shear_rate) {
    fields.stress.make_viscous(constants);
    fields.stress.contact = core::make_field(constants.grid);
  }

  void add(Fields& fields) override {
    const auto each_cell = [&](auto&& law) {
      core::for_each_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
        for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
          const double pressure = fields.stress.contact[c];
          if (!(pressure > 0)) continue;
          double strain = 0, diameter = 0, density = 0;
          for (std::size_t j = 0; j < constants_.species(); ++j) {
            const double share = fields.share[j][c];
            strain += share * fields.stress.strain[j][c];
            diameter += share * constants_.diameter[j];
            density += share * constants_.density[j];
          }
          fields.stress.viscosity[c] += law(pressure, closures::shear_rate(strain, least_rate_), diameter, density) /
                                        std::max(fields.solids_fraction[c], stress_fraction_floor);
        }
      });
    };
    if (inertial_)
      each_cell([&](double pressure, double rate, double diameter, double density) {
        return closures::viscosity_mu_i(friction_, pressure, rate, diameter, density, cap_);
      });
    else
      each_cell([&](double pressure, double rate, double, double) {
        return closures::viscosity_schaeffer(pressure, sine_, rate, cap_);
      });
  }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  bool inertial_;  ///< mu(I), else Schaeffer
  closures::InertialFriction friction_;
  double sine_, cap_, least_rate_;
};

}  // namespace

namespace makers {

extern const Maker solids_viscosity;
const Maker solids_viscosity{&relevance::effects::solids_viscosity, "Stress", [](const Making& m) {
                               m.effects.solids_viscosity = std::make_unique<FrictionalViscosity>(
                                   m.scene, m.constants, m.boundaries, m.law, m.fields);
                             }};

}  // namespace makers

}  // namespace polybed::tfm
