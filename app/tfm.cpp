// polybed tfm: runs a case as a continuum and writes its run directory.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/case_run.hpp"
#include "app/commands.hpp"
#include "app/study_request.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "fluid/inlet.hpp"
#include "multiscale/requirements.hpp"
#include "multiscale/scene_warnings.hpp"
#include "multiscale/tfm_record.hpp"
#include "relevance/effect_row.hpp"
#include "tfm/evenness.hpp"
#include "tfm/observers.hpp"

namespace polybed::app {

namespace {

namespace fs = std::filesystem;

class TfmRun final : public CaseRun {
 public:
  TfmRun(const RunOptions& options, core::Scene scene, fs::path directory, std::shared_ptr<const core::Ranks> ranks)
      : CaseRun(options, std::move(scene), std::move(directory), std::move(ranks), "tfm"),
        model_(scene_, timers_, ranks_) {
    model_.go_on_above_packing(options_.permissive);
    for (const std::string& line : grid_warnings(scene_)) say({"warning: " + line});
    if (first_ && !options_.quiet)
      for (const std::string& line : model_.effects().warnings) core::print(stderr, "{}\n", line);
    model_.show(model_.time());
    initial_mass_ = tfm::masses(model_);
    prepare(
        [&](core::Checkpoint& checkpoint, const fs::path& path) {
          core::on_first(ranks_.get(), [&] { initial_mass_ = initial_mass_of(checkpoint); });
          read_fields(path, checkpoint);
          model_.resume(checkpoint);
          core::take_from_first(ranks_.get(), initial_mass_);
        },
        [&](core::Checkpoint& checkpoint, const fs::path& path) {
          read_fields(path, checkpoint);
          model_.start_from(checkpoint);
          model_.show(0);
          initial_mass_ = tfm::masses(model_);
        });
    const std::optional<double> resume_time = options_.resume ? std::optional(model_.time()) : std::nullopt;
    observers_.emplace(model_, directory_, scene_.tfm.rtol, initial_mass_, resume_time);
    recall([&](const core::Json& past) { recall_from(past); });
  }

 private:
  /// Every rank reads its block.
  void read_fields(const fs::path& path, core::Checkpoint& checkpoint) const {
    core::on_all(ranks_.get(), [&] { core::read_parts(path, model_.checkpoint_parts(), checkpoint); });
  }

  /// Initial mass of each species, kg.
  [[nodiscard]] std::vector<double> initial_mass_of(const core::Checkpoint& checkpoint) const {
    std::vector<double> mass = checkpoint.array("initial_mass");
    if (mass.size() != initial_mass_.size() || std::any_of(mass.begin(), mass.end(), [](double m) { return m < 0; }))
      core::refuse_checkpoint("initial_mass is not the mass of each species");
    return mass;
  }

  core::Json past() override {
    core::Json closures = core::Json::array(), limits = core::Json::object();
    for (const tfm::ClosureUse& use : closures_of(model_, closures_before_))
      closures.push_back({use.name, use.evaluations, use.guarded});
    for (const auto& [name, steps] : limits_) limits[name] = steps;
    return {{"observers", observers_->past()}, {"closures", closures}, {"limits", limits}};
  }

  void recall_from(const core::Json& past) {
    observers_->recall(core::member_of(past, "observers"));
    const core::Json& limits = core::member_of(past, "limits");
    for (const auto& [name, steps] : limits.items()) limits_[name] = core::count_of(steps);
    // The earlier process's counts include this one's so far. Unsigned differences wrap back correctly.
    const std::vector<core::Json>& before = core::array_of(core::member_of(past, "closures"));
    closures_before_ = closures_of(model_);
    for (std::size_t n = 0; n < closures_before_.size(); ++n) {
      tfm::ClosureUse& use = closures_before_[n];
      if (n >= before.size() || before[n].size() != 3 || core::text_of(before[n][0]) != use.name)
        throw core::FileError("no counts of " + use.name);
      use = {use.name, core::count_of(before[n][1]) - use.evaluations, core::count_of(before[n][2]) - use.guarded};
    }
  }

  void flush_rows() override { observers_->flush(); }
  core::Simulation& simulation() override { return model_; }
  std::vector<double> breakpoints() override { return model_.breakpoints(); }
  void keep_last_state() override { model_.keep_last_state(); }

