// Particles and contacts of all ranks, put together on the first in an order that does not depend on the ranks.
#pragma once

#include <memory>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "dem/parallel/exchange.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

// Collective; empty but on the first rank.

/// Owned particles of all ranks, by id.
[[nodiscard]] std::vector<Particle> gathered_particles(const Particles& particles,
                                                       const std::shared_ptr<const core::Ranks>& ranks);
/// What the fluid does to them, by id.
[[nodiscard]] std::vector<KeptLoad> gathered_loads(const std::vector<KeptLoad>& loads,
                                                   const std::shared_ptr<const core::Ranks>& ranks);
/// What side forces keep of them, by id.
[[nodiscard]] KeptRows gathered_rows(const KeptRows& rows, const std::shared_ptr<const core::Ranks>& ranks);
/// Contacts of all ranks, by ids; a pair across ranks, which both keep, once.
[[nodiscard]] std::vector<KeptContact> gathered_contacts(const std::vector<KeptContact>& contacts,
                                                         const std::shared_ptr<const core::Ranks>& ranks);

}  // namespace polybed::dem
