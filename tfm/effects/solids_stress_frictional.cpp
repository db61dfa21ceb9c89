#include "tfm/effects/solids_stress_frictional.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tfm/max_packing.hpp"
#include "tfm/packing_limit.hpp"
#include "tfm/solids.hpp"
#include "tfm/step_estimate.hpp"

namespace polybed::tfm {

using core::Index;

FrictionalStress::FrictionalStress(const core::Scene& scene, const Constants& constants,
                                   const fluid::Boundaries& boundaries, Fields& fields, bool alone)
    : constants_(constants),
      boundaries_(boundaries),
      mixture_packing_(mixture_rule(scene)),
      species_packing_(species_packings(scene)),
      bulk_viscosity_(bulk_viscosity_of(scene, constants.grid)),
      cell_width_(constants.grid.smallest_spacing()) {
  law_.strength = scene.tfm.frictional_pressure;
  law_.onset = scene.tfm.frictional_onset;
  law_.max_packing = max_packing_of(scene, constants.bed_share, constants.fluid.density);
  // Between joined ends nothing bears a bed: forces towards a bottom would move the whole box.
  const bool borne = alone && !constants.grid.periodic[1];
  const double heavy = borne ? (mean_density(constants) - constants.fluid.density) * constants.gravity : 0;
  for (std::size_t a = 0; a < 3 && heavy != 0; ++a)
    lies_towards_[a] = std::copysign(constants.down[a], heavy * constants.down[a]);
  for (std::size_t a = 0; a < 3; ++a)
    if (lies_towards_[a] != 0) fields.stress.upwind_work[a] = core::make_field(constants.grid);
  const double load = std::abs(heavy) * settled_height(scene);
  wave_speed_ = std::sqrt(law_(law_.solids_fraction_at(load)).slope / mean_density(constants));
  fields.stress.pressure = core::make_field(constants.grid);
  fields.stress.slope = core::make_field(constants.grid);
  fields.stress.damping = core::make_field(constants.grid);
}

/// Calls body(cell, phi_max) for the cells of a box.
template <class Body>
void FrictionalStress::for_each_cell_with_packing(const Fields& fields, const core::Box& box, Body&& body) const {
  if (mixture_packing_ == nullptr) {
    core::for_each_row(constants_.grid, box, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) body(c, law_.max_packing);
    });
    return;
  }
  std::array<double, most_species> share{};
  core::for_each_row(constants_.grid, box, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      for (std::size_t j = 0; j < constants_.species(); ++j) share[j] = fields.share[j][std::size_t(c)];
      body(c, mixture_packing_({share.data(), constants_.species()}, constants_.diameter, species_packing_));
    }
  });
}

double FrictionalStress::packing_of(std::span<const double> share) const {
  return mixture_packing_ == nullptr ? law_.max_packing
                                     : mixture_packing_(share, constants_.diameter, species_packing_);
}

double FrictionalStress::packing_above(const Fields& fields) const {
  double most = 0;
  for_each_cell_with_packing(fields, boundaries_.solids_cells(), [&](Index c, double packing) {
    most = std::max(most, fields.solids_fraction[std::size_t(c)] - packing);
  });
  return most;
}

double FrictionalStress::pressure_at(double solids_fraction) const { return law_(solids_fraction).pressure; }

/// The surface row supports the part that the law alone does not.
double FrictionalStress::pressure_on_top(double solids_fraction, double half_weight) const {
  return std::max(pressure_at(solids_fraction), half_weight);
}

double FrictionalStress::solids_fraction_at(double pressure) const { return law_.solids_fraction_at(pressure); }

void FrictionalStress::evaluate(Fields& fields) {
  const double* phi = fields.solids_fraction.data();
  double *pressure = fields.stress.pressure.data(), *slope = fields.stress.slope.data();
  core::Box cells = boundaries_.solids_cells();  // and ghosts for charge_upwind_work(), before neighbours send theirs
  for (int axis = 0; axis < constants_.grid.dimensions; ++axis) {
    if (lies_towards_[std::size_t(axis)] == 0) continue;
    cells.lo[std::size_t(axis)] -= constants_.grid.ghosts(axis);
    cells.hi[std::size_t(axis)] += constants_.grid.ghosts(axis);
  }
  for_each_cell_with_packing(fields, cells, [&](Index c, double packing) {
    const closures::StressValue value = law_.at(phi[c], packing);
    pressure[c] = value.pressure;
    slope[c] = value.slope;
  });
  for (int axis = 0; axis < constants_.grid.dimensions; ++axis)
    if (lies_towards_[std::size_t(axis)] != 0) charge_upwind_work(axis, fields);
  hold_surface(fields);
  if (!fields.stress.contact.empty()) {
    std::copy(fields.stress.pressure.begin(), fields.stress.pressure.end(), fields.stress.contact.begin());
    boundaries_.fill_cells(fields.stress.contact);
  }
  if (bulk_viscosity_ > 0)
    add_bulk_viscosity(fields);
  else
    std::fill(fields.stress.damping.begin(), fields.stress.damping.end(), 0.0);  // collisions add to it
  boundaries_.fill_cells(fields.stress.pressure);
}

