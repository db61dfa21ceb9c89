// Requirements of fed particles: room where they enter, and free motion.
#include <fmt/format.h>

#include <algorithm>

#include "core/case/size_classes.hpp"
#include "dem/rules.hpp"
#include "fluid/inlet.hpp"

namespace polybed::dem {

namespace {

using core::Broken;
using core::Feed;
using core::Scene;

/// Volume fraction of a stream up to which particles find random places without overlap: undisturbed spheres of one
/// size enter in time up to 0.3, a few wait at 0.36, and at 0.4 their number grows.
constexpr double most_fed = 0.35;

double diameter_of(const Scene& scene, const Feed& feed) {
  const auto found = std::find_if(scene.species.begin(), scene.species.end(),
                                  [&](const core::Species& s) { return s.name == feed.species; });
  return found == scene.species.end() ? 0 : found->diameter;
}

Broken narrower_than_a_particle(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.feeds.size(); ++n) {
    const Feed& feed = scene.feeds[n];
    const double diameter = diameter_of(scene, feed);
    for (std::size_t d = 0; d < std::min(feed.from.size(), feed.to.size()); ++d)
      if (feed.to[d] - feed.from[d] < diameter * (1 - 1e-12)) {
        broken.add({feed.species, fmt::format("{:.4g}", feed.from[d]), fmt::format("{:.4g}", feed.to[d]),
                    fmt::format("{:.4g}", diameter)},
                   core::entry_of(scene, scene.feeds, n));
        break;
      }
  }
  return broken;
}

/// Whether two feeds release particles at the same place.
bool meet(const Feed& a, const Feed& b) {
  if (a.at != b.at) return false;
  for (std::size_t d = 0; d < std::min(a.from.size(), b.from.size()); ++d)
    if (a.to[d] <= b.from[d] || b.to[d] <= a.from[d]) return false;
  return true;
}

Broken denser_than_random_places(const Scene& scene) {
  Broken broken;
  const auto fraction = [](const Feed& feed) {
    return fluid::Ramp(feed.superficial_velocity).greatest() / feed.velocity;
  };
  for (std::size_t n = 0; n < scene.feeds.size(); ++n) {
    const Feed& feed = scene.feeds[n];
    double sum = 0;
    for (const Feed& other : scene.feeds)
      if (other.velocity > 0 && meet(feed, other)) sum += fraction(other);
    if (sum > most_fed * (1 + 1e-12))
      broken.add({feed.species, fmt::format("{:.3g}", sum), fmt::format("{:g}", most_fed),
                  fmt::format("{:.4g}", feed.velocity * sum / most_fed)},
                 core::entry_of(scene, scene.feeds, n));
  }
  return broken;
}

}  // namespace

std::vector<core::Rule> feed_rules() {
  return {
      {{"dem.held", "feed.species"},
       "dem.held = true and [[feed]] contradict each other: held particles do not move away from where they enter; "
       "leave one of them out",
       [](const Scene& scene) { return core::broken_if(scene.bed.held && !scene.feeds.empty()); }},
      {{"feed.from", "feed.to", "feed.species", "species.name", "species.diameter", "column.size"},
       "[[feed]] of {}: from {} to {} m there is less room than a particle needs, {} m: move feed.from and feed.to "
       "apart",
       narrower_than_a_particle},
      {{"feed.velocity", "feed.superficial_velocity", "feed.from", "feed.to", "feed.at", "feed.species", "column.size"},
       "[[feed]] of {}: particles that fill {} of the volume in which they enter find no random places, which takes "
       "at most {}: raise feed.velocity to {} m/s, or feed less",
       denser_than_random_places}};
}

}  // namespace polybed::dem
