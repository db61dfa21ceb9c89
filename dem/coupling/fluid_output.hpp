// Stored averages of particles in a fluid: fields.h5, and its part of profiles.h5. The names are as in the continuum
// model, which computes the same quantities.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/output/fields.hpp"
#include "core/output/particles.hpp"
#include "dem/coupling/coupling.hpp"
#include "fluid/smoothing.hpp"
#include "measures/table.hpp"

namespace polybed::dem {

/// Mean velocity, m/s, of each species' particles in cells, [species][axis][cell]: sum w V U over sum w V, with the
/// weights and smoothing of the coupling to the fluid; 0 where there are none.
/// \param round  weights in a round column; null: a box
[[nodiscard]] std::vector<core::FaceField> mean_velocities(const core::Grid& grid, const fluid::Smoothing& smoothing,
                                                           const core::ParticleSnapshot& particles, std::size_t species,
                                                           const RoundWeights* round = nullptr);

/// Used only on the first rank.
class FluidOutput {
 public:
  /// Starts fields.h5 in a run directory, or continues it from a time, s.
  FluidOutput(const Coupling& coupling, std::vector<std::string> species, const std::filesystem::path& directory,
              std::optional<double> resume_time);

  /// Names of its profiles, and their rows: "p", and "u_fluid", the vertical velocity of the fluid.
  [[nodiscard]] static std::vector<std::string> profile_names() { return {"p", "u_fluid"}; }
  [[nodiscard]] static std::vector<std::vector<double>> profiles(const Coupling::Column& column);
  /// The fields after the fluid's last step, with the particles' present velocities.
  void write(double time, const Coupling::Column& column, const core::ParticleSnapshot& particles);

 private:
  std::size_t species_;
  std::vector<measures::Kind> divided_;
  fluid::Smoothing smoothing_;
  std::shared_ptr<const RoundWeights> round_;
  core::FieldWriter fields_;
};

}  // namespace polybed::dem
