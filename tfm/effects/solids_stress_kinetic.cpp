#include "tfm/effects/solids_stress_kinetic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "tfm/granular_temperature.hpp"
#include "tfm/solids.hpp"
#include "tfm/solids_viscosity.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// sqrt(theta) that regularises the slip production at 0, over the agitation of neighbours in the least shear: 0.1 mm/s
/// for 1 mm at 1 1/s.
constexpr double least_agitation = 0.1;
constexpr double wall_restitution = 0.9;  ///< e_w for collisions with Johnson and Jackson's wall

}  // namespace

KineticStress::KineticStress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                             bool transported, double max_packing, Fields& fields)
    : constants_(constants),
      boundaries_(boundaries),
      model_(scene.tfm.kinetic_theory == core::KineticTheory::lun ? closures::KineticModel::lun
                                                                  : closures::KineticModel::garzo_dufty),
      dense_(scene.tfm.radial_distribution == core::RadialDistribution::torquato),
      transported_(transported),
      specularity_(scene.tfm.specularity),
      max_packing_(max_packing),
      least_shear_rate_(scene.tfm.least_shear_rate) {
  for (std::size_t j = 0; j < constants.species(); ++j)
    grains_.push_back({constants.density[j], constants.diameter[j], scene.species[j].restitution});
  const std::vector<core::Field> per_species(constants.species(), core::make_field(constants.grid));
  fields.stress.make_viscous(constants);
  fields.solids.temperature = per_species;
  if (scene.tfm.solids_wall == core::SolidsWall::johnson_jackson) fields.stress.wall = core::make_field(constants.grid);
  if (!transported) return;
  fields.solids.temperature_rate = fields.granular.conductivity = fields.granular.decay = per_species;
  for (core::Field& theta : fields.solids.temperature)
    std::fill(theta.begin(), theta.end(), scene.tfm.start_temperature);
  for (int axis = 0; axis < constants.grid.dimensions; ++axis)
    conduction_diagonal_ += 2 / std::pow(constants.grid.spacing[std::size_t(axis)], 2);
}

void KineticStress::multiply(closures::StressRatios ratios, const std::vector<double>& restitution,
                             const std::string& name) {
  for (std::size_t j = 0; j < grains_.size(); ++j) grains_[j].restitution = restitution[j];
  model_ = closures::KineticModel::garzo_dufty;
  dense_ = false;
  ratios_ = std::move(ratios);
  use_ = ClosureUse{"solids stress " + name};
}

void KineticStress::add(Fields& fields) {
  core::for_each_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
    for (Index from = begin; from < end; from += Index(KineticRows::most)) {
      rows_.cells = std::min(std::size_t(end - from), KineticRows::most);
      add_row(fields, from);
    }
  });
  boundaries_.fill_cells(fields.stress.pressure);
  if (!fields.stress.wall.empty()) boundaries_.fill_cells(fields.stress.wall);
  if (transported_ && !fields.stress.wall.empty()) add_wall_energy(fields);
}

/// Computes temperatures in some cells, and adds to pressure, viscosity and wall friction.
void KineticStress::add_row(Fields& fields, Index begin) {
  core::in_vectors<begin_rows>(rows_, &fields.solids_fraction[std::size_t(begin)], dense_);
  set_motion(fields, begin);
  if (ratios_) set_ratios();
  for (std::size_t j = 0; j < constants_.species(); ++j)
    core::in_vectors<add_surface>(rows_, &fields.share[j][std::size_t(begin)], grains_[j].diameter);
  if (!fields.stress.wall.empty()) std::fill_n(fields.stress.wall.begin() + begin, rows_.cells, 0.0);
  for (std::size_t j = 0; j < constants_.species(); ++j) add_species(fields, j, begin);
}

/// Computes the motion that the solids' pressure and viscosity work on. Both act on all species, shared by volume, so
/// the work uses the mean motion of all: otherwise species that move apart would generate energy. The divergence uses
/// sum phi_j U_j over phi on faces, with the same divisor as the pressure's gradient.
void KineticStress::set_motion(const Fields& fields, Index begin) {
  const core::Grid& grid = constants_.grid;
  std::array<double, KineticRows::most + 1> low, high;
  const auto open = [&](std::size_t axis, Index from, std::size_t faces, double* flow) {
    for (std::size_t f = 0; grid.metric && f < faces; ++f) flow[f] *= grid.metric->open[axis][std::size_t(from) + f];
  };
  for (std::size_t axis = 0; axis < std::size_t(grid.dimensions); ++axis) {
    if (axis == 0) {  // a cell's high face is the next cell's low one
      flow_on_faces(fields, axis, begin, rows_.cells + 1, low.data());
      open(axis, begin, rows_.cells + 1, low.data());
      core::in_vectors<add_divergence>(rows_, low.data(), low.data() + 1, grid.spacing[axis]);
      continue;
    }
    flow_on_faces(fields, axis, begin, rows_.cells, low.data());
    flow_on_faces(fields, axis, begin + grid.stride(int(axis)), rows_.cells, high.data());
    open(axis, begin, rows_.cells, low.data());
    open(axis, begin + grid.stride(int(axis)), rows_.cells, high.data());
    core::in_vectors<add_divergence>(rows_, low.data(), high.data(), grid.spacing[axis]);
  }
  for (std::size_t c = 0; grid.metric && c < rows_.cells; ++c)
    rows_.divergence[c] *= grid.metric->per_volume[std::size_t(begin) + c];
  for (std::size_t j = 0; j < constants_.species(); ++j)
    core::in_vectors<add_strain>(rows_, &fields.share[j][std::size_t(begin)],
                                 &fields.stress.strain[j][std::size_t(begin)]);
}

