// polybed calibrate: boxes of particles, and the table of the solids stress that they measure.
#include <fmt/format.h>

#include <ctime>
#include <optional>

#include "app/calibrate_boxes.hpp"
#include "app/options.hpp"
#include "app/run_directory.hpp"
#include "core/case/file.hpp"
#include "core/output/directory.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "core/progress.hpp"
#include "core/version.hpp"
#include "multiscale/calibrate/bed_table.hpp"
#include "multiscale/calibrate/check_table.hpp"
#include "multiscale/calibrate/fit.hpp"
#include "multiscale/calibrate/table_text.hpp"
#include "multiscale/effects/choice.hpp"
#include "multiscale/roles.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

std::string now() {
  const std::time_t time = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
  return text;
}

/// The box that a line of the command names; run by the command itself for each of its boxes.
void run_one(const core::Scene& scene, const fs::path& directory, const std::string& text) {
  BoxPoint p;
  char regime[8] = {};
  int binary = 0, pushed = 0;
  if (std::sscanf(text.c_str(), "%7s %lf %lf %lf %lf %lf %d %d %d", regime, &p.phi, &p.stokes, &p.restitution,
                  &p.friction, &p.share, &binary, &pushed, &p.seed) != 9)
    throw core::CaseError("--box is for the command's own use");
  p.regime = regime;
  p.binary = binary != 0;
  p.pushed = pushed != 0;
  core::make_folder(directory / "boxes");
  write_box(file_of(directory, scene, p), run_box(scene, p));
}

/// With --json standard output is the object's alone.
std::FILE* people(const CalibrateOptions& options) { return options.json ? stderr : stdout; }

void print_plan(const Plan& plan, const Boxes& boxes, const CalibrateOptions& options) {
  std::FILE* out = people(options);
  core::print(out, "regime {}: {}\n", plan.regime.name, plan.regime.reason);
  for (const fluid::RegimeNumbers& n : plan.regime.numbers)
    core::print(out, "  {}: gamma tau_p {:.2g}, St* {:.2g} to {:.2g}, St_gamma {:.2g} (voidage {:.3f}, {:.3g} 1/s)\n",
                n.species, n.shear_times_relaxation, n.stokes_least, n.stokes_most, n.stokes_of_shear, n.voidage,
                n.shear_rate);
  if (plan.binary && !plan.pushed())
    core::print(
        out,
        "no beta_12: it is measured in dry boxes alone. Here a push would meet drag towards the flow and films, "
        "whose part the drag law of the two-fluid model has already\n");
  core::print(out, "{} boxes: phi {}, stokes {}, e {}, mu_p {}, x2 {}, seeds {}; {} left, about {} on {} at once\n",
              plan.boxes.size(), plan.axes.phi.size(), plan.axes.stokes.size(), plan.axes.restitution.size(),
              plan.axes.friction.size(), plan.axes.share.size(), plan.least_seeds(), boxes.left(),
              core::duration_text(boxes.expected_left() / boxes.at_once()), boxes.at_once());
}

fluid::SolidsTable table_of(const core::Scene& scene, const Plan& plan, const std::vector<BoxResult>& boxes) {
  fluid::SolidsTable table = fitted(plan, boxes);
  table.created = now();
  table.git_commit = core::git_commit();
  table.case_hash = core::text_hash(core::resolved_case(scene));
  if (plan.binary) table.size_ratio = scene.species[1].diameter / scene.species[0].diameter;
  return table;
}

/// What a fit was tested by: by no scatter where a point has one box, and by no curve where there are too few solids
/// fractions to leave one out.
struct Tested {
  std::optional<double> error, residual, left_out;
};

Tested tested(const fluid::SolidsTable& table, const Plan& plan) {
  Tested by;
  if (plan.least_seeds() > 1) by.error = greatest_error(table);
  if (table.phi.size() < least_to_leave_one_out) return by;
  by.residual = table.residual;
  by.left_out = table.left_out;
  return by;
}

void print_json(const fs::path& directory, const Plan& plan, const Tested& by) {
  core::Json json;
  json.begin_object().member("table", (directory / "table.h5").string()).member("regime", plan.regime.name);
  json.member("reason", plan.regime.reason).member("boxes", std::uint64_t(plan.boxes.size()));
  json.member("greatest_error", by.error).member("fit_residual", by.residual);
  json.member("left_out_residual", by.left_out).end_object();
  core::print("{}\n", json.text());
}

void print_plan_json(const Plan& plan, const Boxes& boxes) {
  core::Json json;
  json.begin_object().member("regime", plan.regime.name).member("reason", plan.regime.reason);
  json.member("boxes", std::uint64_t(plan.boxes.size())).member("left", std::uint64_t(boxes.left()));
  json.member("expected_s", boxes.expected_left() / boxes.at_once()).end_object();
  core::print("{}\n", json.text());
}

