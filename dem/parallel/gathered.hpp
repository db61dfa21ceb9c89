// Particles, contacts and what is kept of them, of all ranks, put together on the first in an order that does not
// depend on the ranks.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "core/output/particles.hpp"
#include "dem/parallel/exchange.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

// Collective; empty but on the first rank.

/// Owned particles of all ranks by id, by component, as the files want them.
struct Snapshot {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> species;
  std::vector<double> radius;
  std::vector<Vector> position, velocity, spin;

  [[nodiscard]] core::ParticleSnapshot view() const { return {id, species, radius, position, velocity, spin}; }
};
[[nodiscard]] Snapshot gathered_snapshot(const Particles& particles, const std::shared_ptr<const core::Ranks>& ranks);
/// The same for particles.h5: the head, and vectors in pieces. The particles must stay.
struct ShownRows {
  core::ParticleHead head;
  std::vector<core::BlockData> vectors;
};
[[nodiscard]] ShownRows shown_rows(const Particles& particles, const std::shared_ptr<const core::Ranks>& ranks);
/// What the fluid does to them, by id.
[[nodiscard]] std::vector<KeptLoad> gathered_loads(const std::vector<KeptLoad>& loads,
                                                   const std::shared_ptr<const core::Ranks>& ranks);
/// Rows of all ranks by their first numbers, which are ids; what several ranks have, as contacts across them, once.
/// \param ids  one or two
[[nodiscard]] std::vector<double> gathered_rows(std::vector<double> own, std::size_t width, std::size_t ids,
                                                const std::shared_ptr<const core::Ranks>& ranks);

}  // namespace polybed::dem
