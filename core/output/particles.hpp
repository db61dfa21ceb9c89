// particles.h5 and particles.xdmf: every particle at each output time, in the order of their ids. core/output/steps.hpp
// describes how the files stay complete.
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

/// The column of the particles, and the names of their species.
struct ParticleScene {
  std::array<double, 3> size{};      ///< size of the column along x, y, z, m
  std::array<bool, 3> periodic{};    ///< joined sides
  std::vector<std::string> species;  ///< names, in the order of the case
  bool operator==(const ParticleScene&) const = default;
};

/// Data of all particles that the first rank writes, while each rank writes its share of the vectors.
struct ParticleHead {
  std::vector<std::int64_t> id;  ///< rising
  std::vector<std::int32_t> species;
  std::vector<double> radius;
};

/// Throws NumericsError if a vector of a particle is not finite. \param quantity  as in "velocity"
void require_finite(const char* quantity, std::int64_t id, const std::array<double, 3>& value, double time_s);

class ParticleWriter {
 public:
  /// Starts particles.h5 in an existing run directory, or continues it.
  /// \param resume_time  empty: removes what an earlier run left. Else s: removes later steps. Throws FileError, also
  /// if the file to continue has another scene.
  /// \param ranks  that write together; null: one. Collective.
  ParticleWriter(const std::filesystem::path& run_directory, ParticleScene scene,
                 std::optional<double> resume_time = std::nullopt, std::shared_ptr<const Ranks> ranks = nullptr);

  /// Stores the particles at a time, any number of them; complete on the disk when it returns. Throws NumericsError
  /// with quantity and id, and writes nothing, if a value is not finite. Throws std::invalid_argument if lengths
  /// differ, ids do not increase, or a species has no name.
  void write_step(double time_s, const ParticleSnapshot& particles);
  /// The same for particles that no rank has memory for; they must be finite. Collective.
  /// \param head  on the first rank   \param vectors  "position", "velocity" and "spin" of all, in pieces
  void write_step(double time_s, const ParticleHead& head, std::vector<BlockData> vectors);

  /// Available on the first rank.
  [[nodiscard]] const std::vector<double>& times() const { return steps_->times(); }

 private:
  std::filesystem::path directory_;
  ParticleScene scene_;
  std::shared_ptr<const Ranks> ranks_;
  std::optional<StepWriter> steps_;  ///< on the first rank
};

}  // namespace polybed::core