  std::vector<core::Observer> observers() override {
    return {{"history", *scene_.output.history_every,
             [&](double t) {
               observers_->write_history(t);
               if (even_) warn_if_even(t);
               judge(observers_->invariants().worst());
             }},
            {"fields", *scene_.output.every, [&](double t) {
               const auto scope = timers_.scope("output");
               observers_->write_fields(t);
             }}};
  }

  bool after_step() override {
    observers_->log_step();
    ++limits_[limit()];
    watch(model_);
    return CaseRun::after_step();
  }

  core::ProgressLine line() override {
    const measures::WorstInvariant& worst = observers_->invariants().nearest();
    const double carried = observers_->force_balance();
    const std::string drop = carried != 0 && !scene_.flows_around()
                                 ? fmt::format("pressure drop {:.3g} of the weight  ", carried)
                                 : std::string();
    return {model_.time(),
            scene_.run.until,
            model_.last_step().step,
            limit(),
            observers_->bed_height(),
            fmt::format("{}closest to its limit: {}, {}", drop, worst.name, relevance::percent(worst.share()))};
  }

  /// What limits the last step, without the place.
  [[nodiscard]] std::string limit() const {
    const std::string& limited_by = model_.last_step().limited_by;
    return limited_by.substr(0, std::min(limited_by.find(" at ("), limited_by.find(": ")));
  }

  core::Checkpoint checkpoint() override {
    core::Checkpoint checkpoint = model_.checkpoint();
    checkpoint.arrays["initial_mass"] = initial_mass_;
    return checkpoint;
  }

  std::string advice() override {
    constexpr double least_met = 1e-8;  // tolerances below it are lost in the rounding of a stiff bed
    std::string steps;
    for (const tfm::StepLine& step : observers_->last_steps())
      steps += fmt::format("{:14.6g} {:12.3g}  {}\n", step.time, step.step, step.limited_by);
    return fmt::format(
        "the last steps: time, s; length, s; what limited it; steps.csv has all of them\n{}{}", steps,
        monitor_ && monitor_->has_stopped() ? advice_of_monitor()
        : scene_.tfm.fixed_step
            ? "tfm.fixed_step leaves no step to shrink: state a shorter one, or none"
            : fmt::format("try a {} tfm.rtol, the other tfm.integrator, or a looser start (bed.start_solids_fraction)",
                          scene_.tfm.rtol < least_met ? "larger" : "smaller"));
  }

  std::string record_text(const std::string& state) override {
    totals_ = totals_of(model_, core::cpu_seconds() - cpu_begin_, wall_seconds(), closures_before_);
    const std::optional<Neglected> promise = neglected();
    evenness_ = tfm::warning_of_an_even_bed(model_.constants().grid, model_.fields());
    std::vector<std::string> warnings = evenness_.empty() ? even_said_ : evenness_;
    if (std::string line = called_for_line(left_out_); !line.empty()) warnings.push_back(std::move(line));
    if (monitor_) warnings.insert(warnings.end(), monitor_->warnings().begin(), monitor_->warnings().end());
    return run_record_text({scene_, model_, *observers_, timers_, state, begin_, totals_, left_out_,
                            promise ? &*promise : nullptr, std::move(warnings), [&](core::Json& json) {
                              write_prediction_of(json, totals_.cpu_seconds);
                              write_card_of(json, totals_.cpu_seconds);
                            }});
  }

  /// The most frequent limit of the steps; ends set by the clock do not count.
  [[nodiscard]] std::string limited_by() const override {
    constexpr std::string_view by_clock = "event";
    std::uint64_t steps = 0;
    const std::pair<const std::string, std::uint64_t>* most = nullptr;
    for (const auto& limit : limits_) {
      steps += limit.second;
      if (limit.first != by_clock && (most == nullptr || limit.second > most->second)) most = &limit;
    }
    if (most == nullptr) return "";
    return fmt::format("{} in {:.0f} % of {} steps", most->first, 100 * double(most->second) / double(steps), steps);
  }

  TimeBand predicted() override { return tfm_time(scene_, model_, known_machine()); }
  TimeBand predicted_by(double seconds_per_step) override {
    return tfm_time(scene_, model_, known_machine(), seconds_per_step);
  }

