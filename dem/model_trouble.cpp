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
      "{:.6g}) m; {}",
      time(), particles_.id[std::size_t(pair.first)], other, t.excess, at.x[0], at.x[1], at.x[2],
      remedy_of_pair(pair, t));
}

/// The stiffness at which the contact would have stopped them: what is stored in it at the overlap now and what they
/// still approach with, both taken by one contact, the lighter one held by its neighbours.
std::string Model::remedy_of_pair(const Contacts::Pair& pair, const PairTrouble& trouble) const {
  if (steps_ == 0 || std::isinf(trouble.excess)) return "look at the start";
  const auto i = std::size_t(pair.first), j = std::size_t(pair.second);
  const std::int32_t a = particles_.species[i], b = trouble.wall ? -1 : particles_.species[j];
  const double allowed = 2 * scene_.dem.max_overlap * materials_.kinds()[std::size_t(pair.kind)].least_radius;
  const double overlap = allowed + trouble.excess, stored = laws_.normal->energy(pair.kind, overlap);
  double mass = materials_.species()[std::size_t(a)].mass, square = 0;
  if (!trouble.wall) mass = std::max(mass, materials_.species()[std::size_t(b)].mass);
  for (std::size_t k = 0; k < 3; ++k) {
    const double v = particles_.motion[i].v[k] - (trouble.wall ? 0 : particles_.motion[j].v[k]);
    square += v * v;
  }
  // Energy goes with stiffness: so much stiffer, what is there fits into the overlap that is allowed.
  double factor = stiffening(*laws_.normal, pair.kind, overlap, allowed) * (1 + 0.5 * mass * square / stored);
  if (!overlap_.warning.empty()) factor = std::max(factor, overlap_.stiffening);  // others would be next
  const auto& species = materials_.species();
  return fmt::format(
      "{} would have kept them within it; or look at the start",
      stiffer(scene_, species[std::size_t(a)].name, trouble.wall ? "wall" : species[std::size_t(b)].name, factor));
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
