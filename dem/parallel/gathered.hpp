// Particles, contacts and what is kept of them, of all ranks, put together on the first in an order that does not
// depend on the ranks.
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
/// Rows of all ranks by their first numbers, which are ids; what several ranks have, as contacts across them, once.
/// \param ids  one or two
[[nodiscard]] std::vector<double> gathered_rows(std::vector<double> own, std::size_t width, std::size_t ids,
                                                const std::shared_ptr<const core::Ranks>& ranks);

}  // namespace polybed::dem
