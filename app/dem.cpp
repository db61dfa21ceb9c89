// polybed dem: runs a case particle by particle and writes its run directory.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "app/case_run.hpp"
#include "app/commands.hpp"
#include "core/memory.hpp"
#include "core/numerics/schedule.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "dem/coupling/kernel.hpp"
#include "dem/observers.hpp"
#include "dem/settling.hpp"
#include "multiscale/fluid_report.hpp"
#include "multiscale/particle_requirements.hpp"
#include "multiscale/run_record.hpp"
#include "multiscale/scene_warnings.hpp"
#include "relevance/effect_row.hpp"

namespace polybed::app {

namespace {

namespace fs = std::filesystem;

class DemRun final : public CaseRun {
 public:
  DemRun(const RunOptions& options, core::Scene scene, fs::path directory, std::shared_ptr<const core::Ranks> ranks)
      : CaseRun(options, std::move(scene), std::move(directory), std::move(ranks), "dem"),
        model_(scene_, timers_, ranks_) {
    std::optional<dem::RunStart> start;
    dem::FluidTotals fluid;
    prepare(
        [&](core::Checkpoint& checkpoint, const fs::path&) {
          model_.resume(checkpoint);
          start = dem::read_run_start(checkpoint, model_);
          if (first_) fluid = dem::read_fluid_totals(checkpoint);
        },
        [&](core::Checkpoint& checkpoint, const fs::path&) { model_.start_from(checkpoint); });
    for (const std::string& line : warnings_before())
      if (first_ && !options_.quiet) core::print(stderr, "warning: {}\n", line);
    if (scene_.bed.start.kind == core::StartKind::settled && !options_.resume) {
      if (!options_.quiet) core::print(stderr, "the bed settles first\n");
      const core::Checkpoint rest =
          dem::settled(scene_, model_.limits().dt, ranks_, [this](const dem::Settling& bed) { show_settling(bed); });
      if (!options_.quiet) core::print(stderr, "at rest after {:.3g} s\n", rest.time("time"));
      model_.start_from(rest);
    }
    const std::optional<double> resume_time = options_.resume ? std::optional(model_.time()) : std::nullopt;
    observers_.emplace(model_, scene_, directory_, start, fluid, resume_time);
    recall([&](const core::Json& past) { recall_from(past); });
  }

 private:
  /// Counters that are not in the model's own checkpoint.
  static constexpr std::array<std::pair<const char*, std::uint64_t dem::Work::*>, 6> counters_{
      {{"pair_checks", &dem::Work::pair_checks},
       {"contact_steps", &dem::Work::contact_steps},
       {"rebuilds", &dem::Work::rebuilds},
       {"candidates", &dem::Work::candidates},
       {"shortenings", &dem::Work::shortenings},
       {"cuts", &dem::Work::cuts}}};

  /// For the whole run. Collective.
  [[nodiscard]] dem::Work work_of_run() const {
    dem::Work work = model_.work();
    for (const auto& [name, counter] : counters_) work.*counter += before_.*counter;
    return work;
  }

  core::Json past() override {
    const dem::Work work = work_of_run();
    core::Json past = {{"invariants", observers_->invariants().past()}, {"work", core::Json::object()}};
    for (const auto& [name, counter] : counters_) past["work"][name] = work.*counter;
    past["emptied"] = emptied_;
    return past;
  }

  void recall_from(const core::Json& past) {
    observers_->recall(core::member_of(past, "invariants"));
    emptied_ = past.contains("emptied") && past["emptied"] == true;
    // The earlier process's counts include this one's so far. Unsigned differences wrap back correctly.
    const core::Json& before = core::member_of(past, "work");
    const dem::Work here = model_.work();
    for (const auto& [name, counter] : counters_)
      before_.*counter = core::count_of(core::member_of(before, name)) - here.*counter;
  }

  void flush_rows() override { observers_->flush(); }

  /// Shown every few seconds.
  void show_settling(const dem::Settling& bed) {
    constexpr double pause = 5;  // s
    if (options_.quiet || wall_seconds() < settling_shown_ + pause) return;
    settling_shown_ = wall_seconds();
    core::print(stderr,
                "settling: {:.3g} s simulated, about {:.3g} expected; energy of motion {:.2g} times that of rest\n",
                bed.time, bed.expected, bed.over_rest);
  }

  core::Simulation& simulation() override { return model_; }

  std::vector<core::Observer> observers() override {
    return {{"history", *scene_.output.history_every, [&](double t) { write_row(t); }},
            {"particles", *scene_.output.every, [&](double t) {
               const auto scope = timers_.scope("output");
               observers_->write_particles(t);
               emptied_ = model_.outflow() != nullptr && model_.feeding() == nullptr && model_.particle_count() == 0;
               if (emptied_ && core::is_later(t, history_at_)) write_row(t);  // the last one
             }}};
  }

