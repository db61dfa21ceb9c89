// polybed dem: runs a case particle by particle and writes its run directory.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/json.hpp"
#include "dem/continuum_scene.hpp"
#include "dem/observers.hpp"
#include "dem/settling.hpp"
#include "multiscale/commands/case_run.hpp"
#include "multiscale/effects/switching.hpp"
#include "multiscale/fluid_report.hpp"
#include "multiscale/run_record.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

/// What runs of one command hand on where an effect is switched on between them.
struct Course {
  core::Scene scene;  ///< the case
  std::vector<Switch> switches;
};

/// How well the energy ledger must close, as a share of the greatest energy met (V5).
constexpr double ledger_limit = 1e-3;

class DemRun final : public CaseRun {
 public:
  /// \param begin  of this part of the course, s
  DemRun(const RunOptions& options, const Course& course, double begin, fs::path directory,
         std::shared_ptr<const core::Ranks> ranks)
      : CaseRun(options, at_time(course.scene, course.switches, begin), std::move(directory), std::move(ranks), "dem"),
        model_(scene_, timers_, ranks_),
        course_(course),
        next_switch_(multiscale::next_switch(course.switches, begin)) {
    case_ = course_.scene;
    std::optional<double> initial_energy;
    dem::FluidTotals fluid;
    prepare(
        [&](core::Checkpoint& checkpoint, const fs::path&) {
          model_.resume(checkpoint);
          std::array<double, 1> energy{first_ ? checkpoint.numbers["initial_energy"] : 0.0};
          core::take_from_first(ranks_.get(), energy);
          initial_energy = energy[0];
          if (first_) fluid = dem::read_fluid_totals(checkpoint);
        },
        [&](core::Checkpoint& checkpoint, const fs::path&) { model_.start_from(checkpoint); });
    if (!model_.limits().warning.empty() && first_ && !options_.quiet)
      fmt::print(stderr, "warning: {}\n", model_.limits().warning);
    if (scene_.bed.start == "settled" && !options_.resume) {
      if (!options_.quiet) fmt::print(stderr, "the bed settles first\n");
      model_.start_from(dem::settled(scene_, model_.limits().dt, ranks_));
    }
    const std::optional<double> resume_time = options_.resume ? std::optional(model_.time()) : std::nullopt;
    observers_.emplace(model_, scene_, directory_, initial_energy, fluid, resume_time);
  }

  /// For the part that follows.
  [[nodiscard]] const Course& course() const { return course_; }

 private:
  core::Simulation& simulation() override { return model_; }

  std::vector<core::Observer> observers() override {
    return {{"history", *scene_.output.history_every, [&](double t) { observers_->write_history(t); }},
            {"particles", *scene_.output.every, [&](double t) {
               const auto scope = timers_.scope("output");
               observers_->write_particles(t);
             }}};
  }

  /// Steps are short: asking all ranks at each whether the user wants to stop would cost more than some of them.
  bool after_step() override {
    observers_->see_step();
    watch(monitor_.get(), model_);
    if (monitor_) plan_switches();
    return !switches() && (model_.steps() % 64 != 0 || CaseRun::after_step());
  }

  [[nodiscard]] bool switches() const override { return model_.time() >= next_switch_; }

  /// What the monitor wants is on from the next output time on.
  void plan_switches() {
    for (; planned_ < monitor_->wanted().size(); ++planned_) {
      const std::string& effect = monitor_->wanted()[planned_];
      const double every = *scene_.output.every, time = every * (std::floor(model_.time() / every * (1 + 1e-12)) + 1);
      if (!(every > 0)) continue;  // there is no output time before the end
      course_.switches.push_back({effect, time});
      if (!options_.quiet)
        fmt::print(stderr, "{} will be on from t = {:.4g} s (chooser.monitor = \"enable\")\n", effect, time);
      next_switch_ = std::min(next_switch_, time);
    }
  }

  void add_switches(core::Checkpoint& checkpoint) const override {
    if (!course_.switches.empty()) checkpoint.texts["switch_on"] = text_of(course_.switches);
  }

  core::ProgressLine line() override {
    return {model_.time(),
            scene_.run.until,
            model_.limits().dt,
            model_.limits().limited_by,
            observers_->bed_height(),
            scene_.dem.ledger ? fmt::format("energy {:.0e} of {:.0e}", observers_->ledger_error(), ledger_limit)
                              : fmt::format("{} contacts", observers_->totals().contacts)};
  }

