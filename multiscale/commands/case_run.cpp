#include "multiscale/commands/case_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/case_file.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "multiscale/picture.hpp"

namespace polybed::multiscale {

CaseRun::CaseRun(const RunOptions& options, core::Scene scene, std::filesystem::path directory,
                 std::shared_ptr<const core::Ranks> ranks, const std::string& model)
    : options_(options),
      scene_(std::move(scene)),
      case_(scene_),
      directory_(std::move(directory)),
      ranks_(std::move(ranks)),
      first_(core::is_first(ranks_.get())) {
  options_.quiet = options_.quiet || !first_;
  core::on_first(ranks_.get(), [&] { left_out_ = left_out(scene_, model); });
}

void CaseRun::prepare(const std::function<void(core::Checkpoint&, const std::filesystem::path&)>& resume,
                      const std::function<void(core::Checkpoint&, const std::filesystem::path&)>& start_from) {
  core::Checkpoint checkpoint;
  const std::string word = "checkpoint:";
  if (options_.resume) {
    core::on_first(ranks_.get(), [&] { checkpoint = read_checkpoint_of(directory_, case_); });
    resume(checkpoint, checkpoint_path(directory_));
  } else if (scene_.bed.start.starts_with(word)) {
    const std::filesystem::path path = scene_.bed.start.substr(word.size());
    core::on_first(ranks_.get(), [&] { checkpoint = core::read_checkpoint(path); });
    start_from(checkpoint, path);
  }
  begin_ = simulation().time();
  if (!options_.resume) core::on_first(ranks_.get(), [&] { remove_checkpoints(directory_); });
}

/// Of a run that goes on: the share that is left.
void CaseRun::predict() {
  const double left = std::clamp(1 - begin_ / scene_.run.until, 0.0, 1.0);
  const TimeBand whole = predicted();
  prediction_ = {left * whole.least, left * whole.expected, left * whole.most};
}

void CaseRun::write_prediction_of(core::Json& json, const std::string& state, double actual) const {
  write_prediction(json, prediction_, state == "done", actual);
}

void CaseRun::print_prediction(double actual) const {
  fmt::print(stderr, "predicted {:.3g} s of computing ({:.3g} to {:.3g}), took {:.3g}\n", prediction_.expected,
             prediction_.least, prediction_.most, actual);
}

bool CaseRun::run() {
  predict();
  record("running");
  try {
    go();
  } catch (const core::Stopped&) {
    if (switches()) return false;
    finish("stopped by the user");
    throw;
  } catch (const core::NumericsError& error) {
    fail(error);
  }
  finish("done");
  return true;
}

void CaseRun::go() {
  core::Progress progress(options_.quiet, simulation().time(), scene_.run.until);
  core::Stops stops{scene_.run.until, *scene_.output.checkpoint_every, kinks()};
  core::run(
      simulation(), stops, observers(), !options_.resume, [&](double) { write_checkpoint(); },
      [&] {
        if (progress.due(simulation().time())) progress.show(line());
        return after_step();
      });
}

double CaseRun::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - clock_begin_).count();
}

bool CaseRun::after_step() { return !core::on_any_rank(ranks_.get(), interrupt_.wanted()); }

void CaseRun::say(const std::vector<std::string>& lines) const {
  if (options_.quiet) return;
  for (const std::string& line : lines) fmt::print(stderr, "{}\n", line);
}

std::optional<Neglected> CaseRun::promise_of(const Monitor* monitor) {
  if (monitor != nullptr) promise_ = monitor->result(ranks_.get());
  return promise_;
}

void CaseRun::print_promise() const {
  for (const std::string& line : left_out_lines(left_out_)) fmt::print(stderr, "{}\n", line);
  if (!promise_) return;
  fmt::print(stderr, "{}", neglected_table(*promise_));
  for (const core::Timers::Term& term : timers_.terms())
    if (term.name == "monitor")
      fmt::print(stderr, "watching it took {:.2g} % of the time\n",
                 100 * term.seconds / std::max(core::cpu_seconds() - cpu_begin_, 1e-9));
}

void CaseRun::write_checkpoint() {
  const auto scope = timers_.scope("output");
  core::Checkpoint state = checkpoint();
  add_case(state, case_);
  add_switches(state);
  core::write_checkpoint(checkpoint_path(directory_), state, ranks_.get());
  record("running");
}

void CaseRun::fail(const core::NumericsError& error) {
  keep_last_state();
  write_checkpoint();
  record(fmt::format("failed: {}", error.what()));
  throw core::NumericsError(fmt::format("{}\na checkpoint of t = {:.6g} s is in {}\n{}", error.what(),
                                        simulation().time(), directory_.string(), advice()));
}

void CaseRun::record(const std::string& state) {
  const std::string text = record_text(state);
  core::on_first(ranks_.get(), [&] { core::write_atomically(directory_ / "run.json", text + "\n"); });
}

void CaseRun::finish(const std::string& state) {
  const std::string text = record_text(state);
  core::on_first(ranks_.get(), [&] { core::write_atomically(directory_ / "run.json", text + "\n"); });
  if (!first_) return;
  std::string message;
  const bool drawn = options_.picture && draw_picture(directory_, message);
  if (!options_.quiet) {
    print_timers(timers_);
    print_summary();
    if (drawn) fmt::print(stderr, "{}\n", message);
    if (options_.picture && !drawn) fmt::print(stderr, "no picture: {}\n", message);
  }
  if (options_.json) fmt::print("{}\n", text);
}

void print_timers(const core::Timers& timers) {
  fmt::print(stderr, "\n{:26} {:>9} {:>10}\n", "term", "s", "calls");
  for (const core::Timers::Term& term : timers.terms())
    fmt::print(stderr, "{:26} {:9.3f} {:10}\n", term.name, term.seconds, term.calls);
}

}  // namespace polybed::multiscale
