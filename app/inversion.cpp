// polybed inversion: the inversion point of a binary case, with bands from the uncertainty of its inputs.
#include <fmt/format.h>

#include "core/print.hpp"
#include "multiscale/inversion/models.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/inversion_beside.hpp"
#include "app/study_request.hpp"
#include "core/case/file.hpp"
#include "core/output/json.hpp"
#include "multiscale/card/velocity_text.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"
#include "relevance/drag_file.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/effects/drag.hpp"

namespace polybed::app {

namespace {

/// Effect of one uncertain input on the answer.
struct Band {
  std::string input;
  double low, high;  ///< m/s
};

/// The least and greatest velocity over two variations; empty if a variation has no root.
std::vector<Band> bands(const core::Scene& scene, const closures::DragLaw& law, const std::string& method,
                        double voidage) {
  std::vector<Band> result;
  const auto vary = [&](const std::string& input, auto&& change) {
    double low = 1e300, high = -1e300;
    for (const int sign : {-1, 1}) {
      core::Scene varied = scene;
      try {
        change(varied, sign);
        const auto points = inversion_points(binary_bed(varied), law, method);
        if (points.empty()) return;
        const auto near = *std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
          return std::abs(a.voidage - voidage) < std::abs(b.voidage - voidage);
        });
        low = std::min(low, near.velocity);
        high = std::max(high, near.velocity);
      } catch (const core::CaseError&) {
        return;  // the fluid is unknown at that temperature
      }
    }
    result.push_back({input, low, high});
  };
  if (scene.fluid.temperature && !(scene.fluid.density && scene.fluid.viscosity))
    vary("temperature +-1 K", [](core::Scene& s, int sign) { *s.fluid.temperature += sign; });
  for (std::size_t j = 0; j < 2; ++j)
    vary("density of " + scene.species[j].name + " +-1 %",
         [&](core::Scene& s, int sign) { s.species[j].density *= 1 + 0.01 * sign; });
  return result;
}

core::Json json_of(const std::vector<InversionPoint>& points) {
  core::Json json = core::Json::array();
  for (const InversionPoint& p : points) json.push_back({{"velocity_m_s", p.velocity}, {"voidage", p.voidage}});
  return json;
}

void print_json(const core::Scene& scene, const std::string& method, const std::vector<InversionPoint>& points,
                const std::vector<Band>& band, const InversionBeside& beside, std::optional<std::size_t> on_top,
                std::optional<bool> outside) {
  core::Json json = {{"law", scene.drag().name},
                     {"partition", core::text_or_null(scene.partition().given ? scene.partition().name : "")},
                     {"velocity_m_s", nullptr},
                     {"voidage", nullptr}};
  if (!points.empty()) json.update(json_of(points).back());
  json["on_top"] = nullptr;
  if (on_top) json["on_top"] = {{"below", scene.species[*on_top].name}, {"above", scene.species[1 - *on_top].name}};
  json["roots"] = json_of(points);
  json["outside_range"] = outside ? core::Json(*outside) : core::Json();
  json["method"] = method;
  core::Json& bands = json["bands"] = core::Json::array();
  for (const Band& b : band) bands.push_back({{"input", b.input}, {"low_m_s", b.low}, {"high_m_s", b.high}});
  json.update(json_of(beside));
  core::print("{}\n", core::json_text(json));
}

/// A row of the table of all methods.
struct MethodRow {
  std::string method, law, partition;
  std::vector<InversionPoint> points;
  bool suits = true;  ///< the law, at its last point
};

MethodRow row_of(const BinaryBed& bed, const std::string& method, const closures::DragLaw& law, const std::string& name,
                 const std::string& partition) {
  const auto points = inversion_points(bed, law, method);
  return {method, name, partition, points, points.empty() || suits_point(name, law, bed, points.back())};
}

/// Every law of one size with every partition, but for the pairs that a law of mixtures is made of.
void add_pairs(const core::Scene& scene, const BinaryBed& bed, const std::string& method,
               std::vector<MethodRow>& rows) {
  for (const closures::DragLawInfo& mean : closures::drag_laws()) {
    if (!mean.is_mean) continue;
    for (const closures::DragLawInfo& partition : closures::partitions()) {
      const closures::DragLaw pair =
          relevance::with_shape(closures::drag_law(mean.name, partition.name, closures::Guard::on), scene);
      if (pair.partition) rows.push_back(row_of(bed, method, pair, mean.name, partition.name));
    }
  }
}

