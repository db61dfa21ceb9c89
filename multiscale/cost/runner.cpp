#include "multiscale/cost/runner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/directory.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/output/json_value.hpp"
#include "multiscale/child_program.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

std::string last_lines(const fs::path& path) {
  constexpr std::size_t most = 300;
  std::string text = core::read_text(path);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.size() > most ? "..." + text.substr(text.size() - most) : text;
}

bool all_held(const core::JsonValue& record) {
  const auto invariants = record.object().find("invariants");
  if (invariants == record.object().end()) return true;
  const auto& all = invariants->second.array();
  return std::all_of(all.begin(), all.end(), [](const core::JsonValue& one) { return one.of("held").truth(); });
}

/// What a sweep reads of a run.
constexpr std::array<std::string_view, 3> read_later{"history.csv", "steps.csv", "profiles.h5"};

/// Whether a run lies there that came to its own end, not to that of an earlier budget.
bool ended(const fs::path& directory) {
  return fs::exists(directory / "end.json") && !core::read_json(directory / "end.json").of("timed_out").truth();
}

}  // namespace

Runner::Runner(const core::Scene& scene, fs::path case_path, std::vector<std::string> overrides, fs::path folder,
               bool resume)
    : case_path_(std::move(case_path)),
      folder_(std::move(folder)),
      case_text_(core::resolved_case(scene)),
      overrides_(std::move(overrides)),
      resume_(resume),
      cells_(double(scene.column.cells[0]) * scene.column.cells[1] * scene.column.cells[2]) {}

std::vector<std::string> Runner::words_of(const RunOrder& order, const fs::path& directory) const {
  std::vector<std::string> words{order.model, case_path_.string(), "--quiet", "--no-picture", "--force",
                                 "-o",        directory.string()};
  for (const auto* list : {&overrides_, &order.overrides})
    for (const std::string& override : *list) words.insert(words.end(), {"--set", override});
  return words;
}

void Runner::start(const RunOrder& order, const fs::path& directory, double seconds) const {
  core::mark_directory(directory);
  core::remove_results(directory);
  const ChildExit end = run_child({words_of(order, directory), order.ranks, directory / "output.txt"}, seconds);
  core::remove_results(directory, read_later);  // neither fields nor checkpoints
  core::Json json;
  json.begin_object().member("code", end.code).member("timed_out", end.timed_out).member("wall_s", end.wall);
  core::write_atomically(directory / "end.json", json.end_object().text() + "\n");
}

RunOutcome Runner::read(const fs::path& directory) const {
  const core::JsonValue end = core::read_json(directory / "end.json");
  RunOutcome outcome;
  outcome.wall = end.of("wall_s").number();
  const int code = int(end.of("code").number());
  if (end.of("timed_out").truth()) {
    outcome.state = "not run";
    outcome.reason = fmt::format("ended after {:.3g} s: the budget was over", outcome.wall);
    return outcome;
  }
  if (code != 0) {
    outcome.state = code == int(core::ExitCode::wrong_case) ? "refused" : "failed";
    outcome.reason = fmt::format("code {}: {}", code, last_lines(directory / "output.txt"));
    return outcome;
  }
  const core::JsonValue record = core::read_json(directory / "run.json");
  const core::JsonValue& timers = record.of("timers");
  const auto output = timers.object().find("output");
  outcome.state = "done";
  outcome.simulated = record.of("time_s").number();
  outcome.cpu = record.of("cpu_s").number() - (output != timers.object().end() ? output->second.number() : 0);
  outcome.invariants_held = all_held(record);
  outcome.measured = Measured{core::read_history(directory), core::read_profiles(directory)};
  outcome.counters = counters_of(record, cells_);
  return outcome;
}

RunOutcome Runner::run(const RunOrder& order, double seconds, int again) {
  std::string name = core::text_hash(fmt::format("{} {} {} {} {}", case_text_, fmt::join(overrides_, " "), order.model,
                                                 order.ranks, fmt::join(order.overrides, " ")));
  if (again > 0) name += fmt::format("-{}", again);
  const fs::path directory = folder_ / name;
  const bool seen = std::find(seen_.begin(), seen_.end(), name) != seen_.end();
  if (!seen && !(resume_ && ended(directory))) {
    if (!(seconds > 0)) return {"not run", "the budget was over", 0, 0, 0, true, {}, {}};
    start(order, directory, seconds);
  }
  RunOutcome outcome = read(directory);
  if (!seen) {
    seen_.push_back(name);
    spent_ += outcome.wall;
  }
  return outcome;
}

}  // namespace polybed::multiscale
