#include "app/case_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/numerics/schedule.hpp"
#include "core/output/files.hpp"
#include "core/output/history.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "multiscale/program.hpp"
#include "multiscale/python_module.hpp"
#include "multiscale/requirements.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/run_record.hpp"
#include "multiscale/scene_warnings.hpp"

namespace polybed::app {

namespace {
constexpr const char* past_name = "past";  // name of a text in the checkpoint
}

CaseRun::CaseRun(const RunOptions& options, core::Scene scene, std::filesystem::path directory,
                 std::shared_ptr<const core::Ranks> ranks, const std::string& model)
    : options_(options),
      scene_(std::move(scene)),
      directory_(std::move(directory)),
      ranks_(std::move(ranks)),
      model_name_(model),
      first_(core::is_first(ranks_.get())),
      monitor_(Monitor::of(scene_, model)) {
  options_.quiet = options_.quiet || !first_;
  core::on_first(ranks_.get(), [&] {
    left_out_ = left_out(scene_, model);
    expected_ = bed_of_case(scene_);
  });
  for (const std::string& line : scene_warnings(scene_)) say({"warning: " + line});
  if (const std::string line = chosen_line(scene_); !line.empty()) say({line});
  if (const std::string line = called_for_line(left_out_); !line.empty()) say({"warning: " + line});
}

void CaseRun::prepare(const std::function<void(core::Checkpoint&, const std::filesystem::path&)>& resume,
                      const std::function<void(core::Checkpoint&, const std::filesystem::path&)>& start_from) {
  core::Checkpoint checkpoint;
  if (options_.resume) {
    core::on_first(ranks_.get(), [&] { checkpoint = read_checkpoint_of(directory_, scene_, model_name_); });
    core::name_checkpoint(checkpoint_path(directory_), [&] { resume(checkpoint, checkpoint_path(directory_)); });
    past_ = core::said_by(ranks_.get(), 0, checkpoint.texts[past_name]);
  } else if (scene_.bed.start.kind == core::StartKind::checkpoint) {
    const std::filesystem::path path = scene_.bed.start.file;
    core::on_first(ranks_.get(), [&] { checkpoint = core::read_checkpoint(path); });
    core::name_checkpoint(path, [&] { start_from(checkpoint, path); });
  }
  begin_ = simulation().time();
  // A new run that is killed at once must not be resumed from the run that it replaces.
  if (!options_.resume) core::on_first(ranks_.get(), [&] { core::remove_results(directory_); });
}

void CaseRun::recall(const std::function<void(const core::Json&)>& take) const {
  if (past_.empty()) return;
  core::name_checkpoint(checkpoint_path(directory_), [&] {
    try {
      const core::Json past = core::parse_json(past_);
      take(past);
      if (monitor_ && past.contains("monitor")) monitor_->recall(past["monitor"], ranks_.get());
    } catch (const core::FileError& error) {
      core::refuse_checkpoint(fmt::format("what it says of the run before: {}", error.what()));
    }
  });
}

/// The band for the part simulated by this process or, while it runs, for the part until `end`.
TimeBand CaseRun::prediction_of(double end) const {
  const double share = scene_.run.until > 0 ? std::max((end - begin_) / scene_.run.until, 0.0) : 1;
  return prediction_.part(share, !options_.resume);
}

void CaseRun::write_prediction_of(core::Json& json, double actual) {
  write_prediction(json, prediction_of(ended_ ? simulation().time() : scene_.run.until), ended_, actual);
}

void CaseRun::write_card_of(core::Json& json, double actual) {
  if (!first_) return;
  card_ = {expected_,
           {},
           limited_by(),
           left_out_,
           promise_ ? promise_->met() : std::nullopt,
           ended_ ? std::optional(actual) : std::nullopt,
           prediction_of(ended_ ? simulation().time() : scene_.run.until)};
  try {
    card_.seen = bed_of_run(scene_, core::read_history(directory_));
    using enum Fluidisation;
    if (card_.seen.state == packed && expected_.state == partly_fluidised) card_.seen.state = partly_fluidised;
  } catch (const core::FileError&) {  // no row yet, or removed meanwhile: the card is empty there
  }
  write_card(json, scene_, card_);
}

void CaseRun::print_prediction(double actual) {
  const TimeBand part = prediction_of(simulation().time());
  core::print(stderr, "predicted {:.3g} s of computing ({:.3g} to {:.3g}), took {:.3g}\n", part.expected, part.least,
              part.most, actual);
}

void CaseRun::run() {
  try {
    run_to_end();
  } catch (const core::FileError& error) {
    record_if_possible(fmt::format("failed: {}", error.what()));
    throw;
  }
}

void CaseRun::run_to_end() {
  prediction_ = predicted();
  (void)record("running");
  try {
    go();
  } catch (const core::Stopped&) {
    if (!steady_ && !is_over()) {
      finish("stopped by the user");
      throw;
    }
  } catch (const core::NumericsError& error) {
    fail(error);
  }
  finish("done");
}

void CaseRun::go() {
  // The earlier run ended this way.
  if (is_over()) return;
  constexpr double longest = 20;  // in units of run.until
  const double until = options_.until_steady() ? longest * scene_.run.until : scene_.run.until;
  core::Progress progress(options_.quiet, simulation().time(), options_.until_steady() ? scene_.run.until : until);
  core::Stops stops{until, *scene_.output.checkpoint_every, breakpoints()};
  next_look_ = std::max(0.5 * scene_.run.until, apart * simulation().time());
  for (const double change : stops.breakpoints) next_look_ = std::max(next_look_, apart * change);
  const double begin = core::cpu_seconds();
  int steps = 0;
  core::run(
      simulation(), stops, observers(), !options_.resume, [&](double) { write_checkpoint(); },
      [&] {
        if (broken_law_) throw core::ConservationError(*broken_law_);
        // Times steps for as long as `polybed check` does; with ranks each process has only its own CPU time.
        ++steps;
        if (!refined_ && ranks_ == nullptr && core::cpu_seconds() - begin > sample_seconds) {
          refined_ = true;
          prediction_ = predicted_by((core::cpu_seconds() - begin - timers_.seconds("output")) / steps);
        }
        if (progress.due(simulation().time())) {
          core::ProgressLine now = line();
          now.to_steady = options_.until_steady();
          progress.show(now);
        }
        return after_step() && !has_become_steady() && !is_over();
      },
      [this] { return stop_wanted(); });
}

/// Two checks in a row must find the bed steady: one of many checks of a drifting bed can do so by chance. Collective.
bool CaseRun::has_become_steady() {
  if (!options_.until_steady() || simulation().time() < next_look_) return false;
  next_look_ = apart * simulation().time();
  flush_rows();
  bool now = false;
  if (first_) try {
      now = bed_of_run(scene_, core::read_history(directory_)).steady.value_or(false);
    } catch (const core::FileError&) {  // no row yet
    }
  steady_ = core::on_any_rank(ranks_.get(), now && was_steady_);
  was_steady_ = now;
  return steady_;
}

double CaseRun::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - clock_begin_).count();
}