/// Every method, with every drag law where it takes one; the force balance also with every mean law and partition.
std::vector<MethodRow> all_methods(const core::Scene& scene) {
  const BinaryBed bed = binary_bed(scene);
  const auto by_law = [&](const std::string& law, const std::string& method) {
    return row_of(bed, method, relevance::with_shape(closures::drag_law(law, closures::Guard::on), scene), law, "");
  };
  std::vector<MethodRow> rows;
  for (const InversionMethod& method : inversion_methods()) {
    if (!method.takes_law) {
      rows.push_back({method.name, "", "", by_law("cello", method.name).points});
      continue;
    }
    for (const closures::DragLawInfo& law : closures::drag_laws()) rows.push_back(by_law(law.name, method.name));
    if (method.takes_partition) add_pairs(scene, bed, method.name, rows);
  }
  return rows;
}

void print_methods_json(const std::vector<MethodRow>& rows) {
  core::Json methods = core::Json::array();
  for (const MethodRow& row : rows)
    methods.push_back({{"method", row.method},
                       {"law", core::text_or_null(row.law)},
                       {"partition", core::text_or_null(row.partition)},
                       {"roots", json_of(row.points)}});
  core::print("{}\n", core::json_text({{"methods", methods}}));
}

/// Distribution of a law's drag among the species, for people.
std::string sharing_of(const MethodRow& row) {
  if (!row.partition.empty()) return row.partition;
  for (const closures::DragLawInfo& law : closures::drag_laws())
    if (law.name == row.law) return law.is_mean && !law.obeys_sum_rule ? "(one size)" : "(mixtures)";
  return "";
}

/// Sorted within each method by the last point's velocity; rows without a point come last. A star marks the case's law.
void print_methods(std::vector<MethodRow> rows, const core::Scene& scene) {
  const auto velocity = [](const MethodRow& row) { return row.points.empty() ? 1e300 : row.points.back().velocity; };
  for (auto first = rows.begin(); first != rows.end();) {
    const auto last =
        std::find_if(first, rows.end(), [&](const MethodRow& row) { return row.method != first->method; });
    std::stable_sort(first, last, [&](const auto& a, const auto& b) { return velocity(a) < velocity(b); });
    first = last;
  }
  const std::string drag = scene.drag().name;
  const std::string partition = scene.partition().given ? scene.partition().name : "";
  core::print("  {:16} {:20} {:16} {:>8} {:>8}\n", "method", "law", "partition", "mm/s", "voidage");
  for (const MethodRow& row : rows) {
    const char* mark = row.law == drag && row.partition == partition ? "*" : " ";
    const std::string front = fmt::format("{} {:16} {:20} {:16}", mark, row.method, row.law, sharing_of(row));
    if (row.points.empty()) core::print("{} {:>8} {:>8}\n", front, "-", "-");
    for (const InversionPoint& p : row.points) core::print("{} {:8.2f} {:8.4f}\n", front, 1e3 * p.velocity, p.voidage);
  }
  core::print(
      "by method, then by velocity; -: no inversion point; *: the law of the case\n"
      "(mixtures): a law made for several sizes; (one size): applied to each species as if it were alone\n");
}

/// One line per point of a row, or a line that reports no point.
void print_row(const MethodRow& row, const std::string& name, bool of_case) {
  const std::string front = fmt::format("{} {:34}", of_case ? "*" : " ", name);
  if (row.points.empty()) core::print("{} {:>8} {:>8}\n", front, "-", "-");
  for (const InversionPoint& p : row.points) core::print("{} {:8.2f} {:8.4f}\n", front, 1e3 * p.velocity, p.voidage);
}

std::string name_of(const MethodRow& row) { return row.partition.empty() ? row.law : row.law + " x " + row.partition; }

/// Recommended drag laws, with partition and reason: docs/guide/choose-a-drag-law.md.
struct Recommended {
  const char* why;
  std::vector<std::pair<std::string, std::string>> pairs;
};

