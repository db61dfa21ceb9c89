// polybed inversion --scan: the inversion velocity from runs of one model or both, a study in the Python package.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/inversion_beside.hpp"
#include "app/run_directory.hpp"
#include "app/study_request.hpp"
#include "core/case/units.hpp"
#include "core/error.hpp"
#include "multiscale/inversion/models.hpp"
#include "multiscale/python_module.hpp"
#include "relevance/drag_law.hpp"

namespace polybed::app {

namespace {

struct ScanRange {
  double low = 0, high = 0;  ///< m/s
};

/// From the force balance with the case's law; empty without a law or a root.
std::optional<InversionPoint> force_balance(const core::Scene& scene) {
  const BinaryBed bed = binary_bed(scene);  // rejects other numbers of species
  if (!scene.drag().given) return std::nullopt;
  const auto points = inversion_points(bed, relevance::drag_law_of(scene), "force_balance");
  return points.empty() ? std::nullopt : std::optional(points.back());
}

/// --from and --to, by default a quarter below and above the force balance.
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

void refuse_what_a_model_cannot_run(const InversionOptions& options, const core::Scene& scene) {
  if (options.scan != "dem") refuse(scene, {&rules_of_tfm()});
  if (options.scan != "tfm") refuse(scene, {&rules_of_dem()});
  if (!options.stress_uncertainty) return;
  if (options.scan == "dem") throw core::CaseError("--stress-uncertainty is of the two-fluid model: --scan tfm");
  require_table(scene);
}

/// The request to the study, as JSON.
std::string request_of(const InversionOptions& options, const ScanRange& range,
                       const std::optional<InversionPoint>& balance, const core::Json& beside) {
  core::Json json = common_request(options, "inversion");
  json["scan"] = options.scan;
  json["from_m_s"] = range.low;
  json["to_m_s"] = range.high;
  json["force_balance"] = nullptr;
  if (balance) json["force_balance"] = {{"velocity_m_s", balance->velocity}, {"voidage", balance->voidage}};
  json["beside"] = beside;
  return core::json_text(json);
}

}  // namespace

void run_inversion_scan(const InversionOptions& options) {
  const core::Scene scene = read_scene(options, {});
  const std::optional<InversionPoint> balance = force_balance(scene);
  refuse_what_a_model_cannot_run(options, scene);
  core::Json beside;
  if (balance) beside = json_of(inversion_beside(scene, relevance::drag_law_of(scene)));
  become_python("polybed.study.inversion", {request_of(options, range_of(options, balance), balance, beside)});
}

}  // namespace polybed::app