/// Runs points between the knots of a table and tells how they compare.
void check_table(const CalibrateOptions& options, const core::Scene& scene, const fs::path& directory, const Plan& plan,
                 const std::shared_ptr<const core::Ranks>& ranks) {
  const fluid::SolidsTable table = fluid::read_solids_table(options.check);
  if (table.regime != plan.regime.name)
    throw core::CaseError(fmt::format("{} is a {} table, the boxes of the case are {}: {}", options.check.string(),
                                      table.regime, plan.regime.name, plan.regime.reason));
  Boxes boxes(options, scene, directory, points_between(table, plan), ranks);
  std::vector<Deviation> deviations;
  for (const BoxResult& box : boxes.run()) deviations.push_back(deviation(table, box));
  const std::string lines = deviation_lines(deviations);
  core::on_first(ranks.get(), [&] {
    core::print(people(options), "{}", lines);
    core::write_atomically(directory / "check.txt", lines);
  });
}

/// Fluidised boxes: p_bed by both measures, and the table of that by slabs.
void finish_bed(const CalibrateOptions& options, const fs::path& directory, const core::Scene& scene, const Plan& plan,
                const std::vector<BoxResult>& boxes) {
  const double density = relevance::fluid_constants(scene.fluid).density, solid = boxes.front().density;
  const double weight = std::abs(1 - density / solid) * scene.column.gravity * boxes.front().diameter;
  const BedTable table = bed_table(plan, boxes, weight);
  const std::string lines = bed_lines(boxes) + "\n" + bed_rows(table);
  core::print(people(options), "{}", lines);
  core::write_atomically(directory / "boxes.txt", lines);
  require_usable(table);
  write_bed_table(directory / "table.h5", table, now(), core::text_hash(core::resolved_case(scene)));
  core::print(people(options), "table: {}\n", (directory / "table.h5").string());
  if (options.json) print_json(directory, plan, {});
}

/// Sheared boxes: the fitted table, told, and written if it may be used.
void finish_sheared(const CalibrateOptions& options, const fs::path& directory, const core::Scene& scene,
                    const Plan& plan, const std::vector<BoxResult>& results) {
  fluid::SolidsTable table = table_of(scene, plan, results);
  if (!options.bed.empty()) take_bed(table, options.bed);
  const std::string lines = box_lines(results);
  std::FILE* out = people(options);
  core::print(out, "{}", lines);
  core::write_atomically(directory / "boxes.txt", lines);
  const Tested by = tested(table, plan);
  const auto percent = [](const std::optional<double>& x) { return x ? fmt::format("{:.2f} %", 100 * *x) : "-"; };
  core::print(out, "standard errors up to {}; with a solids fraction left out {} off, {} beyond two standard errors\n",
              percent(by.error), percent(by.left_out), percent(by.residual));
  if (const double up_to = falls_in_shear_up_to(table); up_to > 0)
    core::print(out,
                "at fixed shear rate without a fluid the pressure falls up to phi = {:.3f}, as a dilute gas does\n",
                up_to);
  require_usable(table);
  fluid::write_solids_table(directory / "table.h5", table);
  core::write_atomically(directory / "table.toml", table_toml(table, plan, results));
  core::print(out, "table: {}\n", (directory / "table.h5").string());
  if (options.json) print_json(directory, plan, by);
}

}  // namespace

void run_calibrate(const CalibrateOptions& options) {
  const core::Scene scene = read_chosen_case(options.case_path, options.overrides);
  const fs::path directory =
      options.output.empty() ? default_run_directory(options.case_path, "calibrate") : options.output;
  if (!options.bed.empty() && fluid::regime_of_table(options.bed) != "bed")
    throw core::CaseError(options.bed.string() + ": no table of fluidised boxes, as --bed takes one");
  if (!options.box.empty()) return run_one(scene, directory, options.box);
  if (options.launched && options.jobs > 1)
    throw core::CaseError("-j starts processes of its own: under mpirun the ranks run the boxes, leave it out");
  const std::shared_ptr<const core::Ranks> ranks = options.launched ? core::Ranks::of_program() : nullptr;
  Plan plan = plan_of(scene);
  std::unique_ptr<const core::OutputDirectory> taken;  // by the first rank
  if (!options.plan_only)
    core::on_first(ranks.get(), [&] { taken = std::make_unique<const core::OutputDirectory>(directory); });
  if (!options.check.empty()) return check_table(options, scene, directory, plan, ranks);
  Boxes boxes(options, scene, directory, plan.boxes, ranks);
  core::on_first(ranks.get(), [&] {
    print_plan(plan, boxes, options);
    if (options.plan_only && options.json) print_plan_json(plan, boxes);
  });
  if (options.plan_only) return;
  std::vector<BoxResult> results = boxes.run();
  if (plan.regime.name != "bed")
    while (add_seeds(plan, fitted(plan, results))) results = Boxes(options, scene, directory, plan.boxes, ranks).run();
  core::on_first(ranks.get(), [&] {
    if (plan.regime.name == "bed")
      finish_bed(options, directory, scene, plan, results);
    else
      finish_sheared(options, directory, scene, plan, results);
  });
}

}  // namespace polybed::multiscale
