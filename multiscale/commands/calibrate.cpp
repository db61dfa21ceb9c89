// polybed calibrate: boxes of particles, and the table of the solids stress that they measure.
#include <fmt/format.h>

#include <chrono>
#include <ctime>

#include "core/case_file.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/json.hpp"
#include "core/progress.hpp"
#include "core/version.hpp"
#include "fluid/properties.hpp"
#include "multiscale/calibrate/bed_table.hpp"
#include "multiscale/calibrate/check_table.hpp"
#include "multiscale/calibrate/fit.hpp"
#include "multiscale/calibrate/pool.hpp"
#include "multiscale/calibrate/table_text.hpp"
#include "multiscale/commands/options.hpp"
#include "multiscale/commands/run_directory.hpp"
#include "multiscale/roles.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

/// Particle-steps per second of sheared boxes, looked at every fourth step, on the development machine.
constexpr double particle_steps_per_second = 1.5e7;

fs::path file_of(const fs::path& directory, const core::Scene& scene, const BoxPoint& point) {
  return directory / "boxes" / (box_hash(scene, point) + ".json");
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
  return text;
}

/// Boxes that are run, with those finished before, in the order asked for.
class Boxes {
 public:
  Boxes(const CalibrateOptions& options, const core::Scene& scene, fs::path directory, std::vector<BoxPoint> points)
      : options_(options), scene_(scene), directory_(std::move(directory)), points_(std::move(points)) {
    for (const BoxPoint& p : points_) {
      expected_.push_back(particle_steps_of(scene_, p) / particle_steps_per_second);
      done_.push_back(read_box(file_of(directory_, scene_, p), box_hash(scene_, p)).has_value());
    }
  }

  [[nodiscard]] double expected_left() const {
    double left = 0;
    for (std::size_t n = 0; n < points_.size(); ++n) left += done_[n] ? 0 : expected_[n];
    return left;
  }
  [[nodiscard]] std::size_t left() const { return std::size_t(std::count(done_.begin(), done_.end(), false)); }

  std::vector<BoxResult> run() {
    core::make_directories(directory_ / "boxes");
    std::vector<Job> jobs;
    std::vector<std::size_t> place;
    for (std::size_t n = 0; n < points_.size(); ++n)
      if (!done_[n]) {
        jobs.push_back({arguments(points_[n]), expected_[n]});
        place.push_back(n);
      }
    const auto begin = std::chrono::steady_clock::now();
    const double all = expected_left();
    const core::Interrupt interrupt;
    const std::vector<std::size_t> failed = run_jobs(
        jobs, options_.jobs,
        [&](std::size_t job) {
          done_[place[job]] = true;
          const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
          const double left_now = expected_left();
          if (!options_.quiet)
            fmt::print(stderr, "{} of {} boxes; about {} left\n", points_.size() - left(), points_.size(),
                       core::duration_text(passed * left_now / std::max(all - left_now, 1e-9)));
        },
        [&] { return !interrupt.wanted(); });
    if (!failed.empty())
      throw core::NumericsError(fmt::format("{} boxes failed, the first at phi = {:g}; finished ones are kept",
                                            failed.size(), points_[place[failed.front()]].phi));
    return results();
  }

 private:
  [[nodiscard]] std::vector<std::string> arguments(const BoxPoint& p) const {
    std::vector<std::string> a{"calibrate",
                               options_.case_path.string(),
                               "-o",
                               directory_.string(),
                               "--box",
                               fmt::format("{} {} {} {} {} {} {} {}", p.regime, p.phi, p.stokes, p.restitution,
                                           p.friction, p.share, p.binary ? 1 : 0, p.seed)};
    for (const std::string& set : options_.overrides) a.insert(a.end(), {"--set", set});
    return a;
  }

  [[nodiscard]] std::vector<BoxResult> results() const {
    std::vector<BoxResult> all;
    for (const BoxPoint& p : points_) {
      auto box = read_box(file_of(directory_, scene_, p), box_hash(scene_, p));
      if (!box)
        throw core::FileError(file_of(directory_, scene_, p).string() + ": the box that should lie here is not whole");
      all.push_back(*box);
    }
    return all;
  }

  const CalibrateOptions& options_;
  const core::Scene& scene_;
  fs::path directory_;
  std::vector<BoxPoint> points_;
  std::vector<double> expected_;
  std::vector<bool> done_;
};

/// The box that a line of the command names; run by the command itself for each of its boxes.
void run_one(const core::Scene& scene, const fs::path& directory, const std::string& text) {
  BoxPoint p;
  char regime[8] = {};
  int binary = 0;
  if (std::sscanf(text.c_str(), "%7s %lf %lf %lf %lf %lf %d %d", regime, &p.phi, &p.stokes, &p.restitution, &p.friction,
                  &p.share, &binary, &p.seed) != 8)
    throw core::CaseError("--box is for the command's own use");
  p.regime = regime;
  p.binary = binary != 0;
  core::make_directories(directory / "boxes");
  write_box(file_of(directory, scene, p), run_box(scene, p));
}

/// With --json standard output is the object's alone.
std::FILE* people(const CalibrateOptions& options) { return options.json ? stderr : stdout; }

