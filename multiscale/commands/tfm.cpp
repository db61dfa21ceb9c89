// polybed tfm: runs a case as a continuum and writes its run directory.
#include <fmt/format.h>

#include <algorithm>

#include "core/case_file.hpp"
#include "core/interrupt.hpp"
#include "core/progress.hpp"
#include "core/ranks.hpp"
#include "core/run.hpp"
#include "multiscale/commands/options.hpp"
#include "multiscale/picture.hpp"
#include "multiscale/requirements.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/run_record.hpp"
#include "tfm/observers.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

core::Scene read_scene(const RunOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.until.empty()) {
    const bool text = options.until.find_first_not_of("0123456789.eE+-") != std::string::npos;
    overrides.push_back("run.until=" + (text ? "\"" + options.until + "\"" : options.until));
  }
  return core::read_case(options.case_path, overrides, all_roles(), size_classes);
}

void check_directory(const fs::path& directory, const RunOptions& options) {
  const bool used = fs::exists(directory / "run.json");
  const fs::path checkpoint = directory / "checkpoint.h5";
  if (options.resume && !fs::exists(checkpoint) && !fs::exists(core::previous_checkpoint(checkpoint)))
    throw core::FileError(
        fmt::format("{}: no checkpoint to resume from; leave out --resume to begin anew", directory.string()));
  if (used && !options.resume && !options.force)
    throw core::CaseError(
        fmt::format("{} holds a run already: --resume goes on with it, --force replaces it, -o DIR writes elsewhere",
                    directory.string()));
  core::make_directories(directory);
}

/// The checkpoint to go on from. One that is damaged gives way to the one before it, under its name, so that
/// the next one written does not push that out.
core::Checkpoint read_newest_checkpoint(const fs::path& directory) {
  const fs::path path = directory / "checkpoint.h5", previous = core::previous_checkpoint(path);
  try {
    return core::read_checkpoint(path);
  } catch (const core::FileError& error) {
    core::Checkpoint checkpoint;
    try {
      checkpoint = core::read_checkpoint(previous);
    } catch (const core::FileError&) {
      throw core::FileError(fmt::format("{}; there is no whole one before it: --force begins anew", error.what()));
    }
    fs::rename(previous, path);
    fmt::print(stderr, "{}\ngoing on from it\n", error.what());
    return checkpoint;
  }
}

/// What must be the same for a checkpoint to fit: the case without its end and its output times.
std::string physics_hash(core::Scene scene) {
  scene.run.until = 1;
  scene.output = {};
  return core::text_hash(core::resolved_case(scene));
}

/// One run from its scene to its record. On several ranks all of them compute; the first reads, writes and speaks.
class TfmRun {
 public:
  TfmRun(const RunOptions& options, core::Scene scene, fs::path directory, std::shared_ptr<const core::Ranks> ranks)
      : options_(options),
        scene_(std::move(scene)),
        directory_(std::move(directory)),
        ranks_(std::move(ranks)),
        first_(core::is_first(ranks_.get())),
        model_(scene_, timers_, ranks_) {
    options_.quiet = options_.quiet || !first_;
    prepare();
  }

  void run() {
    record("running");
    try {
      go();
    } catch (const core::Stopped&) {
      finish("stopped by the user");
      throw;
    } catch (const core::NumericsError& error) {
      fail(error);
    }
    finish("done");
  }

 private:
  void prepare() {
    std::optional<double> resume_time;
    model_.show(model_.time());
    std::vector<double> initial_mass = tfm::masses(model_);
    core::Checkpoint checkpoint;
    if (options_.resume) {
      core::on_first(ranks_.get(), [&] {
        checkpoint = read_newest_checkpoint(directory_);
        check_case_of(checkpoint);
        initial_mass = checkpoint.arrays.at("initial_mass");
      });
      model_.resume(checkpoint);
      core::take_from_first(ranks_.get(), initial_mass);
      resume_time = model_.time();
    } else if (scene_.bed.start.starts_with("checkpoint:")) {
      core::on_first(ranks_.get(), [&] {
        checkpoint = core::read_checkpoint(scene_.bed.start.substr(std::string("checkpoint:").size()));
      });
      model_.start_from(checkpoint);
      model_.show(0);
      initial_mass = tfm::masses(model_);
    }
    initial_mass_ = initial_mass;
    begin_ = model_.time();
    if (!options_.resume) core::on_first(ranks_.get(), [&] { remove_checkpoints(); });
    observers_.emplace(model_, directory_, scene_.tfm.rtol, initial_mass, resume_time);
  }

  void check_case_of(const core::Checkpoint& checkpoint) const {
    const auto hash = checkpoint.texts.find("physics_hash");
    if (hash == checkpoint.texts.end() || hash->second != physics_hash(scene_))
      throw core::CaseError(fmt::format("{}: the checkpoint is of another case; only run and output times may change",
                                        directory_.string()));
  }

  /// A run that begins anew and is killed at once must not be resumed from the run it replaces.
  void remove_checkpoints() const {
    const fs::path path = directory_ / "checkpoint.h5";
    fs::remove(path);
    fs::remove(core::previous_checkpoint(path));
  }

  void go() {
    core::Progress progress(options_.quiet, model_.time(), scene_.run.until);
    std::vector<core::Observer> observers;
    observers.push_back({"history", *scene_.output.history_every, [&](double t) { observers_->write_history(t); }});
    observers.push_back({"fields", *scene_.output.every, [&](double t) {
                           const auto scope = timers_.scope("output");
                           observers_->write_fields(t);
                         }});
    core::Stops stops{scene_.run.until, *scene_.output.checkpoint_every, model_.kinks()};
    core::run(
        model_, stops, observers, !options_.resume, [&](double) { write_checkpoint(); },
        [&] {
          observers_->log_step();
          if (progress.due(model_.time())) progress.show(line());
          return !core::on_any_rank(ranks_.get(), interrupt_.wanted());
        });
  }

