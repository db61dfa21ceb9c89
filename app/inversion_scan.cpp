// polybed inversion --scan: the inversion velocity by runs of one model or of both.
#include <fmt/format.h>

#include "app/run_directory.hpp"
#include "app/stress_uncertainty.hpp"
#include "core/case/file.hpp"
#include "core/case/units.hpp"
#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/files.hpp"
#include "core/print.hpp"
#include "dem/continuum_scene.hpp"
#include "measures/time_mean.hpp"
#include "multiscale/compare_window.hpp"
#include "multiscale/inversion/scan_file.hpp"
#include "multiscale/picture.hpp"
#include "multiscale/run_record.hpp"
#include "tfm/particle_scene.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

/// Part of a run in which the velocity goes from that of the run before to its own; far from the window, the last
/// quarter.
constexpr double ramp_share = 0.02;

measures::TimeMean mean_of(const fs::path& directory, const core::History& history, const Window& window,
                           const Series& values) {
  const auto mean = measures::time_mean(within(history.of("time_s"), values, window));
  if (!mean || !mean->error)
    throw core::CaseError(fmt::format(
        "{}: too few rows of its history in the last quarter to tell a mean: a smaller output.history_every gives more",
        directory.string()));
  return *mean;
}

/// The runs of a scan by one model, each in a folder called by its velocity and the hash of its case.
class RunsOfModel {
 public:
  /// \param name  of the scan, and of its folder  \param table  hash of its table of the solids stress, or empty
  RunsOfModel(const InversionOptions& options, std::string model, std::string name, std::string table,
              const fs::path& directory, double until)
      : options_(options),
        until_(until),
        model_(std::move(model)),
        name_(std::move(name)),
        table_(std::move(table)),
        directory_(directory / name_),
        ranks_(core::Ranks::of_program()) {}

  ScanOfModel scan(const ScanRange& range) {
    ScanResult result = scan_inversion(range, [&](double velocity, const auto& from) { return run(velocity, from); });
    return {model_, std::move(result), std::move(runs_), {}};
  }

 private:
  ScanMean run(double velocity, std::optional<std::size_t> from) {
    RunOptions run = options_;
    run.json = run.picture = run.stress_uncertainty = false;
    run.quiet = true;
    const std::vector<std::string> start = start_of(velocity, from);
    run.overrides.insert(run.overrides.end(), start.begin(), start.end());
    const core::Scene scene = read_scene(run);
    const std::string hash = core::text_hash(core::resolved_case(scene) + table_);
    run.output = directory_ / fmt::format("{:.3f}mm_s-{}", 1e3 * velocity, hash.substr(0, 10));
    RunOfScan found;
    found.directory = run.output;
    found.reused = finished(run.output);
    if (!found.reused) {
      run.resume = has_checkpoint(run.output);
      run.force = true;  // what a killed run has left without a checkpoint
      model_ == "tfm" ? run_tfm(run) : run_dem(run);
    }
    measure(found);
    runs_.push_back(found);
    velocities_.push_back(velocity);
    if (core::is_first(ranks_.get()) && !options_.json && !options_.quiet) {
      const std::optional<double> other = from ? std::optional(velocities_[*from]) : std::nullopt;
      core::print("{}", scan_line(name_, {velocity, from, found.mean}, found, other));
      std::fflush(stdout);
    }
    return found.mean;
  }

  /// What a run begins with. One that goes on from another has its velocity at first, which its fields are of, and its
  /// integrator, which would else be chosen by the velocity.
  [[nodiscard]] std::vector<std::string> start_of(double velocity, std::optional<std::size_t> from) const {
    if (!from) return {fmt::format("inlet.superficial_velocity={}", velocity)};
    const RunOfScan& source = runs_[*from];
    std::vector<std::string> start{
        fmt::format("inlet.superficial_velocity=[[0.0,{}],[{},{}]]", velocities_[*from], ramp_share * until_, velocity),
        fmt::format("bed.start=\"checkpoint:{}\"", checkpoint_path(source.directory).string())};
    if (model_ == "tfm") start.push_back(fmt::format("tfm.integrator=\"{}\"", source.integrator));
    return start;
  }

  /// Whether a folder holds a finished run; its name says of which case. Collective.
  [[nodiscard]] bool finished(const fs::path& directory) const {
    std::array<double, 1> done{};
    core::on_first(ranks_.get(), [&] {
      done[0] = fs::exists(directory / "run.json") && read_run_record(directory).of("state").text() == "done" ? 1 : 0;
    });
    core::take_from_first(ranks_.get(), done);
    return done[0] != 0;
  }

  /// Collective: the first rank reads, all know the mean.
  void measure(RunOfScan& run) const {
    core::on_first(ranks_.get(), [&] {
      const core::History history = core::read_history(run.directory);
      const std::vector<std::string> species = species_of(history);
      const Window window = window_of(history);
      const measures::TimeMean b = mean_of(run.directory, history, window, centre_difference(history, species));
      const measures::TimeMean height = mean_of(run.directory, history, window, history.of("bed_height_m"));
      run.mean = {b.mean, *b.error};
      run.bed_height = height.mean;
      run.bed_height_error = *height.error;
      run.begin = window.begin;
      run.end = window.end;
      run.drifts = drifts_in(history, species, window);
      const core::JsonValue record = read_run_record(run.directory);
      run.cpu_seconds = record.of("cpu_s").number();
      run.integrator = record.of("integrator").text();
      run.git_commit = record.of("git_commit").text();
    });
    std::array<double, 2> mean{run.mean.value, run.mean.error};
    core::take_from_first(ranks_.get(), mean);
    run.mean = {mean[0], mean[1]};
    if (ranks_) run.integrator = core::said_by(ranks_.get(), 0, run.integrator);
  }

