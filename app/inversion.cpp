// polybed inversion: the inversion point of a binary case, with the bands of its inputs.
#include "core/print.hpp"
#include "multiscale/inversion/models.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/options.hpp"
#include "core/case/file.hpp"
#include "core/output/json.hpp"
#include "multiscale/effects/choice.hpp"
#include "multiscale/roles.hpp"

namespace polybed::multiscale {

namespace {

/// How far one uncertain input moves the answer.
struct Band {
  std::string input;
  double low, high;  ///< m/s
};

/// The least and greatest velocity over two variations; empty where a variation has no root.
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
        return;  // the fluid is not known at that temperature
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

void print_json(const std::string& law, const std::string& method, const std::vector<InversionPoint>& points,
                const std::vector<Band>& band) {
  core::Json json = {{"law", law}, {"velocity_m_s", nullptr}, {"voidage", nullptr}};
  if (!points.empty()) json.update(json_of(points).back());
  json["roots"] = json_of(points);
  json["method"] = method;
  core::Json& bands = json["bands"] = core::Json::array();
  for (const Band& b : band) bands.push_back({{"input", b.input}, {"low_m_s", b.low}, {"high_m_s", b.high}});
  core::print("{}\n", core::json_text(json));
}

/// A row of the table of all methods.
struct MethodRow {
  std::string method, law;
  std::vector<InversionPoint> points;
};

/// Every method, with every drag law where it takes one.
std::vector<MethodRow> all_methods(const BinaryBed& bed) {
  const std::vector<core::Role> roles = all_roles();
  const auto drag = std::find_if(roles.begin(), roles.end(), [](const core::Role& r) { return r.name == "drag"; });
  std::vector<MethodRow> rows;
  for (const InversionMethod& method : inversion_methods()) {
    if (!method.takes_law) {
      rows.push_back(
          {method.name, "", inversion_points(bed, closures::drag_law("cello", closures::Guard::on), method.name)});
      continue;
    }
    for (const core::Law& law : drag->laws)
      rows.push_back({method.name, law.name,
                      inversion_points(bed, closures::drag_law(law.name, closures::Guard::on), method.name)});
  }
  return rows;
}

void print_methods_json(const std::vector<MethodRow>& rows) {
  core::Json methods = core::Json::array();
  for (const MethodRow& row : rows)
    methods.push_back({{"method", row.method},
                       {"law", row.law.empty() ? core::Json() : core::Json(row.law)},
                       {"roots", json_of(row.points)}});
  core::print("{}\n", core::json_text({{"methods", methods}}));
}

void print_methods(const std::vector<MethodRow>& rows) {
  core::print("{:16} {:20} {:>8} {:>8}\n", "method", "law", "mm/s", "voidage");
  for (const MethodRow& row : rows) {
    if (row.points.empty()) core::print("{:16} {:20} {:>8} {:>8}\n", row.method, row.law, "-", "-");
    for (const InversionPoint& p : row.points)
      core::print("{:16} {:20} {:8.2f} {:8.4f}\n", row.method, row.law, 1e3 * p.velocity, p.voidage);
  }
}

void run_without_a_run(const InversionOptions& options) {
  const core::Scene scene = read_chosen_case(options.case_path, options.overrides);
  if (options.method == "all") {
    const std::vector<MethodRow> rows = all_methods(binary_bed(scene));
    return options.json ? print_methods_json(rows) : print_methods(rows);
  }
  const auto named = scene.effects.find("drag");
  if (named == scene.effects.end()) throw core::CaseError("inversion needs a drag law: [effects] drag = ..., or --law");
  const closures::DragLaw law = closures::drag_law(named->second, closures::Guard::on);
  const auto points = inversion_points(binary_bed(scene), law, options.method);
  const std::vector<Band> band =
      points.empty() ? std::vector<Band>{} : bands(scene, law, options.method, points.back().voidage);
  if (options.json) return print_json(named->second, options.method, points, band);
  if (points.empty())
    core::print("no inversion point between voidage 0.2 and 1 by {} with {}\n", options.method, named->second);
  for (const InversionPoint& p : points)
    core::print("inversion at {:.2f} mm/s, voidage {:.4f} ({}, {})\n", 1e3 * p.velocity, p.voidage, options.method,
                named->second);
  for (const Band& b : band) core::print("  {}: {:.2f} to {:.2f} mm/s\n", b.input, 1e3 * b.low, 1e3 * b.high);
}

}  // namespace

void run_inversion(const InversionOptions& options) {
  InversionOptions chosen = options;
  if (!options.temperature.empty()) chosen.overrides.push_back("fluid.temperature=\"" + options.temperature + "\"");
  if (!options.law.empty()) chosen.overrides.push_back("effects.drag=\"" + options.law + "\"");
  options.scan.empty() ? run_without_a_run(chosen) : run_inversion_scan(chosen);
}

}  // namespace polybed::multiscale
