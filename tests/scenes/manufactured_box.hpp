// The manufactured solution in a joined box, with every effect on: how far a state that starts as the solution is from
// it later. Cells may be of any shape.
#pragma once

#include "scenes/box_equations.hpp"
#include "scenes/manufactured.hpp"

namespace polybed::scenes {

/// What sets the sizes of the terms: length of the box, viscosity, diameter of the first species, and how long errors
/// gather. SI.
struct Regime {
  double length, viscosity, diameter, time;
};

/// A liquid bed: drag rules, errors gather for ten relaxation times of the slip.
constexpr Regime liquid_bed{0.1, 5e-3, 1e-3, 0.1};
/// No bed, but all terms within 0.1 to 3 m/s2: convection, stress, exchanges, viscosity. A short time, because several
/// solids of different velocities under one pressure are ill-posed where drag does not rule: fine ripples would grow.
constexpr Regime balanced{0.01, 1e-2, 8e-3, 0.002};

/// The box of two species in this regime; cells may be of any shape.
inline core::Scene all_effects(const Regime& regime, int dimensions, std::array<int, 3> cells) {
  core::Scene scene = two_species_box(dimensions, cells[1], regime.length, regime.diameter, regime.viscosity);
  scene.column.cells = cells;
  scene.bed.volume_share = {0.5625, 0.4375};
  scene.tfm.bulk_viscosity = 0;
  scene.tfm.pressure_tolerance = 1e-10;
  return scene;
}

/// Mean error of a fraction and of a velocity, m/s: means over cells or faces, species and axes.
struct Error {
  double fraction, velocity;
};

/// The equations with the sources added before the pressure acts.
class Driven : public BoxEquations {
 public:
  /// \param flux  of the fractions
  Driven(const core::Scene& scene, tfm::Scheme flux, tfm::Scheme momentum)
      : BoxEquations(scene, joined_box(scene), {flux, momentum, fluid::WallSlip::free_slip}, 1e-10),
        solution_(layout().size()),
        source_(constants()) {
    const closures::FrictionalLaw stress{scene.tfm.frictional_pressure, scene.tfm.frictional_onset, 0.64};
    const closures::SpeciesPair pair{constants().diameter[0], constants().diameter[1],    constants().density[0],
                                     constants().density[1],  scene.material.restitution, scene.material.friction};
    const Laws laws{closures::drag_law(scene.effects.at("drag"), closures::Guard::off), stress, pair};
    tfm::Fields value(constants());
    for_each_place(-1, [&](std::size_t c, const Exact& e) {
      const Sources s = sources(e, constants(), laws);
      for (std::size_t j = 0; j < 2; ++j) {
        value.solids.fraction[j][c] = e.phi[j].v;
        source_.solids.fraction_rate[j][c] = s.phi[j];
      }
    });
    for (int axis = 0; axis < constants().grid.dimensions; ++axis)
      for_each_place(axis, [&](std::size_t c, const Exact& e) {
        const auto a = std::size_t(axis);
        const Sources s = sources(e, constants(), laws);
        for (std::size_t j = 0; j < 2; ++j) {
          value.solids.velocity[j][a][c] = e.u[j][a].v;
          source_.solids.acceleration[j][a][c] = s.u[j][a];
        }
        value.fluid.flux[a][c] = e.flux[a].v;
        source_.flux_rate.free[a][c] = s.flux[a];
      });
    layout().pack(value.solids, value.fluid, solution_);
  }

  /// Error at a time of a state that starts as the solution. Time adds less than 1 % to it: rtol is 1e-6.
  Error error(double until) {
    std::vector<double> y = solution_;
    advance(y, until, 1e-6);
    double fractions = 0, velocities = 0;
    std::size_t fields_on_cells = 0;
    for (const tfm::StateLayout::Entry& entry : layout().entries()) {
      double mean = 0;
      for (std::size_t n = entry.begin; n < entry.begin + entry.size; ++n)
        mean += std::abs(y[n] - solution_[n]) / double(entry.size);
      (entry.axis < 0 ? fractions : velocities) += mean;
      fields_on_cells += entry.axis < 0;
    }
    return {fractions / double(fields_on_cells), velocities / double(layout().entries().size() - fields_on_cells)};
  }

 protected:
  void add(tfm::Fields& fields) override {
    const auto plus = [](core::Field& rate, const core::Field& source) {
      for (std::size_t c = 0; c < rate.size(); ++c) rate[c] += source[c];
    };
    for (std::size_t j = 0; j < 2; ++j) plus(fields.solids.fraction_rate[j], source_.solids.fraction_rate[j]);
    for (std::size_t a = 0; a < std::size_t(constants().grid.dimensions); ++a) {
      for (std::size_t j = 0; j < 2; ++j) plus(fields.solids.acceleration[j][a], source_.solids.acceleration[j][a]);
      plus(fields.flux_rate.free[a], source_.flux_rate.free[a]);
    }
    boundaries().join(fields.flux_rate.free);
  }

 private:
  /// Calls body(entry, solution) at the centres of all cells (axis -1) or of all faces of an axis.
  template <class Body>
  void for_each_place(int axis, Body&& body) const {
    const core::Grid& grid = constants().grid;
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 0; i < grid.cells[0]; ++i) {
          std::array<double, 3> x{grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)};
          if (axis >= 0) x[std::size_t(axis)] = grid.low(axis, std::array{i, j, k}[std::size_t(axis)]);
          body(std::size_t(grid.index(i, j, k)), exact(x, grid.dimensions, grid.cells[0] * grid.spacing[0]));
        }
  }

  std::vector<double> solution_;
  tfm::Fields source_;
};

}  // namespace polybed::scenes
