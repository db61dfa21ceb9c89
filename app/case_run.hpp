// One run of a case from its scene to its record, with either model. All ranks compute; the first one reads, writes and
// prints.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/run_directory.hpp"
#include "app/studies.hpp"
#include "core/interrupt.hpp"
#include "core/numerics/ranks.hpp"
#include "core/numerics/run.hpp"
#include "core/progress.hpp"
#include "core/timers.hpp"
#include "measures/invariants.hpp"
#include "multiscale/card/card.hpp"
#include "multiscale/effects/left_out.hpp"
#include "multiscale/effects/monitor.hpp"
#include "multiscale/estimate/estimate.hpp"

namespace polybed::app {

/// The timer for monitoring neglected effects.
inline constexpr const char* monitor_term = "monitor";

class CaseRun {
 public:
  virtual ~CaseRun() = default;
  void run();

 protected:
  /// \param model  "tfm" or "dem"
  CaseRun(const RunOptions& options, core::Scene scene, std::filesystem::path directory,
          std::shared_ptr<const core::Ranks> ranks, const std::string& model);

  /// Resumes the run for --resume, or the state for bed.start = "checkpoint:FILE", or starts anew. Collective.
  /// \param resume  with the checkpoint, on the first rank with all the file's contents, and the file's path
  /// \param start_from  likewise
  void prepare(const std::function<void(core::Checkpoint&, const std::filesystem::path&)>& resume,
               const std::function<void(core::Checkpoint&, const std::filesystem::path&)>& start_from);

  [[nodiscard]] virtual core::Simulation& simulation() = 0;
  [[nodiscard]] virtual std::vector<core::Observer> observers() = 0;
  [[nodiscard]] virtual core::Checkpoint checkpoint() = 0;
  /// Makes the rows of history.csv survive a power cut. Collective.
  virtual void flush_rows() = 0;
  /// Checkpoint data besides the state and the monitor: values that a resumed run cannot measure again. Collective.
  [[nodiscard]] virtual core::Json past() = 0;
  /// Restores that, once the observers of a continued run exist. Throws FileError for data that no run can have.
  void recall(const std::function<void(const core::Json&)>& take) const;
  /// Arrays of the checkpoint that are computed while it is written.
  [[nodiscard]] virtual std::vector<core::BlockData> checkpoint_rows() { return {}; }
  [[nodiscard]] virtual core::ProgressLine line() = 0;
  /// Text of run.json. Collective; valid on the first rank.
  [[nodiscard]] virtual std::string record_text(const std::string& state) = 0;
  /// Work and invariants, on standard error; on the first rank.
  virtual void print_summary() = 0;
  /// Description of a failure, and what to do about it.
  [[nodiscard]] virtual std::string advice() = 0;
  /// After a failed step: sets checkpoint() to the last good state.
  virtual void keep_last_state() {}
  /// After each step: false if the user requests a stop.
  [[nodiscard]] virtual bool after_step() { return !stop_wanted(); }
  /// Whether nothing remains to be simulated; the same on all ranks.
  [[nodiscard]] virtual bool is_over() { return false; }
  [[nodiscard]] virtual std::vector<double> breakpoints() { return {}; }
  /// The limit of the step so far; empty: no step yet.
  [[nodiscard]] virtual std::string limited_by() const = 0;
  /// Cost of the whole run, predicted before it.
  [[nodiscard]] virtual TimeBand predicted() = 0;
  /// The same from the measured cost of a step in this run, CPU s.
  [[nodiscard]] virtual TimeBand predicted_by(double /*seconds_per_step*/) { return predicted(); }

  /// Checks the measurements of a history row. A run that has violated a conservation law ends after the step, with all
  /// output due then written, unless it is permissive. Collective.
  void judge(std::span<const measures::WorstInvariant> worst);

  /// Writes "card", on the first rank. \param actual  CPU s of all ranks
  void write_card_of(core::Json& json, double actual);

  /// Writes "prediction". \param actual  CPU s of all ranks
  void write_prediction_of(core::Json& json, double actual);
  /// Prints it on standard error.
  void print_prediction(double actual);

