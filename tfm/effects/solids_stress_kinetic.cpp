#include "tfm/effects/solids_stress_kinetic.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/numerics/operators.hpp"
#include "tfm/granular_temperature.hpp"
#include "tfm/solids.hpp"
#include "tfm/solids_viscosity.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// Least solids fraction at which collisions are evaluated: the mean free path is 12 diameters there, and what it makes
/// of shear and compression would grow as 1/phi^2. Below, all that collisions do fades with phi, so that a cell
/// without solids has the temperature that slip and drag give a lone grain: the stress and its work on the temperature
/// alike, or thin solids that fly apart would be driven by what they do not lose.
constexpr double collision_fraction_floor = 0.01;

/// sqrt(theta) that rounds off the slip production at 0, over that of neighbours in the least shear: 0.1 mm/s for 1 mm
/// at 1 1/s.
constexpr double least_agitation = 0.1;

/// 1 down to the least solids fraction of above, then falling to 0 with phi.
double collision_share(double phi) { return std::clamp(phi / collision_fraction_floor, 0.0, 1.0); }

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
      wall_restitution_(scene.tfm.wall_restitution),
      max_packing_(max_packing),
      least_shear_rate_(scene.tfm.least_shear_rate) {
  for (const core::Species& species : scene.species) restitution_.push_back(species.restitution);
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

void KineticStress::multiply(closures::StressRatios ratios, std::vector<double> restitution, const std::string& name) {
  restitution_ = std::move(restitution);
  model_ = closures::KineticModel::garzo_dufty;
  dense_ = false;
  ratios_ = std::move(ratios);
  use_ = ClosureUse{"solids stress " + name};
}

void KineticStress::add(Fields& fields) {
  if (!ratios_) return add_with(fields, NoRatios{});
  add_with(fields, *ratios_);
  core::for_each_row(constants_.grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      const double phi = fields.solids_fraction[std::size_t(c)];
      use_->guarded += phi > collision_fraction_floor && ratios_->outside(phi, 0) ? 1 : 0;
    }
    use_->evaluations += std::uint64_t(end - begin);
  });
}

template <class Ratios>
void KineticStress::add_with(Fields& fields, const Ratios& ratios) {
  core::for_each_row(constants_.grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      const double phi = std::max(fields.solids_fraction[std::size_t(c)], collision_fraction_floor);
      add_cell(fields, c, dense_ ? closures::radial_distribution_dense(phi) : closures::radial_carnahan_starling(phi),
               ratios);
    }
  });
  boundaries_.fill_cells(fields.stress.pressure);
  if (!fields.stress.wall.empty()) boundaries_.fill_cells(fields.stress.wall);
  if (transported_ && !fields.stress.wall.empty()) add_wall_energy(fields);
}

/// g0_j and sum_k h_jk of all species at a solids fraction, the composition that of the cell.
void KineticStress::radial_distributions(const Fields& fields, std::size_t cell, double phi,
                                         std::span<Local> local) const {
  const std::size_t n = constants_.species();
  const double dense =
      dense_ ? closures::radial_distribution_dense(phi).value / closures::radial_carnahan_starling(phi).value : 1.0;
  double surface = 0;
  for (std::size_t k = 0; k < n; ++k) surface += fields.share[k][cell] * phi / constants_.diameter[k];
  for (std::size_t j = 0; j < n; ++j) {
    local[j].g0 = local[j].collisions = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double d = constants_.diameter[j], reach = constants_.diameter[k], share = fields.share[k][cell];
      const double mass_ratio = constants_.density[j] * d * d * d / (constants_.density[k] * reach * reach * reach);
      const double g = dense * closures::radial_of_pair(1 - phi, surface, d, reach);
      local[j].g0 += share * g;
      local[j].collisions += closures::mixture_pressure_of_pair(
          share * phi, g, 0.5 * (restitution_[j] + restitution_[k]), d, reach, mass_ratio);
    }
  }
}

/// What the solids' pressure works against and what their viscosity is sheared by. Both act on all species, shared by
/// volume, so the work of one species' part is done on the motion of all: otherwise species that move apart would make
/// energy. The divergence is that of the faces' sum of phi_j U_j over phi, as the pressure's gradient is divided.
KineticStress::Motion KineticStress::motion_in(const Fields& fields, Index cell) const {
  const core::Grid& grid = constants_.grid;
  Motion motion{0, 0};
  const double* phi = fields.solids_fraction.data();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const Index s = grid.stride(axis);
    const auto velocity = [&](Index face) {
      double sum = 0;
      for (std::size_t j = 0; j < constants_.species(); ++j)
        sum += core::face_mean(fields.solids.fraction[j].data(), face, s) *
               fields.solids.velocity[j][std::size_t(axis)][std::size_t(face)];
      return sum / std::max(core::face_mean(phi, face, s), stress_fraction_floor);
    };
    motion.divergence += (velocity(cell + s) - velocity(cell)) / grid.spacing[std::size_t(axis)];
  }
  for (std::size_t j = 0; j < constants_.species(); ++j)
    motion.strain += fields.share[j][std::size_t(cell)] * fields.stress.strain[j][std::size_t(cell)];
  return motion;
}