  /// Steps are short: checking all ranks at each step for a stop by the user would cost more than some steps.
  bool after_step() override {
    observers_->see_step();
    watch(model_);
    return model_.steps() % 64 != 0 || CaseRun::after_step();
  }

  bool is_over() override { return emptied_; }

  void write_row(double t) {
    observers_->write_history(t);
    history_at_ = t;
    judge(observers_->invariants().worst());
  }

  core::ProgressLine line() override {
    const measures::WorstInvariant* energy = observers_->invariants().energy();
    return {model_.time(),
            scene_.run.until,
            model_.limits().dt,
            model_.limits().limited_by,
            observers_->bed_height(),
            energy != nullptr ? fmt::format("closest to its limit: energy, {}", relevance::percent(energy->share()))
                              : fmt::format("{} contacts", observers_->totals().contacts)};
  }

  core::Checkpoint checkpoint() override {
    core::Checkpoint checkpoint = model_.checkpoint_but_rows();
    dem::write(observers_->invariants().start(), checkpoint);
    if (observers_->fluid() != nullptr) dem::write(observers_->fluid()->totals(), checkpoint);
    return checkpoint;
  }

  std::vector<core::BlockData> checkpoint_rows() override { return model_.rows(); }

  std::string advice() override {
    if (monitor_ && monitor_->has_stopped()) return advice_of_monitor();
    return fmt::format("the step was {:.3g} s, limited by {}", model_.limits().dt, model_.limits().limited_by);
  }

  /// Warnings about the step and the contacts, from the case alone.
  [[nodiscard]] std::vector<std::string> warnings_before() const {
    std::vector<std::string> lines;
    const dem::Coupling* coupling = model_.coupling();
    for (const std::string& line :
         {model_.limits().warning, model_.overlap_expected().warning, fluid_every_warning(scene_, model_.limits().dt),
          coupling ? dem::smearing_warning(scene_, coupling->kernel_width()) : std::string()})
      if (!line.empty()) lines.push_back(line);
    return lines;
  }

  /// Warning about particles without room; empty: there are none.
  [[nodiscard]] std::string feed_warning() const {
    return model_.feeding() == nullptr ? "" : model_.feeding()->warning();
  }

  std::string record_text(const std::string& state) override {
    cpu_ = core::cpu_seconds() - cpu_begin_;
    std::array<double, 1> cpu{cpu_};
    core::add_over_ranks(ranks_.get(), cpu);
    cpu_ = cpu[0];
    work_ = work_of_run();
    find_fluid();
    const std::optional<Neglected> promise = neglected();
    const int ranks = ranks_ ? ranks_->count() : 1;
    core::Json json;
    begin_record(json, scene_, "dem", state, ranks);
    json.update({{"particles", model_.particle_count()},
                 {"time_s", model_.time()},
                 {"cpu_s", cpu_},
                 {"wall_s", wall_seconds()},
                 {"integrator", model_.synchronised() ? "synchronised" : "thesis"},
                 {"integrator_reason", model_.limits().integrator_reason}});
    write_prediction_of(json, cpu_);
    write_card_of(json, cpu_);
    write_step(json, model_.limits(), model_.expected().greatest);
    write_overlap(json, model_.overlap_expected());
    json["work"] = work_json();
    write_timers(json, timers_);
    if (fluid_) write_fluid(json, *fluid_);
    const std::vector<measures::WorstInvariant> watched =
        observers_ ? observers_->invariants().worst() : std::vector<measures::WorstInvariant>{};
    if (!watched.empty()) write_invariants(json, watched);
    if (observers_) write_ledger(json);
    if (model_.outflow() != nullptr) json["outflow"] = passed_json(model_.outflow()->number);
    if (model_.feeding() != nullptr) json["feed"] = feed_json(*model_.feeding());
    write_left_out(json, left_out_);
    if (promise) write_neglected(json, *promise);
    core::Json& warnings = json["warnings"] = exceeded_lines(watched);
    for (const std::string& line : warnings_before()) warnings.push_back(line);
    if (emptied_) warnings.push_back(fmt::format("ended after {:.4g} s: all particles have left", model_.time()));
    if (const std::string line = feed_warning(); !line.empty()) warnings.push_back(line);
    for (const std::string& line : scene_warnings(scene_)) warnings.push_back(line);
    if (const std::string line = called_for_line(left_out_); !line.empty()) warnings.push_back(line);
    if (monitor_)
      for (const std::string& line : monitor_->warnings()) warnings.push_back(line);
    return state.starts_with("failed") ? core::json_text_with_nulls(json) : core::json_text(json);
  }

  /// Collective.
  void find_fluid() {
    if (!observers_ || observers_->fluid() == nullptr) return;
    std::array<dem::EnergySum, 1> work{model_.counted_energy().fluid_work};
    dem::add_over_ranks(ranks_.get(), work);
    const double joules = work[0].units() * model_.energy_unit().unit;
    fluid_ = fluid_report(scene_, *model_.coupling(), observers_->fluid()->totals(), model_.limits().dt,
                          scene_.dem.ledger ? std::optional(joules) : std::nullopt);
  }

