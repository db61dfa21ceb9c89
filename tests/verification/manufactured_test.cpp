// Order in space of the whole system by a manufactured solution: two species, every effect on, all sides joined.
#include <gtest/gtest.h>

#include "box_equations.hpp"
#include "manufactured.hpp"

namespace polybed::verification {
namespace {

/// What sets the sizes of the terms: length of the box, viscosity, diameter of the first species, and how long errors
/// gather. SI.
struct Regime {
  double length, viscosity, diameter, time;
};

/// A liquid bed: drag rules, errors gather for ten relaxation times of the slip.
constexpr Regime bed{0.1, 5e-3, 1e-3, 0.1};
/// No bed, but all terms within 0.1 to 3 m/s2: convection, stress, exchanges, viscosity. A short time, because several
/// solids of different velocities under one pressure are ill-posed where drag does not rule: fine ripples would grow.
constexpr Regime balanced{0.01, 1e-2, 8e-3, 0.002};

core::Scene all_effects(const Regime& regime, int dimensions, int cells) {
  core::Scene scene = two_species_box(dimensions, cells, regime.length, regime.diameter, regime.viscosity);
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
  Driven(const core::Scene& scene, tfm::Scheme scheme, bool conservative)
      : BoxEquations(scene, joined_box(scene), {scheme, scheme, fluid::WallSlip::free_slip, conservative}, 1e-10),
        solution_(layout().size()),
        source_(constants()) {
    const closures::FrictionalLaw stress{scene.tfm.frictional_pressure, scene.tfm.frictional_onset, 0.64};
    const closures::SpeciesPair pair{constants().diameter[0], constants().diameter[1], constants().density[0],
                                     constants().density[1],  scene.dem.restitution,   scene.dem.friction};
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
          if (axis >= 0) x[std::size_t(axis)] -= 0.5 * grid.spacing[std::size_t(axis)];
          body(std::size_t(grid.index(i, j, k)), exact(x, grid.dimensions, grid.cells[0] * grid.spacing[0]));
        }
  }

  std::vector<double> solution_;
  tfm::Fields source_;
};

/// The error on grids of n, 2n, 4n cells a side.
std::array<Error, 3> errors(const Regime& regime, int dimensions, int n, tfm::Scheme scheme,
                            bool conservative = false) {
  std::array<Error, 3> found{};
  for (Error& e : found) {
    e = Driven(all_effects(regime, dimensions, n), scheme, conservative).error(regime.time);
    record(fmt::format("fraction, {}", n), e.fraction);
    record(fmt::format("velocity, {}", n), e.velocity);
    n *= 2;
  }
  return found;
}

/// Each halving divides the errors of velocities and of fractions by these factors at least.
void expect_order(const std::array<Error, 3>& e, double velocity, double fraction) {
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_GT(e[n].velocity / e[n + 1].velocity, velocity) << "halving " << n + 1;
    EXPECT_GT(e[n].fraction / e[n + 1].fraction, fraction) << "halving " << n + 1;
  }
}

void expect_order(const std::array<Error, 3>& e, double factor) { expect_order(e, factor, factor); }

// Factors: 4 and 2 for smooth fields, less what the limiter loses at extrema (3.2) and the next term (1.8). Bounds on
// the middle grid: a fifth above what was measured when the test was written.
TEST(Manufactured, SecondOrderInTwoDimensionsWithLimitedSchemes) {
  const auto e = errors(bed, 2, 32, tfm::Scheme::limited);
  expect_order(e, 3.2);
  EXPECT_LT(e[1].fraction, 4.2e-5);
  EXPECT_LT(e[1].velocity, 8.5e-5);
}

TEST(Manufactured, FirstOrderInTwoDimensionsWithUpwindSchemes) {
  const auto e = errors(bed, 2, 32, tfm::Scheme::upwind);
  expect_order(e, 1.8);
  EXPECT_LT(e[1].fraction, 3.2e-4);
  EXPECT_LT(e[1].velocity, 7.2e-4);
}

// The same where every term counts, so that none can hide behind drag. Velocities as above. Fractions have had no time
// to run over their extrema: the ripples of h^2 that limiters leave there are differentiated once, by div U, and the
// factor is short of 3.2 (2.81 and 3.13 when the test was written; 3.99 and 3.97 with the limiters taken out).
TEST(Manufactured, SecondOrderWhereAllTermsCount) {
  const auto e = errors(balanced, 2, 32, tfm::Scheme::limited);
  expect_order(e, 3.2, 2.7);
  EXPECT_LT(e[1].fraction, 1.3e-5);
  EXPECT_LT(e[1].velocity, 7.5e-6);
}

TEST(Manufactured, FirstOrderWhereAllTermsCount) {
  const auto e = errors(balanced, 2, 32, tfm::Scheme::upwind);
  expect_order(e, 1.8);
  EXPECT_LT(e[1].velocity, 1.0e-4);
}

// Momentum in conservative form, where convection counts: the same orders, for the same reasons.
TEST(Manufactured, ConservativeMomentumIsOfSecondOrderWithSlopes) {
  expect_order(errors(balanced, 2, 32, tfm::Scheme::limited, true), 3.2, 2.7);
}

TEST(Manufactured, ConservativeMomentumIsOfFirstOrderWithout) {
  expect_order(errors(balanced, 2, 32, tfm::Scheme::upwind, true), 1.8);
}

TEST(Manufactured, SecondOrderInThreeDimensionsWithLimitedSchemes) {
  expect_order(errors(bed, 3, 6, tfm::Scheme::limited), 3.2);
}

TEST(Manufactured, FirstOrderInThreeDimensionsWithUpwindSchemes) {
  expect_order(errors(bed, 3, 6, tfm::Scheme::upwind), 1.8);
}

}  // namespace
}  // namespace polybed::verification
