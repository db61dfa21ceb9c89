#include "hard/bed_invariants.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/numerics/metric.hpp"
#include "fluid/boundaries.hpp"
#include "measures/bed.hpp"
#include "tfm/observers.hpp"

namespace polybed::hard {

using core::Index;

namespace {

/// Momentum that the fluid brings in per time and area less what it takes out, Pa: it enters between the particles,
/// faster than it leaves.
double thrust(const tfm::Model& model, const tfm::Fields& fields, const measures::Profile& profile) {
  const auto voidage = [&](std::size_t k) {
    double eps = 1;
    for (const std::vector<double>& phi : profile.fraction) eps -= phi[k];
    return eps;
  };
  const core::Grid& grid = model.constants().grid;
  double flux = 0;
  core::with_metric(grid, [&](const auto& metric) {
    fluid::for_each_boundary_row(grid, 1, 0, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) flux += metric.open(1, c) * fields.fluid.flux[1][std::size_t(c)];
    });
  });
  flux /= core::open_cells_of_layer(grid);
  return model.constants().fluid.density * flux * flux * (1 / voidage(0) - 1 / voidage(profile.fraction[0].size() - 1));
}

}  // namespace

double fastest(const core::Grid& grid, const tfm::Fields& fields, double above) {
  double most = 0;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    core::for_each_row(grid, core::interior_faces(grid, axis), [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f) {
        most = std::max(most, std::abs(fields.fluid.flux[a][std::size_t(f)]));
        if (!(core::face_mean(fields.solids_fraction.data(), f, grid.stride(axis)) > above)) continue;
        for (std::size_t j = 0; j < fields.solids.species(); ++j)
          most = std::max(most, std::abs(fields.solids.velocity[j][a][std::size_t(f)]));
      }
    });
  }
  return most;
}

double characteristic_time(const tfm::Model& model, const tfm::Fields& fields) {
  constexpr double some = 1e-9;
  const core::Grid& grid = model.constants().grid;
  double shortest = grid.spacing[1] / std::max(fastest(grid, fields, some), model.velocity_scale());
  for (const tfm::TimeScale& scale : tfm::time_scales(model.constants(), fields, 0))
    if (scale.process == "drag") shortest = std::min(shortest, scale.seconds);
  return shortest;
}

double force_balance(const tfm::Model& model, const tfm::Fields& fields) {
  const tfm::Constants& constants = model.constants();
  measures::Profile profile;
  profile.slab = constants.grid.spacing[1];
  for (const core::Field& phi : fields.solids.fraction)
    profile.fraction.push_back(measures::lateral_mean(constants.grid, phi));
  profile.pressure = measures::lateral_mean(constants.grid, fields.fluid.pressure);
  double weight = 0;
  for (std::size_t j = 0; j < constants.species(); ++j)
    for (const double phi : profile.fraction[j])
      weight += phi * profile.slab * (constants.density[j] - constants.fluid.density) * constants.gravity;
  double carried = measures::pressure_drop(profile) + thrust(model, fields, profile);
  if (fields.stress.present()) {
    profile.pressure = measures::lateral_mean(constants.grid, fields.stress.pressure);
    carried += measures::pressure_drop(profile);
  }
  return carried / weight - 1;
}

double sum_of(const tfm::Fields& fields) {
  double sum = 0;
  const auto add = [&](const core::Field& field) { sum = std::accumulate(field.begin(), field.end(), sum); };
  const auto add_all = [&](const auto& list) { std::for_each(list.begin(), list.end(), add); };
  add(fields.fluid.pressure);
  add_all(fields.fluid.flux);
  add_all(fields.fluid.velocity);
  add_all(fields.solids.fraction);
  add_all(fields.solids.exchange);
  add_all(fields.solids.temperature);
  for (const core::FaceField& velocity : fields.solids.velocity) add_all(velocity);
  add(fields.stress.pressure);
  return sum;
}

}  // namespace polybed::hard