void CaseRun::judge(std::span<const measures::WorstInvariant> worst) {
  if (options_.permissive) return;
  const measures::WorstInvariant* law = measures::broken_law(worst);
  if (!core::on_any_rank(ranks_.get(), law != nullptr)) return;
  const int rank = core::rank_of_greatest(ranks_.get(), law != nullptr ? 1 : 0);
  broken_law_ = core::said_by(ranks_.get(), rank, law != nullptr ? law->text() : "");
}

void CaseRun::say(const std::vector<std::string>& lines) const {
  if (options_.quiet) return;
  for (const std::string& line : lines) core::print(stderr, "{}\n", line);
}

std::string CaseRun::command_to_resume(const std::vector<std::string>& more) const {
  const std::string ranks = ranks_ != nullptr && ranks_->count() > 1 ? fmt::format("-n {} ", ranks_->count()) : "";
  std::string command =
      fmt::format("{} {}{} {} -o {} --resume", typed_program(), ranks, model_name_,
                  core::shell_word(options_.case_path.string()), core::shell_word(directory_.string()));
  for (const auto& settings : {options_.overrides, more})
    for (const std::string& setting : settings) command += " --set " + core::shell_word(setting);
  return command;
}

std::string CaseRun::advice_of_monitor() const {
  if (monitor_->settings().empty())
    return "the effect cannot be added to a run that has begun: begin anew with it, or raise chooser.tolerance";
  std::vector<std::string> chosen;  // the added effect could change these
  for (const std::string& role : scene_.chooser.chosen)
    if (!find_entry(role)->effect->set_keys)
      chosen.push_back(fmt::format("effects.{}={}", role, core::law_of(scene_, role)));
  chosen.insert(chosen.end(), monitor_->settings().begin(), monitor_->settings().end());
  return "to go on with the effect: " + command_to_resume(chosen);
}