const std::vector<Recommended>& recommended() {
  static const std::vector<Recommended> all{
      {"laws of expanded beds, shared between the sizes",
       {{"wen_yu", "brinkman_oseen"}, {"richardson_zaki", "brinkman_oseen"}, {"di_felice", "brinkman_oseen"}}},
      {"laws of mixtures, fitted to spheres that are fixed",
       {{"cello", ""}, {"vbk_theory", ""}, {"brinkman_oseen", ""}}}};
  return all;
}

/// The most relevant rows, on one screen.
void print_best_methods(const std::vector<MethodRow>& rows, const core::Scene& scene) {
  const std::string drag = scene.drag().name;
  const std::string partition = scene.partition().given ? scene.partition().name : "";
  const std::string balance = inversion_methods().front().name;
  const auto is_pair = [](const MethodRow& row, const std::string& law, const std::string& shared_by) {
    return row.law == law && row.partition == shared_by;
  };
  bool shown = false;
  core::print("{:36} {:>8} {:>8}\n", "force balance, with", "mm/s", "voidage");
  for (const Recommended& group : recommended()) {
    core::print("{}:\n", group.why);
    for (const auto& [law, shared_by] : group.pairs)
      for (const MethodRow& row : rows)
        if (row.method == balance && is_pair(row, law, shared_by)) {
          print_row(row, name_of(row), is_pair(row, drag, partition));
          shown = shown || is_pair(row, drag, partition);
        }
  }
  std::vector<double> velocities;
  std::size_t unsuited = 0;
  for (const MethodRow& row : rows) {
    if (row.method != balance) continue;
    unsuited += row.suits ? 0 : 1;
    if (!row.points.empty() && row.suits) velocities.push_back(1e3 * row.points.back().velocity);
    if (!shown && is_pair(row, drag, partition)) {
      core::print("the law of the case:\n");
      print_row(row, name_of(row), true);
    }
  }
  std::sort(velocities.begin(), velocities.end());
  const std::size_t n = velocities.size();
  if (n > 0)
    core::print("all {} laws and pairs: {:.4g} to {:.4g} mm/s, half of them {:.3g} to {:.3g}\n", n, velocities.front(),
                velocities.back(), velocities[n / 4], velocities[(3 * n) / 4]);
  else
    core::print("no law or pair within its range finds a point\n{}",
                !scene.drag().acts() ? "" : line_without_point(scene, relevance::drag_law_of(scene)));
  if (unsuited > 0) core::print("outside their range at their point, not counted: {} laws and pairs\n", unsuited);
  core::print("other methods:\n");
  for (const MethodRow& row : rows)
    if (row.method != balance && (row.law.empty() || row.law == drag))
      print_row(row, row.method + (row.law.empty() ? "" : " with " + row.law), false);
  core::print("*: the law of the case; -: no inversion point; every method, law and pair: --details\n");
}

/// Relative difference of the total drag from the mean law at a root.
void print_deviation(const BinaryBed& bed, const closures::DragLaw& law, const InversionPoint& at) {
  std::array<double, 2> f{}, slope{};
  closures::drag_of_mixture(law, at.voidage, bed.share, bed.diameter, std::array{at.velocity, at.velocity},
                            bed.fluid.density, bed.fluid.viscosity, f, slope);
  const double reynolds =
      bed.fluid.density * at.velocity * closures::sauter_diameter(bed.share, bed.diameter) / bed.fluid.viscosity;
  const double deviation = closures::deviation_from_base(law, at.voidage, reynolds, bed.share, bed.diameter, f);
  if (std::abs(deviation) > 1e-9)
    core::print("  drag of all species together: {:+.2f} % of the mean law\n", 100 * deviation);
}

