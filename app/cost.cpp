// polybed cost: error against time for a case, and what follows from it.
#include <fmt/format.h>

#include "app/comma_list.hpp"
#include "app/options.hpp"
#include "app/run_directory.hpp"
#include "core/case/file.hpp"
#include "core/case/units.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/print.hpp"
#include "dem/continuum_scene.hpp"
#include "multiscale/cost/check.hpp"
#include "multiscale/cost/judge.hpp"
#include "multiscale/cost/report.hpp"
#include "multiscale/cost/selftest.hpp"
#include "multiscale/roles.hpp"
#include "tfm/particle_scene.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

/// "1%" or "0.01".
double target_of(const std::string& text) {
  std::string number = text;
  const bool percent = !number.empty() && number.back() == '%';
  if (percent) number.pop_back();
  const auto value = core::parse_quantity(number);
  if (!value || value->has_unit || !(value->value > 0))
    throw core::CaseError(fmt::format("--target {}: expected an error, e.g. 1%", text));
  return percent ? value->value / 100 : value->value;
}

double budget_of(const std::string& text) {
  const auto value = core::parse_quantity(text);
  if (!value || (value->has_unit && !(value->dimension == core::dimension::time)) || !(value->value > 0))
    throw core::CaseError(fmt::format("--budget {}: expected a time, e.g. 20min", text));
  return value->value;
}

SweepOptions sweep_options(const CostOptions& options, const core::Scene& scene) {
  SweepOptions sweep;
  const bool particles = options.model == "dem" || (options.model.empty() && !tfm::only_for_particles(scene).empty());
  if (particles)
    dem::refuse_continuum_scene(scene);
  else
    tfm::refuse_particle_scene(scene);
  sweep.model = particles ? "dem" : "tfm";
  sweep.quantities = comma_list(options.quantities);
  sweep.axes = comma_list(options.axes);
  sweep.target = target_of(options.target);
  sweep.budget = budget_of(options.budget);
  sweep.repeat = options.repeat;
  sweep.clock = options.clock;
  sweep.reference = options.reference;
  sweep.seed = options.seed;
  sweep.quiet = options.quiet || options.json;
  return sweep;
}

core::ExitCode run_sweep_of(const CostOptions& options) {
  const core::Scene scene = read_scene(options);
  const fs::path directory = run_directory(options, "cost");
  if (fs::exists(directory / "cost.json") && !options.resume && !options.force)
    throw core::CaseError(
        fmt::format("{} holds a sweep already: --resume goes on with it, --force replaces it", directory.string()));
  if (options.reference != "auto" && options.reference != "exact" &&
      !fs::exists(fs::path(options.reference) / "profiles.h5"))
    throw core::FileError(fmt::format("--reference {}: no run directory", options.reference));
  const core::OutputDirectory taken(directory);
  core::make_folder(directory / "runs");
  std::vector<std::string> overrides = scene.overrides;
  for (const std::string& override : common_overrides(scene)) overrides.push_back(override);
  Runner runner(scene, options.case_path, overrides, directory / "runs", options.resume);
  const Sweep sweep = run_sweep(scene, sweep_options(options, scene), runner);
  const SweepOf of{fs::absolute(options.case_path).lexically_normal().string(), core::resolved_case(scene), overrides};
  const std::string no_picture = write_sweep(sweep, of, directory, options.picture);
  if (options.json)
    core::print("{}\n", sweep_json(sweep, of));
  else
    core::print("{}\n{}\n", sweep_markdown(sweep, of), (directory / "cost.json").string());
  if (!no_picture.empty()) core::print(stderr, "no picture: {}\n", no_picture);
  return sweep.outcome == "done" ? core::ExitCode::done : core::ExitCode::numerics;
}

core::ExitCode held(bool good) { return good ? core::ExitCode::done : core::ExitCode::numerics; }

void need_words(const CostOptions& options, std::size_t count, const char* usage) {
  if (options.words.size() != count) throw core::CaseError(fmt::format("usage: polybed cost {}", usage));
}

}  // namespace

core::ExitCode run_cost(CostOptions options) {
  const std::string first = options.words.empty() ? "" : options.words.front();
  if (first == "check") {
    need_words(options, 2, "check DIR");
    return held(check_recommendation(options.words[1]));
  }
  if (first == "diff") {
    need_words(options, 3, "diff OLD.json NEW.json");
    return held(print_difference(options.words[1], options.words[2]));
  }
  if (first == "selftest") {
    need_words(options, 1, "selftest");
    return held(print_selftest());
  }
  need_words(options, 1, "CASE, check DIR, diff OLD NEW or selftest");
  options.case_path = first;
  return run_sweep_of(options);
}

}  // namespace polybed::multiscale
