// particles.h5 and particles.xdmf: every particle at each output time, in the order of their ids. How the files are
// kept whole: core/output/steps.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "core/output/blocks.hpp"
#include "core/output/file.hpp"
#include "core/output/steps.hpp"

namespace polybed::core {

/// The particles at one time; all spans have the same length. Vectors are along x, y (upward), z.
struct ParticleSnapshot {
  std::span<const std::int64_t> id;                 ///< rising
  std::span<const std::int32_t> species;            ///< number in the order of the case, from 0
  std::span<const double> radius;                   ///< m
  std::span<const std::array<double, 3>> position;  ///< of the centre, m
  std::span<const std::array<double, 3>> velocity;  ///< m/s
  std::span<const std::array<double, 3>> spin;      ///< angular velocity, rad/s
};

/// What the particles are in, and what they are called.
struct ParticleScene {
  std::array<double, 3> size{};      ///< of the column along x, y, z, m
  std::array<bool, 3> periodic{};    ///< sides joined
  std::vector<std::string> species;  ///< names, in the order of the case
  bool operator==(const ParticleScene&) const = default;
};

/// What the first rank writes of all particles while each writes its share of their vectors.
struct ParticleHead {
  std::vector<std::int64_t> id;  ///< rising
  std::vector<std::int32_t> species;
  std::vector<double> radius;
};

/// Throws NumericsError if a vector of a particle is not finite. \param quantity  as in "velocity"
void require_finite(const char* quantity, std::int64_t id, const std::array<double, 3>& value, double time_s);

class ParticleWriter {
 public:
  /// Starts particles.h5 in a run directory that exists, or goes on with it.
  /// \param resume_time  empty: what an earlier run left is removed. Else s: steps later than that are
  /// removed. Throws FileError, also if the file that it goes on with has another scene.
  /// \param ranks  that write together; null: one. Collective.
  ParticleWriter(const std::filesystem::path& run_directory, ParticleScene scene,
                 std::optional<double> resume_time = std::nullopt, std::shared_ptr<const Ranks> ranks = nullptr);

  /// Stores the particles at a time, any number of them; complete on the disk when it returns.
  /// Throws NumericsError, and writes nothing, if a value is not finite: quantity and id are in the text.
  /// Throws std::invalid_argument if lengths differ, ids do not rise, or a species has no name.
  void write_step(double time_s, const ParticleSnapshot& particles);
  /// The same of particles that no rank has memory for, known to be finite. Collective.
  /// \param head  on the first rank   \param vectors  "position", "velocity" and "spin" of all, in pieces
  void write_step(double time_s, const ParticleHead& head, std::vector<BlockData> vectors);

  /// On the first rank.
  [[nodiscard]] const std::vector<double>& times() const { return steps_->times(); }

 private:
  std::filesystem::path directory_;
  ParticleScene scene_;
  std::shared_ptr<const Ranks> ranks_;
  std::optional<StepWriter> steps_;  ///< on the first rank
};

}  // namespace polybed::core
