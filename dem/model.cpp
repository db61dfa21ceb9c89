#include "dem/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/sphere.hpp"
#include "core/error.hpp"
#include "dem/packing.hpp"
#include "dem/scene.hpp"

namespace polybed::dem {

namespace {

/// What each owned particle costs: itself and its contacts. \param own  Model::own_work()
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

Model::Model(const core::Scene& scene, core::Timers& timers, std::shared_ptr<const core::Ranks> ranks)
    : scene_(scene),
      ranks_(std::move(ranks)),
      timers_(timers),
      box_(box_of(scene)),
      materials_(scene),
      laws_(make_pair_laws(scene, materials_)),
      start_(start_particles(scene, materials_, box_)),
      expected_(expected_speeds(scene, materials_, box_, start_)),
      limits_(step_limits(scene, materials_, laws_, expected_.greatest)),
      overlap_(overlap_forecast(scene, materials_, *laws_.normal, expected_.impact)),
      gravity_(gravity_of(scene)),
      force_unit_(force_unit(scene, materials_, laws_)),
      torque_unit_(torque_unit(force_unit_, materials_)),
      held_(scene.bed.held),
      skin_(skin_of(scene, materials_)),
      verlet_(limits_.synchronised, limits_.dt, gravity_, force_unit_, torque_unit_, box_.shear_rate),
      search_(box_, materials_, skin_ + laws_.reach()),
      pair_forces_(box_, materials_, laws_, force_unit_, torque_unit_, scene.dem.max_overlap),
      exchange_(box_, ranks_, skin_ + laws_.reach(), 0.5 * materials_.greatest_diameter()) {
  require_room_for_images(box_, materials_.greatest_diameter(), laws_.reach(), skin_);
  pairs_.memory_size = walls_.memory_size = laws_.memory_size() + (scene.dem.ledger ? Ledger::memory_size(laws_) : 0);
  if (laws_.film) laws_.film->set_step(limits_.dt);
  if (box_.opening)
    outflow_ = Outflow{materials_.greatest_diameter(), std::vector<std::int64_t>(scene.species.size(), 0), 0, {}};
  const std::vector<Particle> all = std::move(start_);
  measure(all);
  place(all, std::vector<std::int32_t>(all.size(), 1));
  if (scene.dem.ledger) {
    ledger_.emplace(laws_, laws_.memory_size(), limits_.synchronised, energy_unit_);
    pair_forces_.keep(*ledger_);
    verlet_.keep(*ledger_);
  }
  if (scene.dem.ledger && box_.shear_rate != 0) {
    flow_work_.emplace(force_unit_, energy_unit_, limits_.dt);
    pair_forces_.keep(*flow_work_);
  }
  couple(scene, all);
  rebuild();
  find_forces(0);
  if (flow_work_) flow_work_->begin();
  if (coupling_) coupling_->begin(particles_);
  look_ahead();
}

Model::~Model() = default;

/// The fluid between the particles, if there is one. A sheared box has no room for its motion: there it is the flow.
void Model::couple(const core::Scene& scene, const std::vector<Particle>& all) {
  if (!scene.fluid.present()) return;
  double volume = 0;
  std::vector<double> share(scene.species.size(), 0.0);
  for (const Particle& p : all) {
    volume += closures::sphere_volume(p.place.radius);
    share[std::size_t(p.species)] += closures::sphere_volume(p.place.radius);
  }
  if (box_.shear_rate != 0) {
    if (!has_affine_drag(scene)) return;
    for (double& x : share) x /= volume;
    const double voidage = 1 - volume / (box_.size[0] * box_.size[1] * box_.size[2]);
    affine_drag_.emplace(scene, materials_, share, voidage, force_unit_, energy_unit_);
    return;
  }
  coupling_.emplace(scene, materials_, ranks_, timers_, Coupling::Units{force_unit_, energy_unit_}, limits_.dt,
                    limits_.greatest_speed, volume, count_);
  coupling_->motion().load.resize(particles_.owned);
  coupling_->sides().rows().clear(particles_.owned);
}

/// Units of the sums over all particles.
void Model::measure(const std::vector<Particle>& all) {
  double mass = 0;
  for (const Particle& p : all) mass += 1 / p.motion.inverse_mass;
  const double length = std::max({box_.size[0], box_.size[1], box_.size[2]});
  const double weight = std::hypot(gravity_[0], gravity_[1], gravity_[2]) * length;
  const double speed = limits_.greatest_speed;
  // What the sums may grow to: the energy of all at the greatest speed, and a reserve for what is dissipated meanwhile.
  energy_unit_ = FixedPoint::for_sums_of(mass * (speed * speed + weight), 1024);
  momentum_unit_ = FixedPoint::for_sums_of(mass * speed, 1024);
}

/// Every rank knows all particles and keeps its own: the start is the same on any number of ranks.
void Model::place(const std::vector<Particle>& all, const std::vector<std::int32_t>& work) {
  count_ = std::int64_t(all.size());
  particles_.resize(0);
  if (ranks_) {
    std::vector<Place> places;
    if (core::is_first(ranks_.get()))
      for (const Particle& p : all) places.push_back(p.place);
    exchange_.decomposition().balance(places, std::span(work).first(places.size()));
  }
  for (const Particle& p : all)
    if (!ranks_ || exchange_.decomposition().owner(p.place.x) == ranks_->rank()) particles_.add(p);
  particles_.owned = particles_.size();
}

void Model::step(double stop) {
  if (ahead_ == Ahead::trouble) stop_in_trouble();
  if (ahead_ == Ahead::stale || ahead_ == Ahead::fast) {
    const auto scope = timers_.scope("neighbours");
    const bool fast = ahead_ == Ahead::fast;
    rebuild();
    if (fast) shorten_step();
  }
  constexpr std::int64_t all_timed = 64, sampled = 16;  // so many first steps, and then one of so many
  timed_ = steps_ < all_timed ? 1 : (steps_ % sampled == 0 ? std::uint64_t(sampled) : 0);
  ++steps_;
  if (held_)
    coupling_->hold(particles_);
  else
    move(limits_.dt);
  if (coupling_ && coupling_->due(steps_)) coupling_->advance(particles_, clock());
  reported_ = std::abs(clock() - stop) < 0.5 * limits_.dt ? stop : clock();
  look_ahead();
  if (ahead_ == Ahead::trouble) stop_in_trouble();
}

void Model::move(double dt) {
  {
    const auto scope = timers_.scope("motion", timed_);
    verlet_.begin(particles_, around());
  }
  find_forces(dt);
  if (flow_work_) flow_work_->end_step();
  if (coupling_) {
    const auto scope = timers_.scope("fluid forces", timed_);
    coupling_->find_forces(particles_);
  }
  const auto scope = timers_.scope("motion", timed_);
  verlet_.end(particles_, around());
  if (coupling_) coupling_->turn(particles_);
}

void Model::push(const std::vector<Vector>& dv) {
  for (std::size_t i = 0; i < particles_.owned; ++i)
    for (std::size_t k = 0; k < 3; ++k) particles_.motion[i].v[k] += dv[std::size_t(particles_.species[i])][k];
  look_ahead();
}

/// What the next step will need, or that there must be none: all that the ranks have to agree on.
void Model::look_ahead() {
  const auto scope = timers_.scope("motion", timed_);
  const double since = double(steps_ + 1 - marked_at_) * limits_.dt;
  const Verlet::Drift drift = held_ ? Verlet::Drift{} : verlet_.next_drift(particles_, since, around());
  hasty_ = drift.hasty;
  met_ = std::max(met_, drift.speed);
  // The time of a contact goes with the fifth root of the speed: a quarter more is no matter.
  constexpr double tolerated = 1.25;
  const bool troubled = pair_forces_.trouble().pair >= 0 || hasty_ >= 0;
  const bool fast = drift.speed > tolerated * limits_.greatest_speed && may_shorten();
  const bool stale = list_goes_stale(drift.distance, since);
  const Ahead here = troubled ? Ahead::trouble : fast ? Ahead::fast : stale ? Ahead::stale : Ahead::clear;
  ahead_ = Ahead(int(core::greatest_of_ranks(ranks_.get(), double(here))));
}

/// Whether the next step takes an owned particle too far for the list. \param since  it was made, after that step, s
bool Model::list_goes_stale(double drift, double since) const {
  // Two particles may approach from both sides, and a sheared box moves the one faster than the other.
  const double flow = std::abs(box_.shear_rate) * since * (materials_.greatest_diameter() + skin_ + laws_.reach());
  return !(2 * drift + flow <= skin_);
}

/// Not where the length of a step is that of the case, or is counted in: strain of a sheared box, weights of the
/// history force; and not within a step of the fluid.
bool Model::may_shorten() const {
  if (scene_.dem.fixed_step || box_.shear_rate != 0 || held_) return false;
  return !coupling_ || (coupling_->due(steps_) && !coupling_->sides().present());
}

/// From here on steps are as short as the fastest particle asks for, and a quarter faster ones. Collective.
void Model::shorten_step() {
  constexpr double reserve = 1.25;
  const double met = core::greatest_of_ranks(ranks_.get(), met_);
  set_step_for(clock(), steps_, reserve * met);
  if (coupling_) coupling_->restart();
  ++work_.shortenings;
}

/// Steps for a speed. \param began, began_at  time and number of the first of them
void Model::set_step_for(double began, std::int64_t began_at, double speed) {
  began_ = began;
  began_at_ = began_at;
  limits_ = step_limits(scene_, materials_, laws_, speed);
  verlet_.set_dt(limits_.dt);
  if (coupling_) coupling_->set_dt(limits_.dt);
}

void Model::wrap() {
  for (std::size_t i = 0; i < particles_.owned; ++i) {
    Vector& x = particles_.place[i].x;
    if (box_.periodic[1] && (x[1] < 0 || x[1] >= box_.size[1])) {
      const double boxes = std::floor(x[1] / box_.size[1]);
      x[0] -= boxes * box_.image_shift(clock());
      Motion& m = particles_.motion[i];
      const double from = m.v[0];
      m.v[0] -= boxes * box_.image_speed();
      if (flow_work_) flow_work_->wrapped(1 / m.inverse_mass, from, m.v[0]);
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (box_.periodic[k]) {
        x[k] -= std::floor(x[k] / box_.size[k]) * box_.size[k];
        if (x[k] >= box_.size[k]) x[k] = 0;  // of a tiny negative number, whose sum with the length is the length
      }
  }
}

std::vector<KeptContact> Model::kept_contacts() const {
  std::vector<KeptContact> kept;
  keep(pairs_, particles_, false, kept);
  keep(walls_, particles_, true, kept);
  return kept;
}

void Model::refresh_ghosts() {
  exchange_.send_ghosts(particles_);
  exchange_.receive_ghosts(particles_);
}

void Model::restart() {
  rebuild();
  if (coupling_) coupling_->restart();
}

void Model::rebuild() {
  std::vector<KeptContact> kept = kept_contacts();
  if (outflow_) count_leaving();
  wrap();
  exchange_.balance(particles_, work_of(particles_, pairs_, walls_, own_work()));
  if (outflow_) take_out();
  list_pairs(kept);
}

/// Moves particles to their owners and finds anew who is near whom; contacts go with their particles.
void Model::list_pairs(std::vector<KeptContact>& kept) {
  particles_.resize(particles_.owned);
  std::vector<KeptLoad> loads;
  KeptRows sides;
  if (coupling_) {
    loads = keep(particles_, coupling_->motion().load);
    exchange_.send_ahead(particles_, loads);
    sides = keep(particles_, coupling_->sides().rows());
    exchange_.send_ahead(particles_, sides);
  }
  exchange_.migrate(particles_, kept);
  const std::vector<std::int32_t> order = search_.order(particles_);
  const Particles before = particles_;
  for (std::size_t n = 0; n < order.size(); ++n) particles_.set(n, before.at(std::size_t(order[n])));
  if (coupling_) {
    recall(loads, particles_, coupling_->motion().load);
    recall(sides, particles_, coupling_->sides().rows());
    coupling_->settle_in(particles_);
  }
  exchange_.choose_ghosts(particles_);
  search_.find_pairs(particles_, clock(), exchange_.decomposition().centre(),
                     exchange_.decomposition().whole(materials_.greatest_diameter() + skin_ + laws_.reach()), pairs_);
  search_.find_walls(particles_, walls_.pairs);
  const KeptById memories(kept);
  memories.recall(pairs_, particles_, false);
  memories.recall(walls_, particles_, true);
  verlet_.mark(particles_);
  marked_at_ = steps_;
  ahead_ = Ahead::clear;
  ++work_.rebuilds;
  work_.candidates += search_.candidates();
}

/// Forces that need no ghost are found while the ghosts are on their way.
void Model::find_forces(double dt) {
  const Images now = images();
  const std::uint64_t ghosts_timed = ranks_ ? timed_ : 0;
  {
    const auto scope = timers_.scope("ghosts", ghosts_timed);
    exchange_.send_ghosts(particles_);
  }
  {
    const auto scope = timers_.scope("pair forces", timed_);
    pair_forces_.add_inner_pairs(particles_, pairs_, now, dt);
  }
  if (!box_.walls.empty()) {
    const auto scope = timers_.scope("walls", timed_);
    pair_forces_.add_walls(particles_, walls_, dt);
  }
  {
    const auto scope = timers_.scope("ghosts", ghosts_timed);
    exchange_.receive_ghosts(particles_);
  }
  const auto scope = timers_.scope("pair forces", timed_);
  pair_forces_.add_outer_pairs(particles_, pairs_, now, dt);
}

Work Model::work() const {
  Work work = work_;
  work.steps = std::uint64_t(steps_);
  work.particle_steps = work.steps * std::uint64_t(count_) + (outflow_ ? std::uint64_t(outflow_->steps) : 0);
  std::array<double, 3> sums{double(pair_forces_.pair_checks()), double(pair_forces_.contact_steps()),
                             double(work.candidates)};
  core::add_over_ranks(ranks_.get(), sums);
  work.pair_checks = std::uint64_t(sums[0]);
  work.contact_steps = std::uint64_t(sums[1]);
  work.candidates = std::uint64_t(sums[2]);
  work.cuts = exchange_.cuts();
  work.greatest_speed = core::greatest_of_ranks(ranks_.get(), met_);
  work.imbalance = exchange_.imbalance();
  return work;
}

}  // namespace polybed::dem