void print_plan(const Plan& plan, const Boxes& boxes, const CalibrateOptions& options) {
  const int jobs = options.jobs;
  std::FILE* out = people(options);
  fmt::print(out, "regime {}: {}\n", plan.regime.name, plan.regime.reason);
  for (const fluid::RegimeNumbers& n : plan.regime.numbers)
    fmt::print(out, "  {}: gamma tau_p {:.2g}, St* {:.2g} to {:.2g}, St_gamma {:.2g} (voidage {:.3f}, {:.3g} 1/s)\n",
               n.species, n.shear_times_relaxation, n.stokes_least, n.stokes_most, n.stokes_of_shear, n.voidage,
               n.shear_rate);
  fmt::print(out, "{} boxes: phi {}, stokes {}, e {}, mu_p {}, x2 {}, seeds {}; {} left, about {} on {} at once\n",
             plan.boxes.size(), plan.axes.phi.size(), plan.axes.stokes.size(), plan.axes.restitution.size(),
             plan.axes.friction.size(), plan.axes.share.size(), plan.boxes.size() / plan.axes.points(), boxes.left(),
             core::duration_text(boxes.expected_left() / jobs), jobs);
}

fluid::SolidsTable table_of(const core::Scene& scene, const Plan& plan, const std::vector<BoxResult>& boxes) {
  fluid::SolidsTable table = fitted(plan, boxes);
  table.created = now();
  table.git_commit = core::git_commit();
  table.case_hash = core::text_hash(core::resolved_case(scene));
  if (plan.binary) table.size_ratio = scene.species[1].diameter / scene.species[0].diameter;
  return table;
}

void print_json(const fs::path& directory, const Plan& plan, double residual, double left_out) {
  core::Json json;
  json.begin_object().member("table", (directory / "table.h5").string()).member("regime", plan.regime.name);
  json.member("reason", plan.regime.reason).member("boxes", std::uint64_t(plan.boxes.size()));
  json.member("fit_residual", residual).member("left_out_residual", left_out).end_object();
  fmt::print("{}\n", json.text());
}

/// Runs points between the knots of a table and tells how they compare.
void check_table(const CalibrateOptions& options, const core::Scene& scene, const fs::path& directory,
                 const Plan& plan) {
  const fluid::SolidsTable table = fluid::read_solids_table(options.check);
  if (table.regime != plan.regime.name)
    throw core::CaseError(fmt::format("{} is a {} table, the boxes of the case are {}: {}", options.check.string(),
                                      table.regime, plan.regime.name, plan.regime.reason));
  Boxes boxes(options, scene, directory, points_between(table, plan));
  std::vector<Deviation> deviations;
  for (const BoxResult& box : boxes.run()) deviations.push_back(deviation(table, box));
  const std::string lines = deviation_lines(deviations);
  fmt::print(people(options), "{}", lines);
  core::write_atomically(directory / "check.txt", lines);
}

/// Fluidised boxes: p_bed by both measures, and the table of that by slabs.
void finish_bed(const CalibrateOptions& options, const fs::path& directory, const core::Scene& scene, const Plan& plan,
                const std::vector<BoxResult>& boxes) {
  const double density = fluid::fluid_constants(scene.fluid).density, solid = boxes.front().density;
  const double weight = std::abs(1 - density / solid) * scene.column.gravity * boxes.front().diameter;
  const BedTable table = bed_table(plan, boxes, weight);
  const std::string lines = bed_lines(boxes) + "\n" + bed_rows(table);
  fmt::print(people(options), "{}", lines);
  core::write_atomically(directory / "boxes.txt", lines);
  require_usable(table);
  write_bed_table(directory / "table.h5", table, now(), core::text_hash(core::resolved_case(scene)));
  fmt::print(people(options), "table: {}\n", (directory / "table.h5").string());
  if (options.json) print_json(directory, plan, 0, 0);
}

}  // namespace

void run_calibrate(const CalibrateOptions& options) {
  const core::Scene scene = core::read_case(options.case_path, options.overrides, all_roles(), size_classes);
  const fs::path directory =
      options.output.empty() ? default_run_directory(options.case_path, "calibrate") : options.output;
  if (!options.box.empty()) return run_one(scene, directory, options.box);
  const Plan plan = plan_of(scene);
  if (!options.check.empty()) return check_table(options, scene, directory, plan);
  Boxes boxes(options, scene, directory, plan.boxes);
  print_plan(plan, boxes, options);
  if (options.plan_only) return;
  const std::vector<BoxResult> results = boxes.run();
  if (plan.regime.name == "bed") return finish_bed(options, directory, scene, plan, results);
  const fluid::SolidsTable table = table_of(scene, plan, results);
  const std::string lines = box_lines(results);
  fmt::print(people(options), "{}", lines);
  core::write_atomically(directory / "boxes.txt", lines);
  std::FILE* out = people(options);
  fmt::print(out, "residual {:.2f} %, with a solids fraction left out {:.2f} %\n", 100 * table.residual,
             100 * table.left_out);
  if (const double up_to = falls_in_shear_up_to(table); up_to > 0)
    fmt::print(out, "at fixed shear rate without a fluid the pressure falls up to phi = {:.3f}, as a dilute gas does\n",
               up_to);
  require_usable(table);
  fluid::write_solids_table(directory / "table.h5", table);
  core::write_atomically(directory / "table.toml", table_toml(table, plan, results));
  fmt::print(out, "table: {}\n", (directory / "table.h5").string());
  if (options.json) print_json(directory, plan, table.residual, table.left_out);
}

}  // namespace polybed::multiscale
