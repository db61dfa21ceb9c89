// polybed-hard --fuzz and --draw: scenes drawn from the declared envelope, and the least case of each that fails.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/output/directory.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "core/version.hpp"
#include "hard/fuzz.hpp"
#include "hard/options.hpp"

namespace polybed::hard {

namespace {

namespace fs = std::filesystem;

constexpr std::array<Outcome, 4> outcomes{Outcome::pass, Outcome::degraded, Outcome::refused, Outcome::fail};

/// What comes of a draw alone.
Result result_of_draw(const Draw& draw, double cpu) { return results_of({case_text(draw)}, 1, cpu).front(); }

/// What came of each draw that has ended, by its number.
using Results = std::map<std::uint64_t, Result>;

/// The numbers of the draws: those of --draw, or the first of the sequence.
std::vector<std::uint64_t> numbers_of(const Options& options) {
  std::vector<std::uint64_t> numbers(options.draw.empty() ? options.draws : 0);
  std::iota(numbers.begin(), numbers.end(), std::uint64_t(0));
  numbers.insert(numbers.end(), options.draw.begin(), options.draw.end());
  return numbers;
}

std::string fuzz_text(const Options& options, const Results& results) {
  core::Json all = core::Json::array();
  for (const auto& [n, r] : results)
    all.push_back({{"draw", n},
                   {"outcome", name_of(r.outcome)},
                   {"broken", r.broken},
                   {"worst", r.worst.id},
                   {"value", r.worst.value},
                   {"limit", r.worst.limit},
                   {"steps", r.work.steps},
                   {"cpu_s", r.cpu},
                   {"cause", r.cause},
                   {"reported", r.reported}});
  return core::json_text({{"filetype", "polybed fuzz"},
                          {"version", 1},
                          {"git_commit", core::git_commit()},
                          {"draws", numbers_of(options).size()},
                          {"seed", options.seed},
                          {"results", all}}) +
         "\n";
}

/// Keeps the least case of each kind of failure: others of a kind are most likely the same mistake.
void keep_least_cases(const Options& options, const Results& results, const fs::path& directory) {
  const fs::path hard = "cases/hard", found = (fs::is_directory(hard) ? hard : directory) / "found";
  std::map<std::string, std::string> shown;
  for (const auto& [n, result] : results) {
    const std::string kind = kind_of(result);
    if (result.outcome != Outcome::fail || shown.contains(kind)) continue;
    const Draw least = shrunk(draw_of(options.seed, n), [&](const Draw& draw) {
      const Result now = result_of_draw(draw, options.cpu);
      return now.outcome == Outcome::fail && kind_of(now) == kind;
    });
    shown[kind] = keep({n, least, result_of_draw(least, options.cpu)}, options.seed, found).string();
    if (!options.json) core::print("{} (draw {}), as a least case: {}\n", kind, n, shown[kind]);
  }
}

}  // namespace

core::ExitCode run_drawn(const Options& options) {
  const fs::path directory = options.output.empty() ? fs::path("runs/stability") : options.output;
  const core::OutputDirectory taken(directory);
  const std::vector<std::uint64_t> numbers = numbers_of(options);
  std::vector<std::string> texts;
  for (const std::uint64_t n : numbers) texts.push_back(case_text(draw_of(options.seed, n)));
  Results results;
  const bool chosen = !options.draw.empty();
  const auto seen = [&](std::size_t place, const Result& r) {
    const std::uint64_t n = numbers[place];
    results[n] = r;
    // Thousands take hours: what has been found is there whatever ends the command.
    if (constexpr std::size_t often = 20; results.size() % often == 0)
      core::write_atomically(directory / "fuzz.json", fuzz_text(options, results));
    if (chosen || r.outcome == Outcome::fail)
      core::write_atomically(directory / fmt::format("draw-{}.toml", n), texts[place]);
    const bool well = r.outcome == Outcome::pass || r.outcome == Outcome::refused;
    if (options.json || (well && !chosen)) return;
    core::print("draw {}: {} {} ({} = {:.3g}, limit {:.3g}) {}\n", n, name_of(r.outcome), r.broken, r.worst.id,
                r.worst.value, r.worst.limit, r.cause);
    std::fflush(stdout);
  };
  (void)results_of(texts, options.jobs, options.cpu, seen);
  core::write_atomically(directory / "fuzz.json", fuzz_text(options, results));
  keep_least_cases(options, results, directory);
  if (options.json) core::print("{}", fuzz_text(options, results));
  for (const Outcome outcome : outcomes) {
    const auto count =
        std::count_if(results.begin(), results.end(), [&](const auto& r) { return r.second.outcome == outcome; });
    if (!options.json)
      core::print("{:8} {:6} of {}, {:.1f} %\n", name_of(outcome), count, results.size(),
                  100.0 * double(count) / double(results.size()));
  }
  const bool failed =
      std::any_of(results.begin(), results.end(), [](const auto& r) { return r.second.outcome == Outcome::fail; });
  return failed ? core::ExitCode::numerics : core::ExitCode::done;
}

}  // namespace polybed::hard
