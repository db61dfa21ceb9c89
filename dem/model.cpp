#include "dem/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "dem/holes.hpp"
#include "dem/packing.hpp"
#include "dem/rules.hpp"
#include "dem/scene.hpp"
#include "dem/trouble.hpp"

namespace polybed::dem {

namespace {

/// Only where each particle meets the same walls wherever it goes, and images rest.
std::optional<RelativeMotion> relative_motion_of(const Box& box, const Materials& materials, double reach,
                                                 std::size_t particles) {
  if (!box.plates.empty() || !box.openings.empty() || box.shear_rate != 0) return {};
  return RelativeMotion(box, materials.greatest_diameter(), reach, particles);
}

const core::Scene& fitting(const core::Scene& scene) {
  core::refuse(start_rules(), scene);
  return scene;
}

}  // namespace

Model::Model(const core::Scene& scene, core::Timers& timers, std::shared_ptr<const core::Ranks> ranks, FluidBy fluid_by,
             double resolved_gap)
    : scene_(fitting(scene)),
      ranks_(std::move(ranks)),
      timers_(timers),
      box_(box_of(scene)),
      materials_(scene),
      laws_(make_pair_laws(scene, materials_, effects(), resolved_gap)),
      start_(start_particles(scene, materials_, box_)),
      expected_(expected_speeds(scene, materials_, box_, start_)),
      limits_(step_limits(scene, materials_, laws_, expected_.greatest)),
      overlap_(overlap_forecast(scene, materials_, laws_, expected_.impact)),
      gravity_(gravity_of(scene)),
      force_unit_(force_unit(scene, materials_, laws_, expected_.impact)),
      torque_unit_(torque_unit(force_unit_, materials_)),
      held_(scene.bed.held),
      skin_(skin_of(scene, materials_)),
      relative_motion_(relative_motion_of(box_, materials_, thickest_skin * skin_ + laws_.reach(), start_.size())),
      verlet_(limits_.synchronised, limits_.dt, gravity_, force_unit_, torque_unit_, box_.shear_rate),
      search_(box_, materials_, skin_ + laws_.reach(),
              (relative_motion_ ? relative_motion_->far() : skin_) + laws_.reach()),
      pair_forces_(box_, materials_, laws_, force_unit_, torque_unit_, scene.dem.max_overlap),
      exchange_(box_, ranks_, skin_ + laws_.reach(), 0.5 * materials_.greatest_diameter()) {
  pairs_.memory_size = walls_.memory_size = laws_.memory_size() + (scene.dem.ledger ? Ledger::memory_size(laws_) : 0);
  if (laws_.film) laws_.film->set_step(limits_.dt);
  measure(start_);
  place(start_, std::vector<std::int32_t>(start_.size(), 1));
  make_parts(std::vector<Particle>(std::move(start_)), fluid_by);  // frees them
  rebuild();
  find_forces(0);
  if (joined_work_) joined_work_->begin();
  if (coupling_) coupling_->begin(particles_);
  look_ahead();
}

/// The fluid of a sheared box cannot move freely: it has the box's flow.
void Model::make_parts(const std::vector<Particle>& all, FluidBy fluid_by) {
  const bool sheared = box_.shear_rate != 0;
  const bool fed = is_fed(scene_);
  if (fed) feeding_ = std::make_unique<Feeding>(scene_, materials_, box_, skin_, count_);
  if (!box_.openings.empty()) outflow_ = std::make_unique<Outflow>(box_, materials_, exits_of(scene_, box_));
  if (scene_.dem.ledger) {
    ledger_ = std::make_unique<Ledger>(laws_, laws_.memory_size(), limits_.synchronised, energy_unit_, force_unit_);
    pair_forces_.keep(*ledger_);
    verlet_.keep(*ledger_);
  }
  if (scene_.dem.ledger && (sheared || falls_through_joined_faces(box_, gravity_))) {
    joined_work_ = std::make_unique<JoinedWork>(force_unit_, energy_unit_, limits_.dt);
    if (sheared) pair_forces_.keep(*joined_work_);
  }
  const SolidsVolume solids = volume_of(all, scene_.species.size());
  const double content = fed ? std::max(solids.all, greatest_content(box_, materials_).volume) : solids.all;
  if (has_affine_drag(scene_))
    sheared_ = std::make_unique<AffineDrag>(scene_, materials_, solids, box_.size, force_unit_, energy_unit_);
  if (scene_.fluid.present() && !sheared && fluid_by == FluidBy::model) {
    coupling_ =
        std::make_unique<Coupling>(scene_, materials_, ranks_, timers_, Coupling::Units{force_unit_, energy_unit_},
                                   limits_.dt, limits_.greatest_speed, content, count_);
    coupling_->motion().load.resize(particles_.owned);
    coupling_->sides().rows().clear(particles_.owned);
  }
  around_ = {coupling_ ? &coupling_->motion() : nullptr, sheared_.get()};
  for (KeptPart* part : std::initializer_list<KeptPart*>{feeding_.get(), outflow_.get(), ledger_.get(),
                                                         joined_work_.get(), sheared_.get(), coupling_.get()})
    if (part != nullptr) kept_.push_back(part);
}

CountedEnergy Model::counted_energy() const {
  CountedEnergy energy;
  if (ledger_) energy.dissipated = ledger_->lost();
  if (sheared_) energy.fluid_work = sheared_->work();
  if (coupling_) energy.fluid_work = coupling_->motion().work();
  if (joined_work_) energy.joined_work = joined_work_->sum();
  return energy;
}

/// Sets the units of the sums over all particles.
void Model::measure(const std::vector<Particle>& all) {
  double mass = 0;
  for (const Particle& p : all) mass += 1 / p.motion.inverse_mass;
  if (is_fed(scene_)) mass = std::max(mass, greatest_content(box_, materials_).mass);
  const double length = std::max({box_.size[0], box_.size[1], box_.size[2]});
  const double weight = std::hypot(gravity_[0], gravity_[1], gravity_[2]) * length;  // m2/s2
  const double speed = limits_.greatest_speed;
  // Range of the sums: the energy of all particles at the greatest speed, and a reserve for dissipation so far; a large
  // one if gravity supplies energy without end.
  energy_unit_ = FixedPoint::for_sums_of(mass * (speed * speed + weight),
                                         falls_through_joined_faces(box_, gravity_) ? 0x1p30 : 1024);
  counted_speed_ = std::hypot(speed, std::sqrt(weight));
  momentum_unit_ = FixedPoint::for_sums_of(mass * speed, 1024);
}

/// Every rank has all particles and keeps its own: the start is the same on any number of ranks.
void Model::place(const std::vector<Particle>& all, const std::vector<std::int32_t>& work) {
  count_ = std::int64_t(all.size());
  if (ranks_) {
    std::vector<Place> places;
    if (core::is_first(ranks_.get()))
      for (const Particle& p : all) places.push_back(p.place);
    exchange_.decomposition().balance(places, std::span(work).first(places.size()));
  }
  std::vector<const Particle*> own;
  for (const Particle& p : all)
    if (!ranks_ || exchange_.decomposition().owner(p.place.x) == ranks_->rank()) own.push_back(&p);
  particles_.resize(particles_.owned = own.size());
  for (std::size_t i = 0; i < own.size(); ++i) particles_.set(i, *own[i]);
}

/// One step of the scheme T(2.11)-(2.13), and of the fluid when it is due.
void Model::step(double stop) {
  if (ahead_ == Ahead::trouble) stop_in_trouble();
  if (ahead_ == Ahead::stale && keeps_list()) look_ahead();
  if (ahead_ == Ahead::stale || ahead_ == Ahead::fast) {
    const auto scope = timers_.scope("neighbours");
    const bool fast = ahead_ == Ahead::fast;
    if (!fast) adapt_skin();
    rebuild();
    if (fast) shorten_step();
  }
  constexpr std::int64_t all_timed = 64, sampled = 16;  // number of initial steps, and then one in this many
  timed_ = steps_ < all_timed ? 1 : (steps_ % sampled == 0 ? std::uint64_t(sampled) : 0);
  ++steps_;
  std::optional<Verlet::Drift> next;
  if (!held_)
    next = move(limits_.dt);
  else if (coupling_)
    coupling_->hold(particles_);
  if (coupling_ && coupling_->due(steps_)) {
    coupling_->advance(particles_, clock(), feeding_ ? feeding_->arrivals(clock()) : Arrivals{});
    next.reset();
  }
  reported_ = std::abs(clock() - stop) < 0.5 * limits_.dt ? stop : clock();
  look_ahead(next);
  if (ahead_ == Ahead::trouble) stop_in_trouble();
  if (feeding_ && (!coupling_ || coupling_->due(steps_)) && feeding_->due(clock())) let_in();
}

/// Fed particles enter at the end of a step; with a fluid, at the end of one of its steps.
void Model::let_in() {
  const auto scope = timers_.scope("neighbours");
  const std::int64_t entered = feeding_->choose(*this, clock());
  if (entered == 0) return;
  const bool fast = ahead_ == Ahead::fast;
  count_ += entered;
  rebuild();
  if (coupling_) {
    coupling_->see(feeding_->arrivals(clock()));
    coupling_->take_in(particles_, feeding_->next_id() - entered);
  }
  look_ahead();
  if (fast) ahead_ = Ahead::fast;
}

/// Half kick and drift, forces, half kick. Returns the next drift if the fluid does not change it.
Verlet::Drift Model::move(double dt) {
  {
    const auto scope = timers_.scope("motion", timed_);
    verlet_.begin(particles_, around_);
  }
  find_forces(dt);
  if (joined_work_) joined_work_->add_forces();
  if (coupling_) coupling_->find_forces(particles_, timed_);
  const auto scope = timers_.scope("motion", timed_);
  const Verlet::Drift next = verlet_.end(particles_, around_, time_of_next());
  if (coupling_) coupling_->turn(particles_);
  return next;
}

/// Collective: reports the deepest overlap on all ranks, or the particle that is too fast.
void Model::stop_in_trouble() const {
  const bool pair = pair_forces_.trouble().pair >= 0;
  const double urgency = pair ? 1 + pair_forces_.trouble().excess : hasty_ >= 0 ? 0.5 : beyond_units_ ? 0.25 : 0;
  const std::string text = pair            ? trouble_of_pair(*this, scene_)
                           : hasty_ >= 0   ? trouble_of_haste(*this, scene_, hasty_)
                           : beyond_units_ ? trouble_of_speed(*this, met_, expected_.greatest)
                                           : "";
  throw core::NumericsError(core::said_by(ranks_.get(), core::rank_of_greatest(ranks_.get(), urgency), text));
}

void Model::push(const std::vector<Vector>& dv) {
  for (std::size_t i = 0; i < particles_.owned; ++i)
    for (std::size_t k = 0; k < 3; ++k) particles_.motion[i].v[k] += dv[std::size_t(particles_.species[i])][k];
  look_ahead();
}

void Model::kick(const std::vector<Kick>& by_id) {
  for (std::size_t i = 0; i < particles_.owned; ++i) {
    const Kick& given = by_id[std::size_t(particles_.id[i])];
    for (std::size_t k = 0; k < 3; ++k) {
      particles_.motion[i].v[k] += given.dv[k];
      particles_.motion[i].w[k] += given.dw[k];
    }
  }
  look_ahead();
}

/// Determines the work of the next step, or that there must be none: everything that the ranks must agree on.
/// \param known  the next drift
void Model::look_ahead(const std::optional<Verlet::Drift>& known) {
  const auto scope = timers_.scope("motion", timed_);
  const double since = time_of_next();
  const Verlet::Drift drift = known ? *known : held_ ? Verlet::Drift{} : verlet_.next_drift(particles_, since, around_);
  hasty_ = drift.hasty;
  met_ = std::max(met_, drift.speed);
  constexpr double tolerated = 1.25;  // the duration of a contact scales with the fifth root of the speed: harmless
  beyond_units_ = drift.speed > 25 * counted_speed_;  // energies can grow to 1024 times the design value of their unit
  const bool troubled = pair_forces_.trouble().pair >= 0 || hasty_ >= 0 || beyond_units_;
  const bool fast = drift.speed > tolerated * limits_.greatest_speed && may_shorten();
  const bool stale = list_goes_stale(drift.distance, since);
  const Ahead here = troubled ? Ahead::trouble : fast ? Ahead::fast : stale ? Ahead::stale : Ahead::clear;
  ahead_ = Ahead(int(core::greatest_of_ranks(ranks_.get(), double(here))));
}

/// No if the case gives the step length, or if a quantity depends on it, as the strain of a sheared box does.
bool Model::may_shorten() const {
  if (scene_.dem.fixed_step || box_.shear_rate != 0 || held_) return false;
  return !coupling_ || coupling_->may_shorten(steps_);
}

/// Shortens further steps to suit the fastest particle and a quarter faster ones. Collective.
void Model::shorten_step() {
  constexpr double reserve = 1.25;
  const double met = core::greatest_of_ranks(ranks_.get(), met_);
  set_step_for(clock(), steps_, reserve * met);
  if (coupling_) coupling_->restart();
  ++work_.shortenings;
}

/// Sets the step for a speed. \param began, began_at  time and number of the first such step
void Model::set_step_for(double began, std::int64_t began_at, double speed) {
  began_ = began;
  began_at_ = began_at;
  limits_ = step_limits(scene_, materials_, laws_, speed);
  verlet_.set_dt(limits_.dt);
  if (coupling_) coupling_->set_dt(particles_, limits_.dt);
}

void Model::refresh_ghosts() {
  exchange_.send_ghosts(particles_);
  exchange_.receive_ghosts(particles_);
}

/// Computes forces that need no ghost while the ghosts are in transit.
void Model::find_forces(double dt) {
  const Images now = images();
  const std::uint64_t ghosts_timed = ranks_ ? timed_ : 0;
  const auto timed = [&](const char* term, std::uint64_t times, auto&& work) {
    const auto scope = timers_.scope(term, times);
    work();
  };
  timed("ghosts", ghosts_timed, [&] { exchange_.send_ghosts(particles_); });
  timed("pair forces", timed_, [&] { pair_forces_.add_inner_pairs(particles_, pairs_, now, dt); });
  if (!box_.walls.empty()) timed("walls", timed_, [&] { pair_forces_.add_walls(particles_, walls_, dt); });
  timed("ghosts", ghosts_timed, [&] { exchange_.receive_ghosts(particles_); });
  timed("pair forces", timed_, [&] { pair_forces_.add_outer_pairs(particles_, pairs_, now, dt); });
}

Work Model::work() const {
  Work work = work_;
  work.steps = std::uint64_t(steps_);
  work.particle_steps = work.steps * std::uint64_t(count_);
  if (outflow_) work.particle_steps += std::uint64_t(outflow_->steps);
  if (feeding_) work.particle_steps -= std::uint64_t(feeding_->steps);
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
