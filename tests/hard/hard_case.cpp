#include "hard/hard_case.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/numerics/schedule.hpp"
#include "hard/bed_invariants.hpp"
#include "hard/textbook.hpp"
#include "measures/invariants.hpp"

namespace polybed::hard {

namespace {

using core::Index;

/// The product's model as a run.
class ModelRun : public Run {
 public:
  ModelRun(const core::Scene& scene, core::Timers& timers) : model_(scene, timers) {}
  [[nodiscard]] double time() const override { return model_.time(); }
  tfm::StepLine step(double stop) override {
    model_.step(stop);
    return model_.last_step();
  }
  const tfm::Fields& fields() override {
    model_.show(model_.time());
    return model_.fields();
  }
  void restart() override { model_.restart(); }
  [[nodiscard]] tfm::Work work() const override { return model_.work(); }
  [[nodiscard]] tfm::Model& model() override { return model_; }

 private:
  tfm::Model model_;
};

/// Over a limit: within it a trial is degraded, beyond it it has failed.
constexpr double far_beyond = 10;

/// Where solids rest: below, nothing carries them, and a loose top layer still falls.
constexpr double packed = 0.5;

/// Thrown where a run makes no headway: neither a result nor an honest stop.
struct Stuck : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// CPU time of this process and of those that it has started and seen end, s.
double cpu_of_all() {
  rusage others{};
  ::getrusage(RUSAGE_CHILDREN, &others);
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  return core::cpu_seconds() + seconds(others.ru_utime) + seconds(others.ru_stime);
}

}  // namespace

std::string name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::pass:
      return "PASS";
    case Outcome::degraded:
      return "DEGRADED";
    case Outcome::refused:
      return "REFUSED";
    case Outcome::fail:
      break;
  }
  return "FAIL";
}

std::vector<Treatment> all_schemes() {
  return {
      {"explicit", "limited", ""}, {"explicit", "upwind", ""}, {"imex", "limited", ""}, {"implicit", "limited", ""}};
}

std::unique_ptr<Run> Trial::begin(core::Scene scene, const std::function<void(tfm::Model&)>& start) {
  if (treatment_.integrator != "case") {  // which is run as it stands
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(treatment_.integrator);
    scene.tfm.flux = core::choice_of<core::FractionFlux>(treatment_.flux);
  }
  if (scene.tfm.integrator == core::TfmIntegrator::implicit_steps) scene.tfm.fixed_step.reset();
  if (naive()) scene.tfm.follow_bed = false;  // what takes the model's place asks the whole column
  rtol_ = scene.tfm.rtol;
  std::unique_ptr<Run> run;
  if (naive()) run = textbook::run(treatment_.naive, scene, timers_, start);
  if (run == nullptr) {
    run = std::make_unique<ModelRun>(scene, timers_);
    if (start) start(run->model());
  }
  initial_volume_ = measures::species_volumes(run->model().constants().grid, run->fields().solids);
  steps_since_start_ = 0;
  see(*run, {});
  return run;
}

void Trial::measure(const std::string& id, double value, double limit) {
  const Measured now{id, std::isfinite(value) ? value : 1e300, limit};
  const auto found = std::find_if(worst_.begin(), worst_.end(), [&](const Measured& m) { return m.id == id; });
  if (found == worst_.end())
    worst_.push_back(now);
  else if (now.share() > found->share())
    *found = now;
}

void Trial::keep_work(std::uint64_t steps, double least_step) {
  work_.steps += steps;
  least_step_ = least_step_ > 0 ? std::min(least_step_, least_step) : least_step;
}

void Trial::report(const std::string& name, double value) { reported_ += fmt::format("{}: {:.3g}. ", name, value); }

/// Invariants of the present state.
void Trial::see(Run& run, const Watch& watch) {
  const tfm::Fields& fields = run.fields();
  const core::Grid& grid = run.model().constants().grid;
  const std::vector<double> volume = measures::species_volumes(grid, fields.solids);
  const bool open = run.model().constants().openings.present();
  const std::vector<fluid::Passed> passed = open ? run.model().passed() : std::vector<fluid::Passed>(volume.size());
  for (std::size_t j = 0; j < volume.size(); ++j)
    if (initial_volume_[j] + passed[j].in > 0)
      measure("V1 mass", measures::ledger_error(initial_volume_[j], passed[j].in, passed[j].out, volume[j]), 1e-12);
    else
      measure("V1 solids from nowhere", std::abs(volume[j]), 0);
  double least = 0, negative_drag = 0;
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      for (std::size_t j = 0; j < fields.solids.species(); ++j) {
        least = std::min(least, fields.solids.fraction[j][c]);
        negative_drag = std::max(negative_drag, -fields.solids.exchange[j][c]);
      }
    }
  });
  measure("V2 phi below 0", -least, 0.1 * rtol_);
  if (const auto& stress = run.model().effects().solids_stress; stress && watch.packing)
    measure("V2 phi above packing", stress->packing_above(fields), 1e-3);
  measure("V3 finite", std::isfinite(sum_of(fields)) ? 0 : 1, 0);
  measure("V13 drag power below 0", negative_drag, 0);
  if (watch.rests_always) measure("V6 rest", fastest(grid, fields, packed), 1e-10);
  shortest_time_ = std::min(shortest_time_, characteristic_time(run.model(), fields));
}