  [[nodiscard]] core::Json work_json() const {
    return {{"steps", work_.steps},
            {"particle_steps", work_.particle_steps},
            {"pair_checks", work_.pair_checks},
            {"contact_steps", work_.contact_steps},
            {"rebuilds", work_.rebuilds},
            {"candidates", work_.candidates},
            {"shortenings", work_.shortenings},
            {"greatest_speed_m_s", work_.greatest_speed},
            {"cuts", work_.cuts},
            {"imbalance", work_.imbalance}};
  }

  /// \param number  of particles of each species that have left or entered
  [[nodiscard]] core::Json passed_json(const std::vector<std::int64_t>& number) const {
    core::Json json;
    for (std::size_t j = 0; j < number.size(); ++j) {
      const dem::Species& species = model_.materials().species()[j];
      json[species.name] = {{"particles", number[j]}, {"mass_kg", double(number[j]) * species.mass}};
    }
    return json;
  }

  [[nodiscard]] core::Json feed_json(const dem::Feeding& feeding) const {
    core::Json json = passed_json(feeding.number);
    const std::vector<std::int64_t> waiting = feeding.waiting();
    for (std::size_t j = 0; j < waiting.size(); ++j) json[model_.materials().species()[j].name]["waiting"] = waiting[j];
    return json;
  }

  void write_ledger(core::Json& json) const {
    const dem::Totals& t = observers_->totals();
    core::Json& ledger = json["energy"] = {{"kinetic_J", t.kinetic},
                                           {"rotational_J", t.rotational},
                                           {"elastic_J", t.elastic},
                                           {"potential_J", t.potential}};
    if (scene_.dem.ledger && model_.outflow() != nullptr) ledger["carried_out_J"] = t.carried_out;
    if (scene_.dem.ledger && model_.feeding() != nullptr) ledger["carried_in_J"] = t.carried_in;
    if (const measures::WorstInvariant* energy = observers_->invariants().energy())
      ledger.update({{"dissipated_J", t.dissipated},
                     {"work_J", t.work},
                     {"initial_J", observers_->invariants().start().energy},
                     {"worst_error", energy->value},
                     {"limit", energy->limit}});
    json["momentum_kg_m_s"] = t.momentum;
    json["contacts"] = t.contacts;
    json["max_overlap_m"] = t.max_overlap;
  }

  [[nodiscard]] std::string limited_by() const override {
    return fmt::format("{}, {:.2g} s", model_.limits().limited_by, model_.limits().dt);
  }

  TimeBand predicted() override { return dem_time(scene_, known_machine()); }

  void print_summary() override {
    core::print(stderr, "\n{} particles, {} steps, {:.4g} particle-steps per CPU second, list made {} times\n",
                model_.particle_count(), work_.steps, double(work_.particle_steps) / std::max(cpu_, 1e-9),
                work_.rebuilds);
    if (model_.outflow() != nullptr) core::print(stderr, "{} particles have left\n", model_.outflow()->all());
    if (model_.feeding() != nullptr) core::print(stderr, "{} particles have entered\n", model_.feeding()->all());
    core::print(stderr, "step {:.3g} s, limited by {}; {} integrator ({})\n", model_.limits().dt,
                model_.limits().limited_by, model_.synchronised() ? "synchronised" : "thesis",
                model_.limits().integrator_reason);
    core::print(stderr, "greatest speed {:.3g} m/s, expected {:.3g}{}\n", work_.greatest_speed,
                model_.expected().greatest,
                work_.shortenings > 0 ? fmt::format("; the step was shortened {} times", work_.shortenings) : "");
    if (fluid_)
      for (const std::string& line : fluid_lines(*fluid_)) core::print(stderr, "{}\n", line);
    print_prediction(cpu_);
    print_invariants(observers_->invariants().worst());
    print_promise();
  }

  dem::Model model_;
  std::optional<dem::Observers> observers_;
  dem::Work work_, before_;           ///< in the last record; by earlier processes
  std::optional<FluidReport> fluid_;  ///< in the last record; absent without a fluid
  double cpu_ = 0;
  double history_at_ = -1;     ///< time of the last row, s
  bool emptied_ = false;       ///< all particles have left, and none is fed
  double settling_shown_ = 0;  ///< when, s
};

void run_dem(const RunOptions& options) {
  const core::Scene scene = read_scene(options, {&rules_of_dem()});
  core::give_back_what_is_freed();
  run_case<DemRun>(options, scene, "dem", require_particle_memory);
}

}  // namespace

void add_dem(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App& command = add_run(app, "dem", "run the case particle by particle", *options);
  commands.push_back({&command, doing([options] { run_dem(*options); }), [] { return On::all_ranks; }});
}

}  // namespace polybed::app
