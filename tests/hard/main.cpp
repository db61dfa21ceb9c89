// polybed-hard: hard cases against every scheme and every textbook treatment, and drawn scenes.
#include <CLI/CLI.hpp>

#include "app/process.hpp"
#include "core/print.hpp"
#include "hard/options.hpp"

namespace {

using namespace polybed;

core::ExitCode run(int argc, char** argv) {
  hard::Options options;
  CLI::App app{"polybed stability: hard cases against every scheme, cell by cell what held", "polybed stability"};
  app.add_option("--suite", options.suite, "ci: takes minutes | full")->check(CLI::IsMember({"ci", "full"}));
  app.add_option("--only", options.only, "cases, separated by commas, e.g. T7,C4");
  app.add_option("--schemes", options.schemes, "separated by commas, e.g. implicit/limited");
  app.add_option("--naive", options.naive, "textbook treatments, separated by commas, or all");
  app.add_option("--fuzz", options.draws, "this many scenes drawn from the envelope, in place of the catalogue");
  app.add_option("--draw", options.draw, "these drawn scenes alone, numbers separated by commas, e.g. 738,965")
      ->delimiter(',');
  app.add_option("--seed", options.seed, "of the draws");
  app.add_option("--cpu", options.cpu, "s of computing after which a drawn scene ends where it is")
      ->capture_default_str();
  app.add_option("-j,--jobs", options.jobs, "cells at once")->check(CLI::Range(1, 256));
  app.add_option("-o,--output", options.output, "default runs/stability");
  app.add_flag("--json", options.json, "one JSON object on standard output, nothing else there");
  app.add_flag("--oracles", options.oracles, "print numbers of problems with known answers")->group("");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? core::ExitCode::done : core::ExitCode::wrong_case;
  }
  if (options.oracles) return hard::run_oracles();
  return options.draws > 0 || !options.draw.empty() ? run_drawn(options) : run_matrix(options);
}

}  // namespace

int main(int argc, char** argv) {
  const app::Ending ending = app::guarded([&] { return run(argc, argv); });
  if (!ending.message.empty()) core::print(stderr, "{}\n", ending.message);
  return ending.code;
}