void Trial::see_end(Run& run, const Watch& watch, double mean_balance) {
  see(run, watch);
  if (watch.settles)
    measure("at rest within tolerance", fastest(run.model().constants().grid, run.fields(), packed),
            10 * rtol_ * run.model().velocity_scale());
  if (watch.rests) measure("V6 rest", fastest(run.model().constants().grid, run.fields(), packed), 1e-10);
  if (watch.fluidised) measure("V7 force balance", std::abs(mean_balance), 1e-3);
  work_ = run.work();
  if (!watch.steps) return;
  measure("V8 rejected", double(work_.rejected_steps) / double(std::max<std::uint64_t>(work_.steps, 20)), 0.2);
  if (least_step_ > 0) measure("V8 step", 1e-3 * shortest_time_ / least_step_, 1);
}

void Trial::keep_step(Run& run, const tfm::StepLine& line, const Watch& watch) {
  constexpr int starting = 10;  // steps in which an integrator finds its step
  if (!std::isfinite(line.time) || !(line.step > 0)) throw Stuck("a step without length");
  if (++steps_since_start_ <= starting || line.limited_by == "event") return;
  if (least_step_ == 0 || line.step < least_step_) least_step_ = line.step;
  // Ten times what the longest case takes (T18, 20,000); steps below the limit of V8 without an end.
  constexpr std::uint64_t most_steps = 200'000;
  constexpr int most_small_steps = 500;
  small_steps_ = watch.steps && line.step < 1e-3 * shortest_time_ ? small_steps_ + 1 : 0;
  if (small_steps_ > most_small_steps)
    throw Stuck(fmt::format("t = {:.3g} s: {} steps in a row near {:.2g} s", line.time, most_small_steps, line.step));
  if (run.work().steps > most_steps) throw Stuck(fmt::format("t = {:.3g} s after {} steps", line.time, most_steps));
}

tfm::StepLine Trial::step(Run& run, double stop, const Watch& watch) {
  constexpr int seen_every = 8;
  const tfm::StepLine line = run.step(stop);
  keep_step(run, line, watch);
  if (++steps_ % seen_every == 0) see(run, watch);
  return line;
}

void Trial::restart(Run& run) {
  run.restart();
  steps_since_start_ = 0;
}

void Trial::advance(Run& run, double until, const Watch& watch) {
  std::vector<double> stops = run.model().breakpoints();
  std::erase_if(stops, [&](double t) { return !core::is_later(t, run.time()) || !core::is_later(until, t); });
  stops.push_back(until);
  const double half = 0.5 * (run.time() + until), last_cpu = core::cpu_seconds() + watch.cpu;
  double impulse = 0, span = 0;
  steps_ = 0;
  for (const double stop : stops) {
    while (run.time() < stop) {
      const tfm::StepLine line = step(run, stop, watch);
      if (watch.fluidised && line.time > half) {
        impulse += line.step * force_balance(run.model(), run.fields());
        span += line.step;
      }
      if (watch.cpu < 1e300 && (core::cpu_seconds() > last_cpu || has_failed())) return see_end(run, watch, 0);
    }
    if (stop < until) restart(run);
  }
  see_end(run, watch, span > 0 ? impulse / span : 0);
}

bool Trial::has_failed() const {
  return std::any_of(worst_.begin(), worst_.end(), [](const Measured& m) { return m.share() > far_beyond; });
}

Result Trial::judge(const std::function<void(Trial&)>& work) {
  Result result;
  const double begin = cpu_of_all();
  bool stopped = false;
  try {
    work(*this);
  } catch (const core::NumericsError& error) {
    stopped = true;
    result.cause = error.what();
    // The integrator was given what it cannot take, a stop next to its present time for one: nobody's scene asks for
    // it.
    if (result.cause.find("ILL_INPUT") != std::string::npos) measure("V16 honest stop", 1, 0);
  } catch (const core::CaseError& error) {
    stopped = true;
    result.cause = error.what();
  } catch (const Stuck& stuck) {
    measure("V8 stuck", 1, 0);
    result.cause = stuck.what();
  } catch (const std::exception& error) {  // no honest stop
    measure("V16 honest stop", 1, 0);
    result.cause = error.what();
  }
  result.cpu = cpu_of_all() - begin;
  for (const Measured& m : worst_) {
    if (m.share() > 1) result.broken += (result.broken.empty() ? "" : "; ") + m.id;
    if (m.share() > result.worst.share() || result.worst.id.empty()) result.worst = m;
  }
  const double share = result.worst.share();
  result.outcome = share > far_beyond ? Outcome::fail
                   : stopped          ? Outcome::refused
                   : share > 1        ? Outcome::degraded
                                      : Outcome::pass;
  result.least_step = least_step_;
  result.work = work_;
  result.reported = reported_;
  return result;
}

}  // namespace polybed::hard
