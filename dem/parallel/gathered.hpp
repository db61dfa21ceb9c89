// Particles, contacts and their stored data from all ranks, combined on the first in an order that does not depend on
// the ranks.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "core/output/particles.hpp"
#include "dem/parallel/exchange.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

// Collective; empty except on the first rank.

/// Owned particles on all ranks by id, by component, as the files need them.
struct Snapshot {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> species;
  std::vector<double> radius;
  std::vector<Vector> position, velocity, spin;

  [[nodiscard]] core::ParticleSnapshot view() const { return {id, species, radius, position, velocity, spin}; }
};
[[nodiscard]] Snapshot gathered_snapshot(const Particles& particles, const std::shared_ptr<const core::Ranks>& ranks);
/// The same for particles.h5: the head, and vectors in pieces. The particles must not change meanwhile.
struct ShownRows {
  core::ParticleHead head;
  std::vector<core::BlockData> vectors;
};
[[nodiscard]] ShownRows shown_rows(const Particles& particles, const std::shared_ptr<const core::Ranks>& ranks);
/// The fluid's loads on them, by id.
[[nodiscard]] std::vector<KeptLoad> gathered_loads(const std::vector<KeptLoad>& loads,
                                                   const std::shared_ptr<const core::Ranks>& ranks);
/// Rows from all ranks by their first numbers, which are ids; duplicates, such as contacts across ranks, once.
/// \param ids  one or two
[[nodiscard]] std::vector<double> gathered_rows(std::vector<double> own, std::size_t width, std::size_t ids,
                                                const std::shared_ptr<const core::Ranks>& ranks);

}  // namespace polybed::dem
