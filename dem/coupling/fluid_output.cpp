#include "dem/coupling/fluid_output.hpp"

#include "closures/sphere.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/metric.hpp"
#include "measures/profile.hpp"

namespace polybed::dem {

using core::Field;
using core::Index;

namespace {

std::vector<core::FieldName> field_names(const std::vector<std::string>& species, bool compressible) {
  std::vector<core::FieldName> names{{"voidage"}, {"pressure"}, {"u_fluid", true}};
  for (const std::string& name : species) {
    names.push_back({"phi_" + name});
    names.push_back({"u_" + name, true});
  }
  if (compressible) names.insert(names.end(), {{"total_pressure"}, {"density_fluid"}});
  for (const measures::Kind& kind : measures::divided_species(species))
    names.push_back({.name = "phi_" + kind.name, .sum = true});
  return names;
}

core::FieldValues components(const core::Grid& grid, const core::FaceField& u) {
  return {u.begin(), u.begin() + grid.dimensions};
}

/// Share of a cell below which a species counts as absent from it: residues of a smoothing kernel.
constexpr double no_particles = 1e-12;

/// 1 - sum phi_j: also valid in a resumed run before the fluid's next step.
Field voidage_of(const core::Grid& grid, const std::vector<Field>& fraction) {
  Field eps = core::make_field(grid, 1);
  for (const Field& phi : fraction)
    for (std::size_t c = 0; c < eps.size(); ++c) eps[c] -= phi[c];
  return eps;
}

/// Converts smoothed sums to the open part of a cell.
void per_open_volume(const core::Grid& grid, Field& sums) {
  if (!grid.metric) return;
  for (std::size_t c = 0; c < sums.size(); ++c) sums[c] *= grid.metric->per_volume[c];
}

}  // namespace

std::vector<core::FaceField> mean_velocities(const core::Grid& grid, const fluid::Smoothing& smoothing,
                                             const core::ParticleSnapshot& particles, std::size_t species,
                                             const RoundWeights* round) {
  std::vector<core::FaceField> mean(species, core::make_face_field(grid));
  std::vector<Field> volume(species, core::make_field(grid));
  const double least = no_particles * grid.cell_volume();
  const auto add_all = [&](const auto& weights) {
    for (std::size_t i = 0; i < particles.id.size(); ++i) {
      const double v = closures::sphere_volume(particles.radius[i]);
      const auto j = std::size_t(particles.species[i]);
      for_each_cell(grid.dimensions, weights(particles.position[i]), [&](std::size_t at, double w) {
        volume[j][at] += w * v;
        for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a)
          mean[j][a][at] += w * v * particles.velocity[i][a];
      });
    }
  };
  round != nullptr ? add_all(*round) : add_all(Weights(grid));
  for (std::size_t j = 0; j < species; ++j) {
    per_open_volume(grid, volume[j]);
    for (Field& component : mean[j]) per_open_volume(grid, component);
    if (smoothing.present()) smoothing.smooth_cells(volume[j]);
    for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a) {
      if (smoothing.present()) smoothing.smooth_cells(mean[j][a]);
      for (std::size_t c = 0; c < volume[j].size(); ++c)
        mean[j][a][c] = volume[j][c] > least ? mean[j][a][c] / volume[j][c] : 0;
    }
  }
  return mean;
}

FluidOutput::FluidOutput(const Coupling& coupling, std::vector<std::string> species,
                         const std::filesystem::path& directory, std::optional<double> resume_time)
    : species_(species.size()),
      divided_(measures::divided_species(species)),
      smoothing_(core::whole_column(coupling.flow().grid()), coupling.kernel_width(),
                 !coupling.flow().boundaries().has_outlet()),
      round_(coupling.gather().round()),
      fields_(directory, core::whole_column(coupling.flow().grid()),
              field_names(species, coupling.flow().compressible() != nullptr), resume_time) {}

std::vector<std::vector<double>> FluidOutput::profiles(const Coupling::Column& column) {
  return {measures::lateral_mean(column.grid, column.pressure, measures::Within::linear),
          measures::lateral_mean(column.grid, core::cell_means(column.grid, column.velocity)[1])};
}

void FluidOutput::write(double time, const Coupling::Column& column, const core::ParticleSnapshot& particles) {
  const core::Grid& grid = column.grid;
  const Field voidage = voidage_of(grid, column.fraction);
  const core::FaceField velocity = core::cell_means(grid, column.velocity);
  const std::vector<core::FaceField> means = mean_velocities(grid, smoothing_, particles, species_, round_.get());
  std::vector<core::FieldValues> values{{voidage}, {column.pressure}, components(grid, velocity)};
  for (std::size_t j = 0; j < species_; ++j) {
    values.push_back({column.fraction[j]});
    values.push_back(components(grid, means[j]));
  }
  if (!column.density.empty()) values.insert(values.end(), {{column.total_pressure}, {column.density}});
  std::vector<Field> sums;
  for (const measures::Kind& kind : divided_) sums.push_back(measures::sum_of(column.fraction, kind.members));
  for (const Field& sum : sums) values.push_back({sum});
  fields_.write_step(time, values);
}

}  // namespace polybed::dem