/// The factors of the balance of fluctuation energy of one species.
void KineticStress::balance_terms(const Fields& fields, std::size_t c, double phi, std::size_t species,
                                  const Motion& motion, Local& local) const {
  const double rho = constants_.density[species], d = constants_.diameter[species], e = restitution_[species];
  const double slip = fields.slip_superficial[species][c] / std::max(fields.fluid.voidage[c], fluid::voidage_floor);
  const double fade = collision_share(fields.solids_fraction[c]);
  local.compression = fade * rho * (1 + local.collisions) * motion.divergence;
  local.viscosity = fade * closures::kinetic_viscosity(model_, phi, local.g0, e) * rho * d / phi;
  local.shear = local.viscosity * motion.strain;
  local.loss = closures::kinetic_dissipation(model_, phi, local.g0, e) * rho / (d * phi);
  local.drag = closures::fluctuation_drag_sink(fields.solids.exchange[species][c], 1);
  local.slip = closures::slip_production(phi, local.g0, constants_.fluid.viscosity, slip, d, rho);
}

/// Temperatures of one cell, and what they add to pressure, viscosity and the friction of walls.
template <class Ratios>
void KineticStress::add_cell(Fields& fields, Index cell, const closures::RadialValue& radial,
                             const Ratios& ratios) const {
  const auto c = std::size_t(cell);
  const double solids = std::max(fields.solids_fraction[c], 0.0), phi = std::max(solids, collision_fraction_floor);
  const double fade = collision_share(solids);
  const Motion motion = motion_in(fields, cell);
  std::array<Local, most_species> local;
  radial_distributions(fields, c, phi, {local.data(), constants_.species()});
  double wall = 0;
  for (std::size_t j = 0; j < constants_.species(); ++j) {
    Local& here = local[j];
    balance_terms(fields, c, phi, j, motion, here);
    double pressure = 1 + here.collisions, slope = 1 + here.collisions * (2 + phi * radial.slope / radial.value);
    if constexpr (!std::is_same_v<Ratios, NoRatios>) {
      const closures::RatioValues ratio = ratios(phi, 0);
      slope = slope * ratio.pressure.pressure + phi * pressure * ratio.pressure.slope;
      pressure *= ratio.pressure.pressure;
      here.compression *= ratio.pressure.pressure;
      here.viscosity *= ratio.viscosity.pressure;
      here.shear *= ratio.viscosity.pressure;
      here.loss *= ratio.dissipation.pressure;
    }
    double& theta = fields.solids.temperature[j][c];
    double s = std::sqrt(std::max(theta, 0.0));
    if (transported_) {
      find_rate(fields, c, phi, j, here);
    } else {
      s = closures::balanced_speed(here.loss, here.drag + here.compression, here.shear, here.slip);
      theta = s * s;
    }
    const double share = fields.share[j][c], rho = constants_.density[j];
    const double energy = fade * share * rho * s * s;
    fields.stress.pressure[c] += solids * energy * pressure;
    fields.stress.slope[c] += energy * slope;
    fields.stress.viscosity[c] += share * here.viscosity * s;
    wall += share * closures::wall_collisions(s * s, specularity_, rho, 1, here.g0, max_packing_);
  }
  if (!fields.stress.wall.empty()) fields.stress.wall[c] = wall;
}

/// Local part of dtheta/dt, the conductivity, and how fast a disturbance of theta decays.
void KineticStress::find_rate(Fields& fields, std::size_t cell, double phi, std::size_t species,
                              const Local& local) const {
  const double theta = fields.solids.temperature[species][cell], s = std::sqrt(std::max(theta, 0.0));
  const double rho = constants_.density[species], per_energy = 2 / (3 * rho);
  const double least = least_agitation * least_shear_rate_ * constants_.diameter[species];
  const double rounded = std::max(theta, 0.0) + least * least;
  const double slip = local.slip / std::sqrt(rounded);
  fields.solids.temperature_rate[species][cell] =
      per_energy * (local.shear * s - (local.compression + local.drag + local.loss * s) * theta + slip);
  const double conductivity = collision_share(fields.solids_fraction[cell]) *
                              closures::kinetic_conductivity(phi, local.g0, restitution_[species]) * rho *
                              constants_.diameter[species] * s / phi;
  fields.granular.conductivity[species][cell] = conductivity;
  fields.granular.decay[species][cell] =
      per_energy * (local.drag + 1.5 * local.loss * s + 0.5 * slip / rounded + conduction_diagonal_ * conductivity);
}

/// Johnson and Jackson's exchange of fluctuation energy with walls, in the cells that touch them.
void KineticStress::add_wall_energy(Fields& fields) const {
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
          const double phi = std::max(fields.solids_fraction[at], collision_fraction_floor);
          std::array<Local, most_species> local;
          radial_distributions(fields, at, phi, {local.data(), constants_.species()});
          for (std::size_t j = 0; j < constants_.species(); ++j) {
            double speed2 = 0;
            for (int axis = 0; axis < grid.dimensions; ++axis) {
              const double* u = fields.solids.velocity[j][std::size_t(axis)].data();
              const double mean = axis == wall ? 0 : 0.5 * (u[c] + u[c + grid.stride(axis)]);
              speed2 += mean * mean;
            }
            const double gain = closures::wall_energy(fields.solids.temperature[j][at], specularity_, wall_restitution_,
                                                      std::sqrt(speed2), 1, 1, local[j].g0, max_packing_);
            fields.solids.temperature_rate[j][at] += 2.0 / 3 * gain / grid.spacing[std::size_t(wall)];
          }
        }
      });
    }
}

}  // namespace polybed::tfm