/// U of all solids, by volume, on the faces from `begin` on.
void KineticStress::flow_on_faces(const Fields& fields, std::size_t axis, Index begin, std::size_t faces,
                                  double* flow) const {
  const Index s = constants_.grid.stride(int(axis));
  std::fill_n(flow, faces, 0.0);
  for (std::size_t j = 0; j < constants_.species(); ++j)
    core::in_vectors<add_flow>(fields.solids.fraction[j].data() + begin, fields.solids.velocity[j][axis].data() + begin,
                               s, faces, flow);
  core::in_vectors<end_flow>(fields.solids_fraction.data() + begin, s, faces, flow);
}

/// Sets the ratios of a measured stress.
void KineticStress::set_ratios() {
  for (std::size_t c = 0; c < rows_.cells; ++c) {
    const closures::RatioValues ratio = (*ratios_)(rows_.phi[c], 0);
    rows_.pressure_ratio[c] = ratio.pressure.pressure;
    rows_.pressure_ratio_slope[c] = ratio.pressure.slope;
    rows_.viscosity_ratio[c] = ratio.viscosity.pressure;
    rows_.loss_ratio[c] = ratio.dissipation.pressure;
    use_->guarded += rows_.fade[c] == 1 && ratios_->outside(rows_.phi[c], 0) ? 1 : 0;
  }
  use_->evaluations += rows_.cells;
}

/// Computes g0_j and sum_k h_jk for a species, with the composition of the cells.
void KineticStress::collide(const Fields& fields, std::size_t species, Index begin) {
  std::fill_n(rows_.g0.begin(), rows_.cells, 0.0);
  std::fill_n(rows_.collisions.begin(), rows_.cells, 0.0);
  for (std::size_t k = 0; k < grains_.size(); ++k)
    core::in_vectors<add_neighbours>(rows_, &fields.share[k][std::size_t(begin)], grains_[species], grains_[k]);
}

void KineticStress::add_species(Fields& fields, std::size_t species, Index begin) {
  const auto row = std::size_t(begin);
  const Grain& grain = grains_[species];
  const double* share = &fields.share[species][row];
  double* temperature = &fields.solids.temperature[species][row];
  collide(fields, species, begin);
  core::in_vectors<set_balance>(rows_, model_, grain,
                                {&fields.slip_superficial[species][row], &fields.fluid.voidage[row],
                                 &fields.solids.exchange[species][row], constants_.fluid.viscosity});
  if (transported_) {
    core::in_vectors<take_speed>(rows_, temperature);
    core::in_vectors<set_temperature_rate>(
        rows_, grain,
        {temperature, &fields.solids.temperature_rate[species][row], &fields.granular.conductivity[species][row],
         &fields.granular.decay[species][row], least_agitation * least_shear_rate_ * grain.diameter,
         conduction_diagonal_});
  } else {
    core::in_vectors<balance_speed>(rows_, temperature);
  }
  core::in_vectors<add_stress>(rows_, share, grain.density,
                               {&fields.stress.pressure[row], &fields.stress.slope[row], &fields.stress.damping[row],
                                &fields.stress.viscosity[row]});
  for (std::size_t c = 0; c < rows_.cells && !fields.stress.wall.empty(); ++c)
    fields.stress.wall[row + c] += share[c] * closures::wall_collisions(rows_.speed[c] * rows_.speed[c], specularity_,
                                                                        grain.density, 1, rows_.g0[c], max_packing_);
}

/// Johnson and Jackson's exchange of fluctuation energy with walls, in the cells next to them.
void KineticStress::add_wall_energy(Fields& fields) {
  const core::Grid& grid = constants_.grid;
  for (int wall = 0; wall < grid.dimensions; ++wall)
    for (int side = 0; side < 2; ++side) {
      if (!boundaries_.stops_solids(wall, side)) continue;
      core::Box box = core::owned_cells(grid);
      box.lo[std::size_t(wall)] = side == 0 ? 0 : grid.cells[std::size_t(wall)] - 1;
      box.hi[std::size_t(wall)] = box.lo[std::size_t(wall)] + 1;
      core::for_each_row(grid, box, [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) {
          const auto at = std::size_t(c);
          rows_.cells = 1;
          core::in_vectors<begin_rows>(rows_, &fields.solids_fraction[at], dense_);
          for (std::size_t j = 0; j < grains_.size(); ++j)
            core::in_vectors<add_surface>(rows_, &fields.share[j][at], grains_[j].diameter);
          for (std::size_t j = 0; j < grains_.size(); ++j) {
            collide(fields, j, c);
            fields.solids.temperature_rate[j][at] +=
                2.0 / 3 * wall_gain(fields, wall, j, c) / grid.size_at_end(wall, side);
          }
        }
      });
    }
}

/// Energy from a wall to a species in a cell, over phi_j rho_j, m3/s3.
double KineticStress::wall_gain(const Fields& fields, int wall, std::size_t species, Index cell) const {
  double speed2 = 0;
  for (int axis = 0; axis < constants_.grid.dimensions; ++axis) {
    if (axis == wall) continue;
    const double* u = fields.solids.velocity[species][std::size_t(axis)].data();
    const double mean = 0.5 * (u[cell] + u[cell + constants_.grid.stride(axis)]);
    speed2 += mean * mean;
  }
  return closures::wall_energy(fields.solids.temperature[species][std::size_t(cell)], specularity_, wall_restitution,
                               std::sqrt(speed2), 1, 1, rows_.g0[0], max_packing_);
}

}  // namespace polybed::tfm
