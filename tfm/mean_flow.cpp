#include "tfm/mean_flow.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/momentum.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Field;
using core::Index;

namespace {

/// With the same bits on any number of ranks.
std::vector<double> mean_fractions(const core::Grid& grid, const fluid::Interphase& solids) {
  std::vector<double> fraction;
  for (const Field& phi : solids.fraction) {
    std::vector<double> cells;
    core::for_each_row(
        grid, [&](Index begin, Index end) { cells.insert(cells.end(), phi.begin() + begin, phi.begin() + end); });
    fraction.push_back(core::sum_of_ranks(grid, cells) / double(grid.column_cell_count()));
  }
  return fraction;
}

}  // namespace

double mean_gradient(const Constants& constants, const fluid::Interphase& solids) {
  if (!constants.grid.periodic[1]) return 0;
  if (constants.given_gradient) return *constants.given_gradient;
  return measures::gradient_of_weight(mean_fractions(constants.grid, solids), constants.density,
                                      constants.fluid.density, constants.gravity * constants.down[1]);
}

void subtract_mean_gradient(const Constants& constants, const fluid::Boundaries& boundaries, double gradient,
                            Fields& fields) {
  constexpr int along = 1;
  const core::Grid& grid = constants.grid;
  const Index s = grid.stride(along);
  const double* eps = fields.fluid.voidage.data();
  double* fluid = fields.fluid_acceleration[along].data();
  core::for_each_row(grid, boundaries.moving_faces(along, true), [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      const double share = constants.form_b ? std::max(face_mean(eps, c, s), fluid::voidage_floor) : 1;
      fluid[c] -= gradient / (share * constants.fluid.density);
    }
  });
  for (std::size_t j = 0; j < constants.species() && fields.solids.carry_pressure; ++j) {
    double* a = fields.solids.acceleration[j][along].data();
    core::for_each_row(grid, boundaries.moving_faces(along, false), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) a[c] -= gradient / constants.density[j];
    });
  }
}

measures::BoxFlow box_flow(const Constants& constants, double gradient, const Fields& fields) {
  constexpr int along = 1;
  const core::Grid& grid = constants.grid;
  const Index s = grid.stride(along);
  const auto mean = [&](const Field& fraction, const core::FaceField& velocity) {
    std::vector<double> flux;
    core::for_each_row(grid, core::owned_faces(grid, along), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c)
        flux.push_back(face_mean(fraction.data(), c, s) * velocity[along][std::size_t(c)]);
    });
    return core::sum_of_ranks(grid, flux) / double(grid.column_cell_count());
  };
  measures::BoxFlow box{.gradient = gradient, .fraction = mean_fractions(grid, fields.solids)};
  double momentum = 0, mass = box.voidage() * constants.fluid.density;
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double flux = mean(fields.solids.fraction[j], fields.solids.velocity[j]);
    box.velocity.push_back(box.fraction[j] > 0 ? flux / box.fraction[j] : 0);
    momentum += constants.density[j] * flux;
    mass += constants.density[j] * box.fraction[j];
  }
  const double of_fluid = mean(fields.fluid.voidage, fields.fluid.velocity);
  box.fluid = of_fluid / box.voidage();
  box.mass_velocity = (momentum + constants.fluid.density * of_fluid) / mass;
  return box;
}

}  // namespace polybed::tfm
