// The particle model's list of pairs: how long it lasts, and how it is made again.
#include <algorithm>
#include <cmath>

#include "dem/model.hpp"
#include "dem/scene.hpp"

namespace polybed::dem {

namespace {

/// Cost of each owned particle: itself and its contacts. \param own  Model::work_of_particle()
std::vector<std::int32_t> work_of(const Particles& particles, const Contacts& pairs, const Contacts& walls,
                                  std::int32_t own) {
  std::vector<std::int32_t> work(particles.owned, own);
  for (const std::int32_t p : pairs.touching)
    for (const std::int32_t i : {pairs.pairs[std::size_t(p)].first, pairs.pairs[std::size_t(p)].second})
      if (std::size_t(i) < particles.owned) ++work[std::size_t(i)];
  for (const std::int32_t p : walls.touching) ++work[std::size_t(walls.pairs[std::size_t(p)].first)];
  return work;
}

}  // namespace

/// Whether the next step moves an owned particle too far for the list. \param since  age of the list after that step, s
bool Model::list_goes_stale(double drift, double since) const {
  // Two particles can approach from both sides, and a sheared box moves one faster than the other.
  const double flow = std::abs(box_.shear_rate) * since * (materials_.greatest_diameter() + skin_ + laws_.reach());
  return !(2 * drift + flow <= 2 * allowed_drift_);
}

/// Makes the skin thicker after a list that lasted for few steps and thinner after one that lasted for many: making a
/// list costs as much as several steps, and each pair that is listed but does not touch costs time in every step.
void Model::adapt_skin() {
  if (!relative_motion_ || scene_.dem.skin) return;
  constexpr std::int64_t few = 20, many = 80;
  constexpr double change = 1.25;
  const std::int64_t lasted = steps_ - marked_at_;
  const double least = skin_of(scene_, materials_);
  if (lasted < few) set_skin(std::min(change * skin_, thickest_skin * least));
  if (lasted > many) set_skin(std::max(skin_ / change, least));
}

/// Takes effect in the next list.
void Model::set_skin(double skin) {
  skin_ = skin;
  const double reach = skin + laws_.reach();
  exchange_.set_reach(reach);
  search_.set_reach(reach, (relative_motion_ ? relative_motion_->far() : skin) + laws_.reach());
}

/// Whether neighbours have stayed together although some particle has moved far. If so, displacements are measured from
/// the present places on. Collective.
bool Model::keeps_list() {
  if (!relative_motion_) return false;
  const auto scope = timers_.scope("neighbours");
  const RelativeMotion::Moved moved = relative_motion_->since(particles_, ranks_.get());
  allowed_drift_ = std::min(0.5 * (skin_ - moved.apart), relative_motion_->far() - moved.most);
  constexpr double worth_it = 0.1;  // of the skin: with less the next check would follow within a few steps
  if (!(allowed_drift_ >= worth_it * skin_)) return false;
  verlet_.mark(particles_);
  return true;
}

void Model::wrap() {
  for (std::size_t i = 0; i < particles_.owned; ++i) {
    Vector& x = particles_.place[i].x;
    Motion& m = particles_.motion[i];
    const Vector from = x;
    const double speed = m.v[0];
    if (box_.periodic[1] && (x[1] < 0 || x[1] >= box_.size[1])) {
      const double boxes = std::floor(x[1] / box_.size[1]);
      x[0] -= boxes * box_.image_shift(clock());
      m.v[0] -= boxes * box_.image_speed();
    }
    x = box_.wrapped(x);
    double gained = 0.5 * (m.v[0] - speed) * (m.v[0] + speed);
    for (std::size_t k = 0; k < 3; ++k) gained -= gravity_[k] * (x[k] - from[k]);
    if (joined_work_) joined_work_->wrapped(gained / m.inverse_mass);
  }
}

void Model::restart() {
  set_skin(skin_of(scene_, materials_));
  rebuild();
  if (coupling_) coupling_->restart();
}

void Model::rebuild() {
  KeptContacts kept(pairs_.memory_size);
  kept.add(pairs_, particles_, false);
  kept.add(walls_, particles_, true);
  if (outflow_) count_ -= outflow_->count_leaving(*this);
  wrap();
  exchange_.balance(particles_, work_of(particles_, pairs_, walls_, work_of_particle()));
  if (outflow_) take_out();
  list_pairs(std::move(kept));
}

/// Removes this rank's particles that have left.
void Model::take_out() {
  if (coupling_) coupling_->let_go(*outflow_, particles_);
  outflow_->take_out(particles_);
}

/// Moves particles to their owners and rebuilds the list of pairs; contacts move with their particles.
void Model::list_pairs(KeptContacts kept) {
  std::vector<double>().swap(pairs_.memory);  // frees memory for the rebuild
  particles_.resize(particles_.owned);
  if (coupling_) coupling_->send_ahead(exchange_, particles_);
  exchange_.migrate(particles_, kept);
  if (feeding_) feeding_->enter(particles_, ranks_ ? &exchange_.decomposition() : nullptr, ranks_ ? ranks_->rank() : 0);
  particles_.arrange(search_.order(particles_));
  if (coupling_) coupling_->settle_in(particles_);
  exchange_.choose_ghosts(particles_);
  search_.find_pairs(particles_, clock(), exchange_.decomposition().centre(),
                     exchange_.decomposition().whole(materials_.greatest_diameter() + skin_ + laws_.reach()), pairs_);
  search_.find_walls(particles_, walls_.pairs);
  const KeptById memories(kept);
  memories.recall(pairs_, particles_, false);
  memories.recall(walls_, particles_, true);
  verlet_.mark(particles_);
  if (relative_motion_) relative_motion_->mark(particles_);
  allowed_drift_ = relative_motion_ ? std::min(0.5 * skin_, relative_motion_->far()) : 0.5 * skin_;
  marked_at_ = steps_;
  ahead_ = Ahead::clear;
  ++work_.rebuilds;
  work_.candidates += search_.candidates();
}

}  // namespace polybed::dem