  const InversionOptions& options_;
  double until_;  ///< s
  std::string model_, name_, table_;
  fs::path directory_;
  std::shared_ptr<const core::Ranks> ranks_;
  std::vector<RunOfScan> runs_;
  std::vector<double> velocities_;
};

/// By force balance with the case's law; empty without a law or a root.
std::optional<InversionPoint> force_balance(const core::Scene& scene) {
  const auto law = scene.effects.find("drag");
  if (law == scene.effects.end()) return std::nullopt;
  const auto points =
      inversion_points(binary_bed(scene), closures::drag_law(law->second, closures::Guard::on), "force_balance");
  return points.empty() ? std::nullopt : std::optional(points.back());
}

/// --from and --to, in their place a quarter below and above the force balance.
ScanRange range_of(const InversionOptions& options, const std::optional<InversionPoint>& balance) {
  const auto end = [&](const std::string& text, const char* option, double factor) {
    if (text.empty()) {
      if (!balance)
        throw core::CaseError("the force balance has no inversion point to begin at: --from and --to give the range");
      return factor * balance->velocity;
    }
    const auto given = core::parse_quantity(text);
    if (!given || (given->has_unit && !(given->dimension == core::dimension::velocity)) || !(given->value > 0))
      throw core::CaseError(fmt::format("{} {}: expected a velocity above 0, e.g. \"30 mm/s\"", option, text));
    return given->value;
  };
  const ScanRange range{end(options.from, "--from", 0.75), end(options.to, "--to", 1.25)};
  if (!(range.low < range.high)) throw core::CaseError("--from must be below --to");
  return range;
}

/// Scans of one model; with --stress-uncertainty those of the two-fluid model again, its table moved both ways.
ScanOfModel scan_of(const InversionOptions& options, const core::Scene& scene, const std::string& model,
                    const fs::path& directory, const ScanRange& range) {
  const std::string table = hash_of_table(scene);
  ScanOfModel scan = RunsOfModel(options, model, model, table, directory, scene.run.until).scan(range);
  if (!options.stress_uncertainty || model != "tfm") return scan;
  for (const auto& [name, sigma] : {std::pair("tfm-minus", -1.0), std::pair("tfm-plus", 1.0)}) {
    InversionOptions moved = options;
    moved.overrides.push_back(with_moved_table(scene, directory, name, sigma));
    scan.moved.push_back(RunsOfModel(moved, model, name, table, directory, scene.run.until).scan(range));
  }
  return scan;
}

}  // namespace

void run_inversion_scan(const InversionOptions& options) {
  const core::Scene scene = read_scene(options);
  static_cast<void>(binary_bed(scene));  // refuses what is not of two species
  const std::vector<std::string> models =
      options.scan == "both" ? std::vector<std::string>{"tfm", "dem"} : std::vector<std::string>{options.scan};
  if (options.scan != "dem") tfm::refuse_particle_scene(scene);
  if (options.scan != "tfm") dem::refuse_continuum_scene(scene);
  if (options.stress_uncertainty) {
    if (options.scan == "dem") throw core::CaseError("--stress-uncertainty is of the two-fluid model: --scan tfm");
    require_table(scene);
  }
  const std::optional<InversionPoint> balance = force_balance(scene);
  const ScanRange range = range_of(options, balance);
  const std::shared_ptr<const core::Ranks> ranks = core::Ranks::of_program();
  ScanRequest request{.case_file = options.case_path.string(),
                      .case_hash = hash_of_scanned(scene),
                      .overrides = options.overrides,
                      .species = {},
                      .directory = run_directory(options, "inversion"),
                      .force_balance = balance,
                      .models = options.scan,
                      .range = range,
                      .until = scene.run.until,
                      .ranks = ranks ? ranks->count() : 1};
  for (const core::Species& species : scene.species) request.species.push_back(species.name);
  std::unique_ptr<const core::OutputDirectory> taken;  // by the first rank
  core::on_first(ranks.get(), [&] { taken = std::make_unique<const core::OutputDirectory>(request.directory); });
  const bool speaks = core::is_first(ranks.get()) && !options.json;
  if (speaks && !options.quiet) core::print("{}", scan_head());
  std::vector<ScanOfModel> scans;
  for (const std::string& model : models) scans.push_back(scan_of(options, scene, model, request.directory, range));
  core::on_first(ranks.get(), [&] {
    const std::string text = scan_json(scans, request);
    core::write_atomically(request.directory / "inversion.json", text + "\n");
    if (options.json)
      core::print("{}\n", text);
    else
      core::print("{}{}\n", scan_findings(scans, request), (request.directory / "inversion.json").string());
    if (options.picture) draw_and_tell("polybed.scan", request.directory, "picture", options.json || options.quiet);
  });
}

}  // namespace polybed::multiscale
