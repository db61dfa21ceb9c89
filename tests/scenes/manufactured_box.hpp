// The manufactured solution in a joined box, with every effect on: how far a state that starts as the solution is from
// it later. Cells may be of any shape.
#pragma once

#include <functional>

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

/// A solution, and the places whose mean an unknown of it is: without the latter the centre of its cell or face.
struct Solution {
  int dimensions;  ///< 3 around an axis: hoop terms are derivatives across the plane
  std::function<Exact(const std::array<double, 3>&)> at;
  std::function<std::vector<std::array<double, 3>>(const std::array<double, 3>& centre, int axis)> places;
};

/// The solution that fills the box of a scene.
inline Solution solution_of_box(const core::Scene& scene) {
  const int n = scene.column.dimensions;
  return {n, [n, length = scene.column.size[0]](const auto& x) { return exact(x, n, length); }, {}};
}

/// The equations with the sources added before the pressure acts.
class Driven : public BoxEquations {
 public:
  /// \param flux  of the fractions
  Driven(const core::Scene& scene, tfm::Scheme flux, tfm::Scheme momentum)
      : Driven(scene, joined_box(scene), flux, momentum, solution_of_box(scene)) {}

  /// \param box  with the axes that are joined
  Driven(const core::Scene& scene, const tfm::Constants& box, tfm::Scheme flux, tfm::Scheme momentum,
         const Solution& solution)
      : BoxEquations(scene, box, {flux, momentum, fluid::WallSlip::free_slip}, 1e-10),
        solution_(layout().size()),
        open_(layout().size()),
        source_(constants()) {
    const closures::FrictionalLaw stress{scene.tfm.frictional_pressure, scene.tfm.frictional_onset, 0.64};
    const closures::SpeciesPair pair{constants().diameter[0], constants().diameter[1],    constants().density[0],
                                     constants().density[1],  scene.material.restitution, scene.material.friction};
    const Laws laws{closures::drag_law(scene.effects.at("drag"), closures::Guard::off), stress, pair};
    tfm::Constants exact_constants = constants();
    exact_constants.grid.dimensions = solution.dimensions;
    tfm::Fields value(constants()), open(constants());
    for_each_place(-1, solution, [&](std::size_t c, double weight, double share, const Exact& e) {
      const Sources s = sources(e, exact_constants, laws);
      for (std::size_t j = 0; j < 2; ++j) {
        open.solids.fraction[j][c] = weight;
        value.solids.fraction[j][c] += share * e.phi[j].v;
        source_.solids.fraction_rate[j][c] += share * s.phi[j];
      }
    });
    for (int axis = 0; axis < constants().grid.dimensions; ++axis)
      for_each_place(axis, solution, [&](std::size_t c, double weight, double share, const Exact& e) {
        const auto a = std::size_t(axis);
        const Sources s = sources(e, exact_constants, laws);
        for (std::size_t j = 0; j < 2; ++j) {
          open.solids.velocity[j][a][c] = weight;
          value.solids.velocity[j][a][c] += share * e.u[j][a].v;
          source_.solids.acceleration[j][a][c] += share * s.u[j][a];
        }
        open.fluid.flux[a][c] = weight;
        value.fluid.flux[a][c] += share * e.flux[a].v;
        source_.flux_rate.free[a][c] += share * s.flux[a];
      });
    layout().pack(value.solids, value.fluid, solution_);
    layout().pack(open.solids, open.fluid, open_);
  }

  /// Error at a time of a state that starts as the solution, where cells and faces are open. Time adds less than 1 % to
  /// it: rtol is 1e-6.
  Error error(double until) {
    std::vector<double> y = solution_;
    advance(y, until, 1e-6);
    double fractions = 0, velocities = 0;
    std::size_t fields_on_cells = 0;
    for (const tfm::StateLayout::Entry& entry : layout().entries()) {
      double sum = 0, count = 0;
      for (std::size_t n = entry.begin; n < entry.begin + entry.size; ++n) {
        sum += open_[n] * std::abs(y[n] - solution_[n]);
        count += open_[n];
      }
      (entry.axis < 0 ? fractions : velocities) += sum / count;
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
  /// Calls body(entry, share, solution) for the places of all open cells (axis -1) or of all open faces of an axis
  /// between cells; the shares of an entry add up to 1.
  template <class Body>
  void for_each_place(int axis, const Solution& solution, Body&& body) const {
    const core::Grid& grid = constants().grid;
    const auto a = std::size_t(std::max(axis, 0));
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 0; i < grid.cells[0]; ++i) {
          const std::array<int, 3> cell{i, j, k};
          const auto c = std::size_t(grid.index(i, j, k));
          if (axis >= 0 && cell[a] == 0 && !grid.periodic[a]) continue;
          const double open = grid.metric ? (axis < 0 ? grid.metric->volume : grid.metric->open[a])[c] : 1;
          if (!(open > 0)) continue;
          std::array<double, 3> x{grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)};
          if (axis >= 0) x[a] = grid.low(axis, cell[a]);
          const auto places = solution.places ? solution.places(x, axis) : std::vector{x};
          for (const auto& place : places) body(c, open, 1 / double(places.size()), solution.at(place));
        }
  }

  std::vector<double> solution_, open_;  ///< open_: 1, or 0 where a wall closes
  tfm::Fields source_;
};

}  // namespace polybed::scenes