  void print_summary() override {
    const tfm::Work work = model_.work();
    const double cpu = totals_.cpu_seconds, simulated = model_.time() - begin_;
    core::print(stderr, "\n{} steps ({} rejected), {} right-hand sides, {} pressure iterations, {} Newton, {} Krylov\n",
                work.steps, work.rejected_steps, work.right_hand_sides, work.pressure_iterations,
                work.newton_iterations, work.krylov_iterations);
    core::print(stderr, "{:.2f} CPU s for {:.4g} simulated s: {:.3f} per simulated second ({} integrator, {})\n", cpu,
                simulated, simulated > 0 ? cpu / simulated : 0.0, core::name_of(model_.integrator_kind()),
                model_.integrator_reason());
    core::print(stderr, "convection of momentum: {}\n", core::name_of(model_.momentum()));
    print_invariants(observers_->invariants().worst());
    for (const tfm::ClosureUse& use : totals_.closures)
      core::print(stderr, "{}: {:.3g} % of {:.3g} evaluations outside its range\n", use.name,
                  100.0 * double(use.guarded) / double(std::max<std::uint64_t>(use.evaluations, 1)),
                  double(use.evaluations));
    print_prediction(cpu);
    print_state_at_end();
  }

  void print_state_at_end() const {
    const tfm::LeastWellPosed& least = observers_->least_well_posed();
    std::string place;
    for (int axis = 0; axis < model_.constants().grid.dimensions; ++axis)
      place += fmt::format("{}{:.4g}", axis > 0 ? ", " : "", least.cell.place[std::size_t(axis)]);
    if (std::isfinite(least.cell.least))
      core::print(
          stderr,
          "well-posedness: least dp_s/dphi over its critical {:.2g} Pa is {:.3g}, at ({}) m, t = {:.4g} s; below "
          "1 in {:.3g} % of the bed's cells at the end\n",
          least.cell.critical_slope, least.cell.least, place, least.time, 100 * least.share_below_now);
    for (const std::string& text : evenness_) core::print(stderr, "{}\n", text);
    print_promise();
  }

  void warn_if_even(double t) {
    for (const std::string& line :
         even_->look(t, observers_->bed_height().value_or(HUGE_VAL), model_.constants().grid, model_.fields())) {
      say({"warning: " + line});
      even_said_.push_back(fmt::format("at {:.4g} s {}", t, line));
    }
  }

  tfm::Model model_;
  std::optional<tfm::EvennessWatch> even_ =
      tfm::EvennessWatch::of(model_.constants().grid, fluid::Ramp(scene_.inlet.superficial_velocity).greatest());
  std::vector<std::string> evenness_;   ///< warning in the last record
  std::vector<std::string> even_said_;  ///< during the run, with its time
  std::vector<double> initial_mass_;
  std::optional<tfm::Observers> observers_;
  std::map<std::string, std::uint64_t> limits_;   ///< number of steps by their limit
  std::vector<tfm::ClosureUse> closures_before_;  ///< by earlier processes
  RunTotals totals_;
};

void run_tfm(const RunOptions& options) {
  if (options.closure_uncertainty && options.stress_uncertainty)
    throw core::CaseError("--closure-uncertainty and --stress-uncertainty are two studies: give one of them at a time");
  if (options.closure_uncertainty) run_closure_uncertainty(options, "tfm", {&rules_of_tfm()});
  if (options.stress_uncertainty) run_stress_uncertainty(options);
  const core::Scene scene = read_scene(options, {&rules_of_tfm()});
  run_case<TfmRun>(options, scene, "tfm", require_memory);
}

}  // namespace

void add_tfm(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App& command = add_run(app, "tfm", "run the case as a continuum (two-fluid model)", *options);
  command.add_flag("--stress-uncertainty", options->stress_uncertainty,
                   "again with the stress table at plus and minus one standard error: the band of the bed height");
  command.add_flag("--closure-uncertainty", options->closure_uncertainty,
                   "again with the drag law moved within its band: the band of the bed height");
  commands.push_back({&command, doing([options] { run_tfm(*options); }), [options] {
                        return options->stress_uncertainty || options->closure_uncertainty ? On::study : On::all_ranks;
                      }});
}

}  // namespace polybed::app