  core::ProgressLine line() const {
    const fluid::WorstInvariant& worst = observers_->invariants().nearest();
    const tfm::StepLine& step = model_.last_step();
    return {model_.time(),
            scene_.run.until,
            step.step,
            step.limited_by,
            observers_->bed_height(),
            fmt::format("{} {:.0e} of {:.0e}", worst.name, worst.value, worst.limit)};
  }

  void write_checkpoint() {
    const auto scope = timers_.scope("output");
    core::Checkpoint checkpoint = model_.checkpoint();
    checkpoint.arrays["initial_mass"] = initial_mass_;
    checkpoint.texts["case"] = core::resolved_case(scene_);
    checkpoint.texts["physics_hash"] = physics_hash(scene_);
    core::on_first(ranks_.get(), [&] { core::write_checkpoint(directory_ / "checkpoint.h5", checkpoint); });
    record("running");
  }

  [[noreturn]] void fail(const core::NumericsError& error) {
    model_.keep_last_state();
    write_checkpoint();
    record(fmt::format("failed: {}", error.what()));
    throw core::NumericsError(fmt::format(
        "{}\nlast step: {:.3g} s, limited by {}; a checkpoint of t = {:.6g} s and steps.csv are in {}\n"
        "try a smaller tfm.rtol, the other tfm.integrator, or a looser start (bed.start_solids_fraction)",
        error.what(), model_.last_step().step, model_.last_step().limited_by, model_.time(), directory_.string()));
  }

  RunTotals record(const std::string& state) {
    const RunTotals totals = totals_of(model_, core::cpu_seconds() - cpu_begin_);
    core::on_first(ranks_.get(), [&] {
      write_run_record(directory_, {scene_, model_, *observers_, timers_, state, begin_, totals});
    });
    return totals;
  }

  void finish(const std::string& state) {
    const RunTotals totals = record(state);
    if (!first_) return;
    std::string message;
    if (!draw_picture(directory_, message) && !options_.quiet) fmt::print(stderr, "no picture: {}\n", message);
    if (!options_.quiet) print_summary(totals);
    if (options_.json)
      fmt::print("{}\n", run_record_text({scene_, model_, *observers_, timers_, state, begin_, totals}));
  }

  void print_summary(const RunTotals& totals) const {
    const tfm::Work work = model_.work();
    const double cpu = totals.cpu_seconds, simulated = model_.time() - begin_;
    fmt::print(stderr, "\n{:26} {:>9} {:>10}\n", "term", "s", "calls");
    for (const core::Timers::Term& term : timers_.terms())
      fmt::print(stderr, "{:26} {:9.3f} {:10}\n", term.name, term.seconds, term.calls);
    fmt::print(stderr, "\n{} steps ({} rejected), {} right-hand sides, {} pressure iterations, {} Newton, {} Krylov\n",
               work.steps, work.rejected_steps, work.right_hand_sides, work.pressure_iterations, work.newton_iterations,
               work.krylov_iterations);
    fmt::print(stderr, "{:.2f} CPU s for {:.4g} simulated s: {:.3f} per simulated second ({} integrator, {})\n", cpu,
               simulated, simulated > 0 ? cpu / simulated : 0.0, model_.integrator_name(), model_.integrator_reason());
    fmt::print(stderr, "convection of momentum: {} ({})\n", model_.momentum().name, model_.momentum().reason);
    for (const fluid::WorstInvariant& w : observers_->invariants().worst())
      fmt::print(stderr, "{}: worst {:.2e}, limit {:.0e}{}\n", w.name, w.value, w.limit,
                 w.value > w.limit ? "  <-- exceeded" : "");
    for (const tfm::ClosureUse& use : totals.closures)
      fmt::print(stderr, "{}: {:.3g} % of {:.3g} evaluations outside its range\n", use.name,
                 100.0 * double(use.guarded) / double(std::max<std::uint64_t>(use.evaluations, 1)),
                 double(use.evaluations));
    fmt::print(stderr, "{}\n", (directory_ / "picture.png").string());
  }

  core::Interrupt interrupt_;  // first: Ctrl-C while the model is made ends the run in order, too
  RunOptions options_;
  core::Scene scene_;
  fs::path directory_;
  std::shared_ptr<const core::Ranks> ranks_;
  bool first_;  ///< this process is the one that reads, writes and speaks
  core::Timers timers_;
  double cpu_begin_ = core::cpu_seconds(), begin_ = 0;
  tfm::Model model_;
  std::vector<double> initial_mass_;
  std::optional<tfm::Observers> observers_;
};

}  // namespace

fs::path default_run_directory(const fs::path& case_path, const std::string& model) {
  const fs::path path = fs::absolute(case_path);
  const std::string name = path.stem() == "case" ? path.parent_path().filename().string() : path.stem().string();
  return fs::path("runs") / (name + "-" + model);
}

void run_tfm(const RunOptions& options) {
  core::Scene scene = read_scene(options);
  const fs::path directory = options.output.empty() ? default_run_directory(options.case_path, "tfm") : options.output;
  const std::shared_ptr<const core::Ranks> ranks = core::Ranks::of_program();
  core::on_first(ranks.get(), [&] {
    require_memory(scene);
    check_directory(directory, options);
  });
  TfmRun run(options, std::move(scene), directory, ranks);
  run.run();
}

}  // namespace polybed::multiscale