  core::Checkpoint checkpoint() override {
    core::Checkpoint checkpoint = model_.checkpoint();
    checkpoint.numbers["initial_energy"] = observers_->initial_energy();
    if (observers_->fluid() != nullptr) dem::write(observers_->fluid()->totals(), checkpoint);
    return checkpoint;
  }

  std::string advice() override {
    return fmt::format("the step was {:.3g} s, limited by {}; try a larger dem.steps_per_contact", model_.limits().dt,
                       model_.limits().limited_by);
  }

  std::string record_text(const std::string& state) override {
    cpu_ = core::cpu_seconds() - cpu_begin_;
    std::array<double, 1> cpu{cpu_};
    core::add_over_ranks(ranks_.get(), cpu);
    cpu_ = cpu[0];
    work_ = model_.work();
    find_fluid();
    const std::optional<Neglected> promise = promise_of(monitor_.get());
    const int ranks = ranks_ ? ranks_->count() : 1;
    core::Json json;
    begin_record(json, scene_, "dem", state, ranks);
    json.member("particles", model_.particle_count()).member("time_s", model_.time()).member("cpu_s", cpu_);
    json.member("wall_s", wall_seconds());
    json.member("integrator", model_.synchronised() ? "synchronised" : "thesis");
    json.member("integrator_reason", model_.limits().integrator_reason);
    write_prediction_of(json, state, cpu_);
    write_step(json);
    write_work(json);
    write_timers(json, timers_);
    if (fluid_) write_fluid(json, *fluid_);
    const std::vector<fluid::WorstInvariant> watched = invariants();
    if (!watched.empty()) write_invariants(json, watched);
    if (observers_) write_ledger(json);
    if (model_.outflow() != nullptr) write_outflow(json, *model_.outflow());
    write_left_out(json, left_out_);
    if (promise) write_neglected(json, *promise);
    if (!course_.switches.empty()) write_switches(json);
    json.key("warnings").begin_array();
    for (const std::string& line : exceeded_lines(watched)) json.value(line);
    if (!model_.limits().warning.empty()) json.value(model_.limits().warning);
    if (monitor_)
      for (const std::string& line : monitor_->warnings()) json.value(line);
    json.end_array().end_object();
    return json.text();
  }

  /// The ledger of the energy; nothing without one.
  [[nodiscard]] std::vector<fluid::WorstInvariant> invariants() const {
    if (!observers_ || !scene_.dem.ledger) return {};
    return {{"energy", observers_->ledger_error(), ledger_limit, observers_->ledger_error_time()}};
  }

  void write_switches(core::Json& json) const {
    json.key("switched_on").begin_array();
    for (const Switch& one : course_.switches)
      json.begin_object().member("effect", one.effect).member("from_s", one.time).end_object();
    json.end_array();
  }

  /// Collective.
  void find_fluid() {
    if (!observers_ || observers_->fluid() == nullptr) return;
    std::array<dem::EnergySum, 1> work{model_.fluid_work()};
    dem::add_over_ranks(ranks_.get(), work);
    fluid_ = fluid_report(scene_, *model_.coupling(), observers_->fluid()->totals(), model_.limits().dt,
                          work[0].units() * model_.energy_unit().unit);
  }

  void write_step(core::Json& json) const {
    json.key("step").begin_object().member("dt_s", model_.limits().dt);
    json.member("limited_by", model_.limits().limited_by);
    json.member("greatest_speed_expected_m_s", model_.limits().greatest_speed).key("limits").begin_array();
    for (const dem::StepLimit& limit : model_.limits().all)
      json.begin_object().member("name", limit.name).member("dt_s", limit.dt).end_object();
    json.end_array().end_object();
  }

  void write_work(core::Json& json) const {
    json.key("work").begin_object().member("steps", work_.steps).member("particle_steps", work_.particle_steps);
    json.member("pair_checks", work_.pair_checks).member("contact_steps", work_.contact_steps);
    json.member("rebuilds", work_.rebuilds).member("candidates", work_.candidates);
    json.member("cuts", work_.cuts).member("imbalance", work_.imbalance).end_object();
  }

