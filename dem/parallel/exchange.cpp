#include "dem/parallel/exchange.hpp"

#include <algorithm>
#include <unordered_map>

namespace polybed::dem {

namespace {

/// Accepted ratio of greatest to mean work of the ranks, and how often a cut is tried at most. Neither affects the
/// particles.
constexpr double most_imbalance = 1.15;
constexpr int calls_between_cuts = 10;

/// Items for each rank, one rank after the other.
template <class Item>
std::vector<int> pack(const std::vector<std::vector<Item>>& to, std::vector<Item>& out) {
  std::vector<int> counts;
  out.clear();
  for (const auto& items : to) {
    counts.push_back(int(items.size()));
    out.insert(out.end(), items.begin(), items.end());
  }
  return counts;
}

template <class Item>
std::vector<Item> send(const std::shared_ptr<const core::Ranks>& ranks, const std::vector<std::vector<Item>>& to) {
  std::vector<Item> out;
  core::Messages messages(ranks, pack(to, out));
  std::vector<Item> in(messages.incoming());
  messages.start(std::span<const Item>(out), std::span<Item>(in));
  messages.finish();
  return in;
}

}  // namespace

Exchange::Exchange(const Box& box, std::shared_ptr<const core::Ranks> ranks, double reach, double greatest_radius)
    : box_(box),
      ranks_(ranks),
      reach_(reach),
      greatest_radius_(greatest_radius),
      decomposition_(box, ranks, 2 * greatest_radius) {}

/// Whether a particle can touch one whose centre is in a part, of this box or of an image.
bool Exchange::near(const Place& place, const Part& part) const {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = box_.size[k];
    double away = std::max({part.low[k] - place.x[k], place.x[k] - part.high[k], 0.0});
    // The outer parts of a box that does not wrap also own the space beyond it.
    if (!box_.periodic[k] && (place.x[k] < part.low[k] ? part.low[k] <= 0 : part.high[k] >= length)) away = 0;
    if (box_.periodic[k]) {
      away = std::min({away, std::max(part.low[k] + length - place.x[k], 0.0),
                       std::max(place.x[k] - (part.high[k] - length), 0.0)});
    }
    square += away * away;
  }
  const double far = place.radius + greatest_radius_ + reach_;
  return square < far * far;
}

/// Whether particles in two parts can touch: this excludes most ranks without checks of single particles.
bool Exchange::near(const Part& one, const Part& other) const {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = box_.size[k];
    double away = std::max({one.low[k] - other.high[k], other.low[k] - one.high[k], 0.0});
    if (box_.periodic[k])
      away = std::min({away, std::max(one.low[k] + length - other.high[k], 0.0),
                       std::max(other.low[k] + length - one.high[k], 0.0)});
    square += away * away;
  }
  const double far = (2 * greatest_radius_ + reach_) * (1 + 1e-9);  // exceeds round-off of the places
  return square < far * far;
}

void Exchange::balance(const Particles& particles, std::span<const std::int32_t> work) {
  if (!ranks_) return;
  imbalance_ = decomposition_.imbalance(work);
  if (++since_cut_ < calls_between_cuts || imbalance_ <= most_imbalance) return;
  decomposition_.balance(std::span(particles.place).first(particles.owned), work);
  since_cut_ = 0;
  ++cuts_;
}