void FrictionalStress::charge_upwind_work(int axis, Fields& fields) const {
  const auto a = std::size_t(axis);
  const core::Grid& grid = constants_.grid;
  const Index s = grid.stride(axis);
  const bool down = lies_towards_[a] > 0;  // towards higher cells, along gravity
  const Index under = down ? 0 : -s, above = down ? -s : 0, below = under + (down ? s : -s);
  const double *phi = fields.solids_fraction.data(), *pressure = fields.stress.pressure.data();
  const double density = mean_density(constants_);
  const double even =
      std::abs((density - constants_.fluid.density) * constants_.gravity * lies_towards_[a]) * grid.spacing[a];
  double* jump = fields.stress.upwind_work[a].data();
  core::for_each_row(grid, boundaries_.moving_faces(axis, false), [&](Index begin, Index end) {
    const bool graded = axis == 1 && grid.layers;
    const double weight = graded ? even / grid.metric->per_distance[1][std::size_t(begin)] : even;
    const double slow = weight / (density * wave_speed_), carried_whole = 0.5 * law_.onset * weight;
    for (Index f = begin; f < end; ++f) {
      jump[f] = 0;
      const double looser = 1 - phi[f + above] / law_.onset;
      if (!(looser > 0 && phi[f + above] < phi[f + under])) continue;
      const double carried = std::max(pressure[f + under], phi[f + under] < phi[f + below] ? pressure[f + below] : 0.0);
      if (!(carried > 0)) continue;
      double flux = 0, fraction = 0;
      for (std::size_t j = 0; j < constants_.species(); ++j) {
        const double part = std::max(core::face_mean(fields.solids.fraction[j].data(), f, s), 0.0);
        flux += part * fields.solids.velocity[j][a][std::size_t(f)];
        fraction += part;
      }
      const double excess = 0.5 * (phi[f + under] - std::max(phi[f + above], 0.0));
      jump[f] = std::min(carried / carried_whole, 1.0) * std::min(20 * looser, 1.0) * weight * excess * flux /
                (std::abs(flux) + fraction * slow);
    }
  });
}

void FrictionalStress::hold_surface(Fields& fields) const {
  constexpr double dust = 0.02;  // solids fraction in the surface row; above it the bed is still settling
  const core::Grid& grid = constants_.grid;
  const double* phi = fields.solids_fraction.data();
  double *pressure = fields.stress.pressure.data(), *slope = fields.stress.slope.data();
  std::array<double, most_species> share{};
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const double along = lies_towards_[std::size_t(axis)];
    if (along == 0) continue;
    const Index below = along > 0 ? grid.stride(axis) : -grid.stride(axis);
    core::for_each_row(grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) {
        const double under = phi[c + below], next = phi[c + 2 * below];
        const bool on_packed = under > law_.onset, on_held = !on_packed && next > law_.onset && under < next;
        if (!((on_packed || on_held) && phi[c] < under)) continue;
        const Index packed = c + (on_packed ? 1 : 2) * below;
        for (std::size_t j = 0; j < constants_.species(); ++j) share[j] = fields.share[j][std::size_t(packed)];
        const double load =
            along * along * law_.at(phi[packed], packing_of({share.data(), constants_.species()})).pressure;
        // Distances of centres downwards over the one upwards: 1 where layers are even.
        const auto apart = [&](Index cells) {
          const auto face = [&](Index n) { return std::size_t(c + n * below + (below > 0 ? below : 0)); };
          if (axis != 1 || !grid.layers) return 1.0;
          return grid.metric->per_distance[1][face(-1)] / grid.metric->per_distance[1][face(cells)];
        };
        const double near = apart(0), far = apart(1);
        const double between = on_held ? next * far + (near + far) * under : near * under,
                     whole = between + (1 + near) * phi[c];
        const double held =
            on_held ? std::max(1 - phi[c] / dust, 0.0) * phi[c] / (std::abs(phi[c]) + stress_fraction_floor) : 1;
        pressure[c] = std::max(pressure[c], held * load * phi[c] / whole);
        // Neglects the derivative of the fade at `dust`: only the damping and the preconditioner use the slope.
        slope[c] = std::max(slope[c], held * (2 - held) * load * between / (whole * whole));
      }
    });
  }
}

void FrictionalStress::add_bulk_viscosity(Fields& fields) const {
  core::with_metric(constants_.grid, [&](const auto& metric) { add_bulk_viscosity(metric, fields); });
}

template <class Metric>
void FrictionalStress::add_bulk_viscosity(const Metric& metric, Fields& fields) const {
  const core::Grid& grid = constants_.grid;
  const double* slope = fields.stress.slope.data();
  double *pressure = fields.stress.pressure.data(), *damping = fields.stress.damping.data();
  core::for_each_row(grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      damping[c] = 0;
      if (!(slope[c] > 0)) continue;
      double density = 0, compression = 0;
      for (std::size_t j = 0; j < constants_.species(); ++j) {
        density += fields.share[j][std::size_t(c)] * constants_.density[j];
        double divergence = 0;
        for (int axis = 0; axis < grid.dimensions; ++axis) {
          const auto a = std::size_t(axis);
          const double* u = fields.solids.velocity[j][a].data();
          const Index next = c + grid.stride(axis);
          divergence +=
              metric.per_volume(c) * (metric.open(a, next) * u[next] - metric.open(a, c) * u[c]) / grid.spacing[a];
        }
        compression += fields.solids.fraction[j][std::size_t(c)] * divergence;
      }
      damping[c] = bulk_viscosity_ * cell_width_ * std::sqrt(slope[c] * density);
      pressure[c] -= damping[c] * compression;
    }
  });
}

}  // namespace polybed::tfm