  void write_outflow(core::Json& json, const dem::Outflow& outflow) const {
    json.key("outflow").begin_object();
    for (std::size_t j = 0; j < outflow.number.size(); ++j) {
      const dem::Species& species = model_.materials().species()[j];
      json.key(species.name).begin_object().member("particles", outflow.number[j]);
      json.member("mass_kg", double(outflow.number[j]) * species.mass).end_object();
    }
    json.end_object();
  }

  void write_ledger(core::Json& json) const {
    const dem::Totals& t = observers_->totals();
    json.key("energy").begin_object().member("kinetic_J", t.kinetic).member("rotational_J", t.rotational);
    json.member("elastic_J", t.elastic).member("potential_J", t.potential);
    if (scene_.dem.ledger && model_.outflow() != nullptr) json.member("carried_out_J", t.carried_out);
    if (scene_.dem.ledger)
      json.member("dissipated_J", t.dissipated)
          .member("work_J", t.work)
          .member("initial_J", observers_->initial_energy())
          .member("worst_error", observers_->ledger_error())
          .member("limit", ledger_limit);
    json.end_object().key("momentum_kg_m_s").begin_array();
    for (const double p : t.momentum) json.value(p);
    json.end_array().member("contacts", t.contacts).member("max_overlap_m", t.max_overlap);
  }

  TimeBand predicted() override { return dem_time(scene_, known_machine()); }

  void print_summary() override {
    fmt::print(stderr, "\n{} particles, {} steps, {:.4g} particle-steps per CPU second, list made {} times\n",
               model_.particle_count(), work_.steps, double(work_.particle_steps) / std::max(cpu_, 1e-9),
               work_.rebuilds);
    if (model_.outflow() != nullptr) fmt::print(stderr, "{} particles have left\n", model_.outflow()->all());
    fmt::print(stderr, "step {:.3g} s, limited by {}; {} integrator ({})\n", model_.limits().dt,
               model_.limits().limited_by, model_.synchronised() ? "synchronised" : "thesis",
               model_.limits().integrator_reason);
    if (fluid_)
      for (const std::string& line : fluid_lines(*fluid_)) fmt::print(stderr, "{}\n", line);
    print_prediction(cpu_);
    if (scene_.dem.ledger)
      fmt::print(stderr, "energy ledger: worst {:.2e}, limit {:.0e}{}\n", observers_->ledger_error(), ledger_limit,
                 observers_->ledger_error() > ledger_limit ? "  <-- exceeded" : "");
    print_promise();
  }

  dem::Model model_;
  std::unique_ptr<Monitor> monitor_ = Monitor::of(scene_, "dem");  ///< null: nothing is watched
  std::optional<dem::Observers> observers_;
  dem::Work work_;
  std::optional<FluidReport> fluid_;  ///< of the last record; absent without a fluid
  double cpu_ = 0;
  Course course_;
  double next_switch_;       ///< s
  std::size_t planned_ = 0;  ///< of what the monitor wants
};

/// Of a run that goes on: its time, s, and what its monitor has switched on or is about to.
double take_up_course(const fs::path& directory, Course& course, const core::Ranks* ranks) {
  std::string text;
  std::array<double, 2> head{};
  core::on_first(ranks, [&] {
    const core::Checkpoint checkpoint = read_checkpoint_of(directory, course.scene);
    if (const auto found = checkpoint.texts.find("switch_on"); found != checkpoint.texts.end()) text = found->second;
    head = {checkpoint.numbers.at("time"), double(text.size())};
  });
  core::take_from_first(ranks, head);
  std::vector<double> letters(text.begin(), text.end());
  letters.resize(std::size_t(head[1]));
  core::take_from_first(ranks, letters);
  course.switches = switches_of(std::string(letters.begin(), letters.end()));
  return head[0];
}

}  // namespace

void run_dem(const RunOptions& options) {
  core::Scene scene = read_scene(options);
  dem::refuse_continuum_scene(scene);
  const fs::path directory = run_directory(options, "dem");
  const std::shared_ptr<const core::Ranks> ranks = core::Ranks::of_program();
  core::on_first(ranks.get(), [&] { check_directory(directory, options); });
  Course course{std::move(scene), {}};
  RunOptions now = options;
  for (bool ended = false; !ended; now.resume = true) {
    const double begin = now.resume ? take_up_course(directory, course, ranks.get()) : 0;
    DemRun run(now, course, begin, directory, ranks);
    ended = run.run();
    course = run.course();
  }
}

}  // namespace polybed::multiscale