std::optional<Neglected> CaseRun::neglected() {
  if (monitor_) promise_ = monitor_->result(ranks_.get());
  return promise_;
}

void CaseRun::print_promise() const {
  for (const std::string& line : left_out_lines(left_out_)) core::print(stderr, "{}\n", line);
  if (!promise_) return;
  core::print(stderr, "{}", neglected_table(*promise_));
  for (const core::Timers::Term& term : timers_.terms())
    if (term.name == monitor_term)
      core::print(stderr, "watching it took {} of the time\n",
                  relevance::percent(term.seconds / std::max(core::cpu_seconds() - cpu_begin_, 1e-9)));
}

void CaseRun::write_checkpoint() {
  const auto scope = timers_.scope("output");
  core::Checkpoint state = checkpoint();
  add_case(state, scene_);
  core::Json told = past();
  if (monitor_) told["monitor"] = monitor_->past(ranks_.get());
  state.texts[past_name] = core::json_text(told);
  flush_rows();  // a run continued from the checkpoint does not write them again
  core::write_checkpoint(checkpoint_path(directory_), std::move(state), ranks_.get(), checkpoint_rows());
  (void)record("running");
}

void CaseRun::fail(const core::NumericsError& error) {
  keep_last_state();
  std::string kept = fmt::format("a checkpoint of t = {:.6g} s is in {}", simulation().time(), directory_.string());
  try {
    write_checkpoint();
  } catch (const core::FileError& file_error) {
    kept = file_error.what();
  } catch (const core::NumericsError&) {  // about its record, which is written once more below
  }
  record_if_possible(fmt::format("failed: {}", error.what()));
  const bool law = dynamic_cast<const core::ConservationError*>(&error) != nullptr;
  throw core::NumericsError(
      fmt::format("{}\n{}\n{}", error.what(), kept, law ? "to go on all the same: --resume --permissive" : advice()));
}

void CaseRun::record_if_possible(const std::string& state) {
  ended_ = true;
  try {
    (void)record(state);
  } catch (const core::FileError&) {  // the error that ended the run says more
  }
}

std::string CaseRun::record(const std::string& state) {
  const std::string text = record_text(state);
  core::on_first(ranks_.get(), [&] {
    const std::filesystem::path path = directory_ / "run.json";
    if (ended_) return core::write_last(path, text + "\n");
    constexpr std::size_t more = 4096;  // beyond the record of an active run: the reason for its end, its last steps
    const std::size_t room = 2 * text.size() + more;
    if (!recorded_) core::claim_room(path, text.size() + room);  // else the end of the run could not be recorded
    recorded_ = true;
    core::write_atomically(path, text + "\n");
    core::keep_room(path, room);
  });
  return text;
}

void CaseRun::finish(const std::string& state) {
  ended_ = true;
  const std::string text = record(state);
  if (!first_) return;
  if (!options_.quiet) {
    if (options_.details) {
      print_timers(timers_);
      print_summary();
    }
    print_end(text);
  }
  if (options_.json) core::print("{}\n", text);
  (void)core::refusal_of_answer();  // the answer leaves before a picture is drawn
  if (options_.picture) draw();
}

/// Last, for it takes a second or two.
void CaseRun::draw() {
  std::string message;
  const bool drawn = draw_picture(directory_, message);
  if (!options_.quiet) core::print(stderr, "{}{}\n", drawn ? "" : "no picture: ", message);
}

