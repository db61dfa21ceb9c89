#include "dem/feeding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "closures/sphere.hpp"
#include "core/numerics/random.hpp"
#include "core/output/checkpoint.hpp"
#include "dem/model.hpp"
#include "dem/scene.hpp"

namespace polybed::dem {

namespace {

/// Random places drawn for a particle before it waits.
constexpr int most_tries = 100;

/// Random sequences for a feed, along both axes of its face. The start uses lower numbers.
constexpr std::uint64_t first_sequence = 1000;
std::uint64_t sequence(std::size_t feed, std::uint64_t n) { return first_sequence + 2 * feed + n; }

/// Distance of the centres of entering particles from their face, over the radius: they do not touch it.
constexpr double hair = 1 + 0x1p-20;

/// Range of the centres for a feed; in a curved side along it alone.
std::pair<Vector, Vector> centres(const core::Feed& feed, const core::Column& column, const Box& box, double radius) {
  Vector low{}, high = box.size;
  const auto set = [&](std::size_t k, double from, double to) {
    low[k] = from + radius;
    high[k] = std::max(low[k], to - radius);
  };
  for (const std::size_t k : across(feed.at)) {
    if (box.periodic[k]) continue;
    const double beside = box.side ? 0.5 * (box.size[k] - column.diameter_at(feed.at)) : 0;
    set(k, beside, box.size[k] - beside);
  }
  for (std::size_t n = 0; n < feed.from.size(); ++n)
    set(std::size_t(axis_along(feed.at, column.dimensions, n)), feed.from[n], feed.to[n]);
  const auto a = std::size_t(axis_of(feed.at));
  low[a] = high[a] = side_of(feed.at) == 1 ? box.size[a] - hair * radius : hair * radius;
  return {low, high};
}

}  // namespace

Feeding::Feeding(const core::Scene& scene, const Materials& materials, const Box& box, double skin, std::int64_t count)
    : number(materials.species().size(), 0), materials_(materials), seed_(scene.bed.seed), next_id_(count) {
  for (const core::Feed& feed : scene.feeds) {
    const auto found = std::find_if(materials.species().begin(), materials.species().end(),
                                    [&](const Species& s) { return s.name == feed.species; });
    const double radius = found->radius;
    const auto [low, high] = centres(feed, scene.column, box, radius);
    // Feeds must not make rebuilds of the list more frequent than when the fastest particles move half of the skin.
    feeds_.push_back({std::int32_t(found - materials.species().begin()), feed.at, feed.velocity,
                      0.5 * skin / feed.velocity, fluid::Ramp(feed.superficial_velocity),
                      area_of(feed.at, feed.from, feed.to, scene.column) / closures::sphere_volume(radius), low, high,
                      box.round && is_side(feed.at) ? 0.5 * box.size[0] : 0});
  }
}

/// A millionth of a particle early: a time at which the next one is just due is rounded either way.
std::int64_t Feeding::Feed::called_for(double t) const {
  return std::int64_t(std::floor(rate.integral(t) * per_height + 1e-6));
}

bool Feeding::Feed::due(double t) const { return t - tried_at >= pause && called_for(t) > entered; }

bool Feeding::due(double t) const {
  return std::any_of(feeds_.begin(), feeds_.end(), [t](const Feed& feed) { return feed.due(t); });
}

std::int64_t Feeding::all() const { return std::accumulate(number.begin(), number.end(), std::int64_t(0)); }

std::vector<std::int64_t> Feeding::called_for(double t) const {
  std::vector<std::int64_t> called(number.size(), 0);
  for (const Feed& feed : feeds_) called[std::size_t(feed.species)] += feed.called_for(t);
  return called;
}

std::vector<std::int64_t> Feeding::waiting() const {
  std::vector<std::int64_t> wait(number.size(), 0);
  for (const Feed& feed : feeds_)
    wait[std::size_t(feed.species)] += std::max<std::int64_t>(0, feed.called_for(feed.tried_at) - feed.entered);
  return wait;
}

std::string Feeding::warning() const {
  std::string text;
  const std::vector<std::int64_t> wait = waiting();
  for (std::size_t j = 0; j < wait.size(); ++j)
    if (wait[j] > 0)
      text += fmt::format("{}{} of {} particles of {}", text.empty() ? "" : ", ", wait[j], wait[j] + number[j],
                          materials_.species()[j].name);
  if (text.empty()) return "";
  return "[[feed]]: " + text +
         " have found no room where they enter: raise feed.velocity, feed them through a wider part of the end or "
         "side, or "
         "feed less";
}

bool Feeding::find_place(std::size_t n, const FeedStrip& strip, Place& place) {
  Feed& feed = feeds_[n];
  place.radius = materials_.species()[std::size_t(feed.species)].radius;
  const auto a = std::size_t(axis_of(feed.at));
  const std::array<std::size_t, 2> axes = across(feed.at);
  place.x[a] = feed.low[a];
  for (int k = 0; k < most_tries; ++k) {
    const auto index = std::uint64_t(feed.tries++);
    for (std::size_t d = 0; d < axes.size(); ++d)
      place.x[axes[d]] =
          feed.low[axes[d]] + (feed.high[axes[d]] - feed.low[axes[d]]) * core::uniform(seed_, sequence(n, d), index);
    if (feed.curved > 0) {
      const double across = place.x[2 - a] - feed.curved, reach = feed.curved - hair * place.radius,
                   from_axis = std::sqrt(reach * reach - across * across);
      place.x[a] = feed.curved + (side_of(feed.at) == 0 ? -from_axis : from_axis);
    }
    if (strip.has_room_for(place)) return true;
  }
  return false;
}

std::int64_t Feeding::choose(const Model& model, double t) {
  entering_.clear();
  std::array<std::optional<FeedStrip>, names(core::ColumnFace{}).size()> strips;
  for (std::size_t n = 0; n < feeds_.size(); ++n) {
    Feed& feed = feeds_[n];
    if (!feed.due(t)) continue;
    feed.tried_at = t;
    std::optional<FeedStrip>& strip = strips[std::size_t(feed.at)];
    if (!strip) {
      strip.emplace(model, feed.at);
      for (const Particle& p : entering_) strip->add(p.place);
    }
    const Species& s = materials_.species()[std::size_t(feed.species)];
    Place place;
    for (const std::int64_t most = feed.called_for(t); feed.entered < most && find_place(n, *strip, place);) {
      for (std::optional<FeedStrip>& other : strips)  // faces meet in corners
        if (other) other->add(place);
      Vector v{};
      v[std::size_t(axis_of(feed.at))] = side_of(feed.at) == 1 ? -feed.velocity : feed.velocity;
      if (model.coupling() != nullptr) coming_.push_back({t, s.radius, feed.velocity, feed.at});
      entering_.push_back({place, {v, 1 / s.mass, {0, 0, 0}, 1 / s.inertia}, {}, next_id_++, feed.species});
      ++feed.entered;
      ++number[std::size_t(feed.species)];
    }
  }
  for (const Particle& p : entering_) {
    double per_mass = 0;
    for (const double v : p.motion.v) per_mass += 0.5 * v * v;
    for (std::size_t k = 0; k < 3; ++k) per_mass -= model.gravity()[k] * p.place.x[k];
    energy.add(per_mass / p.motion.inverse_mass * model.energy_unit().per_unit);
  }
  steps += model.steps() * std::int64_t(entering_.size());
  return std::int64_t(entering_.size());
}

Arrivals Feeding::arrivals(double t) {
  const auto late = std::find_if(coming_.begin(), coming_.end(),
                                 [t](const Coming& one) { return one.velocity * (t - one.since) < 2 * one.radius; });
  coming_.erase(coming_.begin(), late);
  seen_at_ = t;
  return std::as_const(*this).arrivals();
}

Arrivals Feeding::arrivals() const {
  Arrivals now;
  if (!coming_.empty()) now.first = next_id_ - std::int64_t(coming_.size());
  for (const Coming& one : coming_) now.of.push_back({one.velocity * (seen_at_ - one.since), one.at});
  return now;
}

void Feeding::enter(Particles& particles, const Decomposition* decomposition, int rank) {
  for (const Particle& p : entering_)
    if (decomposition == nullptr || decomposition->owner(p.place.x) == rank) particles.add(p);
  particles.owned = particles.size();
  entering_.clear();
}

void Feeding::write(core::Checkpoint& checkpoint, const Particles&, const core::Ranks*) const {
  for (const char* name : {"feed_entered", "feed_tries", "feed_tried_at"}) checkpoint.arrays[name].clear();
  for (const Feed& feed : feeds_) {
    checkpoint.arrays["feed_entered"].push_back(double(feed.entered));
    checkpoint.arrays["feed_tries"].push_back(double(feed.tries));
    checkpoint.arrays["feed_tried_at"].push_back(feed.tried_at);
  }
  std::vector<double>& coming = checkpoint.arrays["feed_coming"];
  coming.clear();
  for (const Coming& one : coming_) coming.insert(coming.end(), {one.since, one.radius, one.velocity, double(one.at)});
  checkpoint.numbers["feed_seen_at"] = seen_at_;
  checkpoint.integers["feed_next_id"] = next_id_;
  checkpoint.integers["feed_steps"] = steps;
  checkpoint.integers["feed_energy"] = energy.whole();
  checkpoint.integers["feed_energy_part"] = energy.part();
}

/// At the start of another run no particle has entered, and ids continue after the last one.
void Feeding::read(const Restored& from) {
  const std::size_t count = feeds_.size();
  std::int64_t free_id = 0;
  for (const Particle& p : from.all) free_id = std::max(free_id, p.id + 1);
  std::vector<std::int64_t> whole(2 * count + 5, 0);
  std::vector<double> tried(count, never), coming;
  double seen_at = 0;
  core::on_first(from.ranks, [&] {
    const core::Checkpoint& checkpoint = from.checkpoint;
    whole.end()[-4] = free_id;
    if (!from.same_run || !checkpoint.arrays.contains("feed_entered")) return;
    const auto take = [&](const char* name, std::int64_t* out) {
      const std::vector<double>& stored = checkpoint.array(name);
      if (stored.size() != count ||
          std::any_of(stored.begin(), stored.end(), [](double n) { return !(n >= 0 && n < 9e15); }))
        core::refuse_checkpoint(fmt::format("{} is not a number for each [[feed]]", name));
      std::transform(stored.begin(), stored.end(), out, [](double n) { return std::int64_t(n); });
    };
    take("feed_entered", whole.data());
    take("feed_tries", whole.data() + count);
    if (checkpoint.array("feed_tried_at").size() != count)
      core::refuse_checkpoint("feed_tried_at is not a time for each [[feed]]");
    tried = checkpoint.array("feed_tried_at");
    coming = checkpoint.array("feed_coming");
    seen_at = checkpoint.number("feed_seen_at");
    bool sound = coming.size() % 4 == 0;
    for (std::size_t n = 0; n < coming.size(); ++n)
      sound = sound && coming[n] >= 0 && (n % 4 != 3 || coming[n] < double(names(core::ColumnFace{}).size()));
    if (!sound) core::refuse_checkpoint("feed_coming is not a time, a radius, a velocity and a face of each");
    whole.end()[-4] = checkpoint.count("feed_next_id");
    if (whole.end()[-4] < free_id) core::refuse_checkpoint("feed_next_id is the number of a particle that is there");
    whole.end()[-3] = checkpoint.count("feed_steps");
    whole.end()[-2] = checkpoint.integer("feed_energy");
    whole.end()[-1] = checkpoint.integer("feed_energy_part");
    whole.end()[-5] = std::int64_t(coming.size());
  });
  if (!core::is_first(from.ranks)) std::fill(whole.begin(), whole.end(), 0);
  core::add_over_ranks(from.ranks, whole);
  core::take_from_first(from.ranks, tried);
  core::take_from_first(from.ranks, {&seen_at, 1});
  coming.resize(std::size_t(whole.end()[-5]));
  core::take_from_first(from.ranks, coming);
  coming_.clear();
  for (const double* c = coming.data(); c != coming.data() + coming.size(); c += 4)
    coming_.push_back({c[0], c[1], c[2], core::ColumnFace(int(c[3]))});
  seen_at_ = seen_at;
  std::fill(number.begin(), number.end(), 0);
  for (std::size_t n = 0; n < count; ++n) {
    feeds_[n].entered = whole[n];
    feeds_[n].tries = whole[count + n];
    feeds_[n].tried_at = tried[n];
    number[std::size_t(feeds_[n].species)] += whole[n];
  }
  next_id_ = whole.end()[-4];
  steps = whole.end()[-3];
  energy = EnergySum(whole.end()[-2], whole.end()[-1]);
}

}  // namespace polybed::dem