/// Table over the share of the second species, T fig. 5-VIII: the point from a method, and the mixed interval.
void print_composition(const core::Scene& scene, const closures::DragLaw& law, const InversionOptions& options) {
  constexpr int parts = 20;  // between the pure species, neither of which has a point
  core::Json rows = core::Json::array();
  core::Scene varied = scene;
  varied.bed.particles.clear();
  if (!options.json) core::print("{:>6} {:>8} {:>8} {:>17}\n", "share", "mm/s", "voidage", "mixed, mm/s");
  for (int n = 1; n < parts; ++n) {
    const double share = double(n) / parts;
    varied.bed.volume_share = {1 - share, share};
    const auto points = inversion_points(binary_bed(varied), law, options.method);
    const auto mixed = inversion_beside(varied, law).mixed;
    if (options.json) {
      core::Json row = {
          {"share", share}, {"velocity_m_s", nullptr}, {"voidage", nullptr}, {"mixed_interval_m_s", nullptr}};
      if (!points.empty()) row.update(json_of(points).back());
      if (mixed) row["mixed_interval_m_s"] = {(*mixed)[0].velocity, (*mixed)[1].velocity};
      rows.push_back(row);
      continue;
    }
    const std::string point = points.empty()
                                  ? fmt::format("{:>8} {:>8}", "-", "-")
                                  : fmt::format("{:8.2f} {:8.4f}", 1e3 * points.back().velocity, points.back().voidage);
    const std::string interval =
        mixed ? fmt::format("{:.2f} to {:.2f}", 1e3 * (*mixed)[0].velocity, 1e3 * (*mixed)[1].velocity) : "-";
    core::print("{:6.2f} {} {:>17}\n", share, point, interval);
  }
  if (options.json)
    core::print("{}\n", core::json_text({{"law", scene.drag().name},
                                         {"method", options.method},
                                         {"species", scene.species[1].name},
                                         {"composition", rows}}));
}

/// --law replaces the mean law alone.
void tell_of_the_partition(const InversionOptions& options, const core::Scene& scene) {
  if (options.law.empty() || !options.partition.empty() || !scene.partition().given) return;
  core::print(stderr,
              "--law {} is shared among the species by partition = \"{}\" of the case; --partition none: by itself\n",
              options.law, scene.partition().name);
}

void run_without_a_run(const InversionOptions& options) {
  const core::Scene scene = read_chosen_case(options.case_path, options.overrides, {});
  if (options.method == "all") {
    const std::vector<MethodRow> rows = all_methods(scene);
    if (options.json) return print_methods_json(rows);
    return options.details ? print_methods(rows, scene) : print_best_methods(rows, scene);
  }
  if (!scene.drag().given) throw core::CaseError("inversion needs a drag law: [effects] drag = ..., or --law");
  const closures::DragLaw law = relevance::drag_law_of(scene);
  const std::string name = relevance::drag_name_of(scene);
  tell_of_the_partition(options, scene);
  if (options.composition) return print_composition(scene, law, options);
  const auto points = inversion_points(binary_bed(scene), law, options.method);
  const std::vector<Band> band =
      points.empty() ? std::vector<Band>{} : bands(scene, law, options.method, points.back().voidage);
  const InversionBeside beside = inversion_beside(scene, law);
  const auto top_below = [&](const InversionPoint& point) {
    return options.method == "force_balance" ? on_top_below(binary_bed(scene), law, point) : std::nullopt;
  };
  if (options.json)
    return print_json(scene, options.method, points, band, beside,
                      points.empty() ? std::nullopt : top_below(points.back()),
                      points.empty() || relevance::fitted_range(law) == "unknown"
                          ? std::nullopt
                          : std::optional(!range_at(law, binary_bed(scene), points.back()).within));
  if (points.empty())
    core::print("no inversion point between voidage 0.2 and 1 by {} with {}\n{}", options.method, name,
                line_without_point(scene, law));
  for (const InversionPoint& p : points) {
    const double area = scene.places.has("inlet.flow_rate") ? scene.column.cross_section() : 0;
    core::print("inversion at {:.2f} mm/s{}, voidage {:.4f} ({}, {})\n", 1e3 * p.velocity,
                multiscale::flow_text(p.velocity, area), p.voidage, options.method, name);
    if (const auto top = top_below(p))
      core::print("  at lower velocities {} is on top, at higher ones {}\n", scene.species[*top].name,
                  scene.species[1 - *top].name);
    core::print("{}", range_warning(law, binary_bed(scene), p));
  }
  if (law.partition && !points.empty()) print_deviation(binary_bed(scene), law, points.back());
  for (const Band& b : band) core::print("  {}: {:.2f} to {:.2f} mm/s\n", b.input, 1e3 * b.low, 1e3 * b.high);
  core::print("{}", lines_of(beside));
}