/// Warnings, then the card.
void CaseRun::print_end(const std::string& record) {
  const core::Json json = core::parse_json(record);
  for (const core::Json& warning : core::array_of(core::member_of(json, "warnings"))) {
    core::put(stderr, core::Colour::yellow, "warning:");
    core::print(stderr, " {}\n", core::text_of(warning));
  }
  if (!options_.details) print_shares(timers_);
  const std::string state = core::text_of(core::member_of(json, "state"));
  core::print(stderr, "\n");
  core::put(stderr, core::Colour::bold, scene_.title.empty() ? "result" : scene_.title);
  core::print(stderr, "\n{}\n",
              card_line("run", fmt::format("{}, {:.4g} s of {} in {}", state, simulation().time(), model_name_,
                                           directory_.string())));
  for (const std::string& line : result_lines(card_)) core::print(stderr, "{}\n", line);
  if (!card_.seen.steady || *card_.seen.steady || is_over()) return;
  const double reached = simulation().time();
  const double until = core::is_later(scene_.run.until, reached) ? scene_.run.until : 2 * reached;
  core::print(stderr, "{}\n",
              card_line("to go on", fmt::format("{} --until \"{:.4g} s\"", command_to_resume({}), until)));
}

void print_invariants(std::span<const measures::WorstInvariant> worst) {
  for (const measures::WorstInvariant& w : worst)
    core::print(stderr, "{}: worst {:.2e}, limit {:.0e}{}\n", w.name, w.value, w.limit,
                w.value <= w.limit ? "" : "  <-- exceeded");
}

namespace {

/// run.json of a run that failed before it started.
void record_failed_start(const RunStart& run, const std::string& state) {
  core::Json json;
  begin_record(json, run.scene, run.model, state, run.ranks == nullptr ? 1 : run.ranks->count());
  json["time_s"] = 0;
  json["warnings"] = core::Json::array();
  try {
    core::write_last(run.directory / "run.json", core::json_text(json) + "\n");
  } catch (const core::FileError&) {  // the error that ended the start says more
  }
}

}  // namespace

void start_run(const RunStart& run, const std::function<void()>& start) {
  try {
    start();
  } catch (const core::CaseError&) {
    throw;
  } catch (const std::exception& error) {
    const bool stopped = dynamic_cast<const core::Stopped*>(&error) != nullptr;
    if (core::is_first(run.ranks) && !run.resumes && !has_checkpoint(run.directory))
      record_failed_start(run, stopped ? "stopped by the user" : fmt::format("failed: {}", error.what()));
    throw;
  }
}

void print_shares(const core::Timers& timers) {
  constexpr std::size_t most_terms = 5;
  constexpr double bar = 30;
  std::vector<core::Timers::Term> terms = timers.terms();
  double all = 0;
  for (const core::Timers::Term& term : terms) all += term.seconds;
  if (!(all > 0)) return;
  std::stable_sort(terms.begin(), terms.end(), [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
  if (terms.size() > most_terms) terms.resize(most_terms);
  if (!core::is_terminal(stderr)) {
    std::string line;
    for (const core::Timers::Term& term : terms)
      line += fmt::format("{}{} {:.0f} %", line.empty() ? "" : ", ", term.name, 100 * term.seconds / all);
    return core::print(stderr, "time by term: {}\n", line);
  }
  for (const core::Timers::Term& term : terms) {
    core::print(stderr, "{:26} {:3.0f} % ", term.name, 100 * term.seconds / all);
    core::put(stderr, core::Colour::blue, std::string(std::size_t(bar * term.seconds / all + 0.5), '#') + "\n");
  }
}

void print_timers(const core::Timers& timers) {
  core::print(stderr, "\n{:26} {:>9} {:>10}\n", "term", "s", "calls");
  for (const core::Timers::Term& term : timers.terms())
    core::print(stderr, "{:26} {:9.3f} {:10}\n", term.name, term.seconds, term.calls);
}

}  // namespace polybed::app
