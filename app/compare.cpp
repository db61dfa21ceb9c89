// polybed compare: both models on one case, or two runs of it, measured over the same window.
#include "multiscale/compare.hpp"
#include "core/print.hpp"

#include <fmt/format.h>

#include "app/run_directory.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/files.hpp"
#include "dem/continuum_scene.hpp"
#include "multiscale/case_differences.hpp"
#include "multiscale/comparison_text.hpp"
#include "multiscale/picture.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/run_record.hpp"
#include "tfm/particle_scene.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

/// A run's record; throws FileError if it is none of this model's.
ComparedRun read_run(const fs::path& directory, const std::string& model) {
  ComparedRun run{directory, read_run_record(directory)};
  if (const std::string& found = run.record.of("model").text(); found != model)
    throw core::FileError(fmt::format("{}: a run of {}, not of {}", (directory / "run.json").string(), found, model));
  return run;
}

void refuse_difference(const std::string& name, const std::string& text, const std::string& other_name,
                       const std::string& other) {
  const std::vector<core::Role> roles = all_roles();
  const std::vector<Difference> found = case_differences(text, other, roles);
  if (found.empty()) return;
  std::string message = fmt::format("{} and {} are not of one case:", name, other_name);
  for (const Difference& d : found) message += fmt::format("\n  {}: {} and {}", d.key, d.first, d.second);
  throw core::CaseError(message);
}

/// Runs a model into a folder of the comparison. One that has a checkpoint there is gone on with, if asked for.
fs::path run_model(const CompareOptions& options, const std::string& model, void (&run)(const RunOptions&)) {
  RunOptions of_model = options;
  of_model.output = run_directory(options, "compare") / model;
  of_model.json = false;
  of_model.resume = options.resume && has_checkpoint(of_model.output);
  run(of_model);
  return of_model.output;
}

/// Refuses what one of the models to be run cannot, before the other takes its hours.
void refuse_before_running(const CompareOptions& options, const core::Scene& scene) {
  if (options.tfm.empty()) tfm::refuse_particle_scene(scene);
  if (options.dem.empty()) dem::refuse_continuum_scene(scene);
}

/// Refuses a given run that is none of this case, likewise.
void look_at_given(const CompareOptions& options, const core::Scene& scene, const fs::path& directory,
                   const std::string& model) {
  if (directory.empty()) return;
  const ComparedRun run = read_run(directory, model);
  refuse_difference(options.case_path.string(), core::resolved_case(scene), directory.string(),
                    run.record.of("case").text());
}

void warn_if_unfinished(Comparison& comparison, const std::string& model, const ComparedRun& run) {
  if (const std::string& state = run.record.of("state").text(); state != "done")
    comparison.warnings.push_back(fmt::format("{}: the run is not done ({})", model, state));
}

/// Adds the score of the inversion velocity where a scan of the case by both models has found it, and near to it leaves
/// the layers more room.
void add_inversion(const CompareOptions& options, const core::Scene& scene, Comparison& comparison) {
  std::optional<FoundInversion> found;
  if (!options.inversion.empty() && !fs::exists(options.inversion / "inversion.json"))
    throw core::FileError(fmt::format("{}: no scan (it has no inversion.json)", options.inversion.string()));
  try {
    found = read_inversion(
        options.inversion.empty() ? default_run_directory(options.case_path, "inversion") : options.inversion, scene);
  } catch (const core::CaseError&) {
    if (!options.inversion.empty()) throw;  // the default one may be of the case as it was before
  }
  if (found) take_up(comparison, *found, scene.inlet.superficial_velocity.back().second);
}

void compare_runs(const CompareOptions& options, const core::Scene& scene, const fs::path& tfm_directory,
                  const fs::path& dem_directory) {
  const ComparedRun tfm = read_run(tfm_directory, "tfm"), dem = read_run(dem_directory, "dem");
  const std::string tfm_case = tfm.record.of("case").text(), dem_case = dem.record.of("case").text();
  refuse_difference(tfm_directory.string(), tfm_case, dem_directory.string(), dem_case);
  Comparison comparison = compare({core::read_history(tfm_directory), core::read_profiles(tfm_directory)},
                                  {core::read_history(dem_directory), core::read_profiles(dem_directory)});
  add_inversion(options, scene, comparison);
  warn_if_unfinished(comparison, "tfm", tfm);
  warn_if_unfinished(comparison, "dem", dem);
  const fs::path directory = run_directory(options, "compare"), path = directory / "comparison.json";
  const std::string text =
      comparison_json(comparison, tfm, dem, {options.case_path.string(), scene.overrides, directory});
  core::write_atomically(path, text + "\n");
  if (options.json)
    core::print("{}\n", text);
  else
    core::print("{}{}\n", comparison_table(comparison, tfm, dem), path.string());
  if (options.picture) draw_and_tell("polybed.comparison", directory, "page", options.json || options.quiet);
}

}  // namespace

void run_compare(const CompareOptions& options) {
  const core::Scene scene = read_scene(options);
  const std::shared_ptr<const core::Ranks> ranks = core::Ranks::of_program();
  refuse_before_running(options, scene);
  std::unique_ptr<const core::OutputDirectory> taken;  // by the first rank
  core::on_first(ranks.get(), [&] {
    look_at_given(options, scene, options.tfm, "tfm");
    look_at_given(options, scene, options.dem, "dem");
    taken = std::make_unique<const core::OutputDirectory>(run_directory(options, "compare"));
  });
  const fs::path tfm = options.tfm.empty() ? run_model(options, "tfm", run_tfm) : options.tfm;
  const fs::path dem = options.dem.empty() ? run_model(options, "dem", run_dem) : options.dem;
  core::on_first(ranks.get(), [&] { compare_runs(options, scene, tfm, dem); });
}

}  // namespace polybed::multiscale