void Exchange::migrate(Particles& particles, KeptContacts& kept) {
  if (!ranks_) return;
  const auto ranks = std::size_t(ranks_->count());
  std::vector<std::vector<Particle>> leaving(ranks);
  std::unordered_map<std::int64_t, int> gone;
  std::size_t staying = 0;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const int owner = decomposition_.owner(particles.place[i].x);
    if (owner != ranks_->rank()) {
      leaving[std::size_t(owner)].push_back(particles.at(i));
      gone[particles.id[i]] = owner;
    } else {
      particles.set(staying++, particles.at(i));
    }
  }
  std::vector<std::vector<double>> contacts(ranks);
  const auto add = [&](int rank, std::size_t n) {
    std::vector<double>& to = contacts[std::size_t(rank)];
    to.insert(to.end(), kept.row(n), kept.row(n) + kept.width);
  };
  for (std::size_t n = 0; n < kept.size(); ++n) {
    const auto low = gone.find(kept.low(n)), high = gone.find(kept.high(n));
    if (low != gone.end()) add(low->second, n);
    if (high != gone.end() && (low == gone.end() || low->second != high->second)) add(high->second, n);
  }
  particles.resize(staying);
  for (const Particle& p : send(ranks_, leaving)) particles.add(p);
  particles.owned = particles.size();
  const std::vector<double> come = send(ranks_, contacts);
  kept.rows.insert(kept.rows.end(), come.begin(), come.end());
}

void Exchange::send_ahead(const Particles& particles, std::vector<KeptLoad>& kept) {
  if (!ranks_) return;
  std::vector<std::vector<KeptLoad>> leaving(std::size_t(ranks_->count()));
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const int owner = decomposition_.owner(particles.place[i].x);
    if (owner != ranks_->rank()) leaving[std::size_t(owner)].push_back(kept[i]);
  }
  for (const KeptLoad& k : send(ranks_, leaving)) kept.push_back(k);
}

void Exchange::send_ahead(const Particles& particles, KeptRows& kept) {
  if (!ranks_ || kept.width == 0) return;
  std::vector<std::vector<double>> leaving(std::size_t(ranks_->count()));
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const int owner = decomposition_.owner(particles.place[i].x);
    if (owner == ranks_->rank()) continue;
    std::vector<double>& to = leaving[std::size_t(owner)];
    to.insert(to.end(), kept.of(i), kept.of(i) + kept.width);
  }
  const std::vector<double> come = send(ranks_, leaving);
  kept.numbers.insert(kept.numbers.end(), come.begin(), come.end());
}

void Exchange::choose_ghosts(Particles& particles) {
  particles.resize(particles.owned);
  if (!ranks_) return;
  const auto ranks = std::size_t(ranks_->count());
  const std::vector<Part>& parts = decomposition_.parts();
  std::vector<std::vector<std::int32_t>> to(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    if (int(r) != ranks_->rank() && near(decomposition_.own(), parts[r]))
      for (std::size_t i = 0; i < particles.owned; ++i)
        if (near(particles.place[i], parts[r])) to[r].push_back(std::int32_t(i));
  ghosts_ = std::make_unique<core::Messages>(ranks_, pack(to, sent_));
  std::vector<Particle> out, in(ghosts_->incoming());
  for (const std::int32_t i : sent_) out.push_back(particles.at(std::size_t(i)));
  ghosts_->start(std::span<const Particle>(out), std::span<Particle>(in));
  ghosts_->finish();
  for (const Particle& p : in) particles.add(p);
  outgoing_.resize(sent_.size());
  incoming_.resize(in.size());
}

void Exchange::send_ghosts(const Particles& particles) {
  if (!ranks_) return;
  for (std::size_t n = 0; n < sent_.size(); ++n) {
    const auto i = std::size_t(sent_[n]);
    outgoing_[n] = {particles.place[i].x, particles.motion[i].v, particles.motion[i].w};
  }
  ghosts_->start(std::span<const Refresh>(outgoing_), std::span<Refresh>(incoming_));
}

void Exchange::receive_ghosts(Particles& particles) {
  if (!ranks_) return;
  ghosts_->finish();
  for (std::size_t n = 0; n < incoming_.size(); ++n) {
    particles.place[particles.owned + n].x = incoming_[n].x;
    particles.motion[particles.owned + n].v = incoming_[n].v;
    particles.motion[particles.owned + n].w = incoming_[n].w;
  }
}

}  // namespace polybed::dem
