// What the particle model says when it cannot go on: who, where, and what to do about it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

/// Collective: tells the deepest overlap of all ranks, or which particle is too fast.
void Model::stop_in_trouble() const {
  const bool pair = pair_forces_.trouble().pair >= 0;
  const double urgency = pair ? 1 + pair_forces_.trouble().excess : (hasty_ >= 0 ? 0.5 : 0);
  const std::string text = pair ? trouble_of_pair() : (hasty_ >= 0 ? trouble_of_haste() : "");
  throw core::NumericsError(core::said_by(ranks_.get(), core::rank_of_greatest(ranks_.get(), urgency), text));
}

std::string Model::trouble_of_pair() const {
  const PairTrouble& t = pair_forces_.trouble();
  const Contacts::Pair pair = (t.wall ? walls_ : pairs_).pairs[std::size_t(t.pair)];
  const Place& at = particles_.place[std::size_t(pair.first)];
  const std::string other = t.wall ? fmt::format("wall {}", pair.second)
                                   : fmt::format("particle {}", particles_.id[std::size_t(pair.second)]);
  return fmt::format(
      "t = {:.6g} s: particle {} and {} overlap by {:.3g} m more than dem.max_overlap allows, near ({:.6g}, {:.6g}, "
      "{:.6g}) m; raise dem.youngs_modulus, state a higher dem.greatest_speed, or look at the start",
      time(), particles_.id[std::size_t(pair.first)], other, t.excess, at.x[0], at.x[1], at.x[2]);
}

std::string Model::trouble_of_haste() const {
  const auto found = std::find(particles_.id.begin(), particles_.id.end(), hasty_);
  const auto i = std::size_t(found - particles_.id.begin());
  const Vector &x = particles_.place[i].x, &v = particles_.motion[i].v;
  return fmt::format(
      "t = {:.6g} s: particle {} moves by more than a tenth of its diameter in one step of {:.3g} s, at {:.4g} m/s, "
      "near ({:.6g}, {:.6g}, {:.6g}) m; state a higher dem.greatest_speed, or look at the start",
      time(), hasty_, limits_.dt, std::hypot(v[0], v[1], v[2]), x[0], x[1], x[2]);
}

}  // namespace polybed::dem