  /// Lets the monitor, if there is one, evaluate the state after a step; prints its messages on the first rank.
  /// Collective.
  template <class Model>
  void watch(const Model& model) {
    if (!monitor_ || !monitor_->due()) return;
    const auto scope = timers_.scope(monitor_term);
    const std::size_t settings = monitor_->settings().size();
    say(monitor_->look(model));
    if (monitor_->settings().size() > settings) say({advice_of_monitor() + "  (end this run first: Ctrl-C)"});
  }
  /// How to continue after the monitor's warning.
  [[nodiscard]] std::string advice_of_monitor() const;
  /// The monitor's observations on all ranks, stored for print_promise(); empty without one. Collective.
  [[nodiscard]] std::optional<Neglected> neglected();
  /// The neglected effects by the case, and the monitor's table of bounds against observations.
  void print_promise() const;
  /// Prints lines on standard error, on the first rank, unless the run is quiet.
  void say(const std::vector<std::string>& lines) const;
  /// Wall time since this process started or resumed the run, s.
  [[nodiscard]] double wall_seconds() const;

  core::Interrupt interrupt_;  // first: Ctrl-C during construction of the model also ends the run in order
  RunOptions options_;
  core::Scene scene_;
  std::filesystem::path directory_;
  std::shared_ptr<const core::Ranks> ranks_;
  std::string model_name_;            ///< "tfm" or "dem"
  bool first_;                        ///< this process reads, writes and prints
  LeftOut left_out_;                  ///< on the first rank
  std::unique_ptr<Monitor> monitor_;  ///< null: no monitor
  core::Timers timers_;
  double cpu_begin_ = core::cpu_seconds(), begin_ = 0;

 private:
  std::optional<Neglected> promise_;
  std::string
      past_;  ///< from the checkpoint that the run continues; empty without one, or if an older version wrote it
  std::chrono::steady_clock::time_point clock_begin_ = std::chrono::steady_clock::now();
  [[nodiscard]] TimeBand prediction_of(double end) const;
  /// On any rank. Collective.
  [[nodiscard]] bool stop_wanted() const { return core::on_any_rank(ranks_.get(), interrupt_.wanted()); }
  void go();
  [[nodiscard]] bool has_become_steady();
  void write_checkpoint();
  void run_to_end();
  /// Writes run.json and returns its text. Collective.
  std::string record(const std::string& state);
  /// The same for a run that ends with an error; a failure to write it does not hide that error.
  void record_if_possible(const std::string& state);
  void finish(const std::string& state);
  void print_end(const std::string& record);
  void draw();
  /// The command that resumes this run. \param more  settings beside those that it has
  [[nodiscard]] std::string command_to_resume(const std::vector<std::string>& more) const;
  [[noreturn]] void fail(const core::NumericsError& error);

  BedOfCase expected_;                   ///< on the first rank
  Card card_;                            ///< of the last record
  TimeBand prediction_;                  ///< of the whole run
  bool refined_ = false;                 ///< based on steps of this run
  bool recorded_ = false;                ///< room for the record of the end was available once
  bool ended_ = false;                   ///< the run will not continue
  static constexpr double apart = 1.25;  ///< ratio of the times of two checks of steadiness
  double next_look_ = 0;                 ///< s
  bool was_steady_ = false, steady_ = false;
  std::optional<std::string> broken_law_;  ///< its message
};

/// Prints a line for each invariant, on standard error.
void print_invariants(std::span<const measures::WorstInvariant> worst);

/// Data for the start of a run.
struct RunStart {
  const std::filesystem::path& directory;
  const core::Scene& scene;
  std::string model;
  const core::Ranks* ranks;
  bool resumes;
};

/// Calls `start`, which starts the run. If it throws, writes the reason to run.json of a new run, if possible, and
/// rethrows. A wrong case leaves no record; neither does a start that fails before it has replaced an earlier run.
void start_run(const RunStart& run, const std::function<void()>& start);

/// Runs a case by a model in its run directory. \param require_room  throws for a case beyond the memory
template <class Run>
void run_case(const RunOptions& options, const core::Scene& scene, const std::string& model,
              void (*require_room)(const core::Scene&)) {
  const std::filesystem::path directory = run_directory(options, model);
  const std::shared_ptr<const core::Ranks> ranks = core::Ranks::of_program();
  std::unique_ptr<const core::OutputDirectory> taken;  // on the first rank
  core::on_first(ranks.get(), [&] {
    require_room(scene);
    taken = take_directory(directory, options);
  });
  // Reject a checkpoint of another case before its model is built, which could fail for other reasons.
  if (options.resume) core::on_first(ranks.get(), [&] { (void)read_checkpoint_of(directory, scene, model); });
  std::optional<Run> run;
  start_run({directory, scene, model, ranks.get(), options.resume},
            [&] { run.emplace(options, scene, directory, ranks); });
  run->run();
}

/// Prints the table of time by term.
void print_timers(const core::Timers& timers);

/// Prints the share of time for each of the longest terms: bars on a terminal, else one line.
void print_shares(const core::Timers& timers);

}  // namespace polybed::app