/// Rejects --temperature for a fluid whose density and viscosity do not depend on it.
void refuse_idle_temperature(const core::Scene& scene) {
  if (!scene.fluid.density || !scene.fluid.viscosity) return;
  throw core::CaseError(std::vector{scene.places.problem(
      {"fluid.density", "fluid.viscosity"},
      "--temperature cannot act: fluid.density and fluid.viscosity are given as numbers; leave them out of a case of "
      "fluid.name = \"water\" or \"air\", or give those at the other temperature by --set")});
}

void run_inversion(const InversionOptions& options) {
  InversionOptions chosen = options;
  if (!options.temperature.empty()) refuse_idle_temperature(read_case(options.case_path, options.overrides, {}));
  if (!options.temperature.empty()) chosen.overrides.push_back("fluid.temperature=\"" + options.temperature + "\"");
  if (!options.law.empty()) chosen.overrides.push_back("effects.drag=\"" + options.law + "\"");
  if (!options.partition.empty()) chosen.overrides.push_back("effects.partition=\"" + options.partition + "\"");
  if (options.composition && (options.method == "all" || options.closure_uncertainty || !options.scan.empty()))
    throw core::CaseError("--composition is of one method: leave out --method all, --scan and --closure-uncertainty");
  if (options.closure_uncertainty) {
    if (!options.scan.empty()) throw core::CaseError("--closure-uncertainty is of the force balance: leave out --scan");
    if (options.stress_uncertainty)
      throw core::CaseError(
          "--closure-uncertainty and --stress-uncertainty are two studies: give one of them at a time");
    if (options.method == "all") throw core::CaseError("--closure-uncertainty is of one method, not of all");
    run_closure_uncertainty(chosen, "inversion", {}, options.method);
  }
  options.scan.empty() ? run_without_a_run(chosen) : run_inversion_scan(chosen);
}

}  // namespace

void add_inversion(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<InversionOptions>();
  CLI::App& command =
      *app.add_subcommand("inversion", "the inversion point of two species: by force balance, or by a scan of runs");
  take_case(command, *options);
  command.add_option("--law", options->law, "drag law in place of the case's");
  command.add_option("--partition", options->partition,
                     "what shares it among the species in place of the case's; none");
  command.add_option("--temperature", options->temperature, "in place of the case's, e.g. \"20 degC\"");
  command.add_option("--method", options->method, "force_balance | bulk_density | expansion | density_maximum | all");
  command.add_flag("--details", options->details, "of --method all: every row, not the ones to look at first");
  command.add_flag("--composition", options->composition, "a table over the share of the second species");
  command.add_option("--scan", options->scan, "by runs instead: tfm | dem | both")
      ->check(CLI::IsMember({"tfm", "dem", "both"}));
  command.add_option("--from", options->from, "lowest velocity of the first bracket, e.g. \"30 mm/s\"");
  command.add_option("--to", options->to, "highest; default a quarter about the force balance");
  command.add_option("-o,--output", options->output, "folder of a scan; default runs/<case name>-inversion");
  command.add_option("--until", options->until, "simulated time of each run, e.g. \"20 s\"");
  command.add_flag("--stress-uncertainty", options->stress_uncertainty,
                   "of a scan by the TFM: again with its stress table at plus and minus one standard error");
  command.add_flag("--closure-uncertainty", options->closure_uncertainty,
                   "of the force balance: with the band of its drag law; -o DIR keeps record and picture");
  command.add_flag("--permissive", options->permissive, "runs of a scan go on where a conservation law is broken");
  command.add_flag("--quiet", options->quiet, "no line for each run");
  command.add_flag("!--no-picture", options->picture, "no inversion.png and inversion.html at the end");
  commands.push_back({&command, doing([options] { run_inversion(*options); }), [options] {
                        return options->scan.empty() && !options->closure_uncertainty ? On::one_process : On::study;
                      }});
}

}  // namespace polybed::app
