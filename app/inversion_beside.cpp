#include "app/inversion_beside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "relevance/advised_drag.hpp"
#include "relevance/drag_file.hpp"
#include "relevance/drag_law.hpp"

namespace polybed::app {

namespace {

using namespace multiscale;

std::optional<InversionPoint> last(const std::vector<InversionPoint>& points) {
  return points.empty() ? std::nullopt : std::optional(points.back());
}

core::Json list_or_null(const std::vector<double>& values) {
  return values.empty() ? core::Json() : core::Json(values);
}

std::string line_of(const char* what, const std::vector<double>& values) {
  if (values.empty()) return "";
  std::string text = fmt::format("  {}: {:.2f}", what, 1e3 * values.front());
  if (values.size() > 1) text += fmt::format(" to {:.2f}", 1e3 * values.back());
  return text + " mm/s\n";
}

/// Why two species never change places, for the message; empty if sizes and densities do not decide.
std::string reason_of(const core::Scene& scene) {
  const bool first = scene.species[0].diameter > scene.species[1].diameter;
  const core::Species &larger = scene.species[first ? 0 : 1], &smaller = scene.species[first ? 1 : 0];
  if (larger.density < smaller.density || larger.diameter == smaller.diameter) return "";
  return fmt::format(
      "layers change places only if the larger particles are the lighter ones; {} is larger and {}, so {} is on top "
      "at every velocity\n",
      larger.name, larger.density > smaller.density ? "denser" : "as dense", smaller.name);
}

}  // namespace

InversionBeside inversion_beside(const core::Scene& scene, const closures::DragLaw& law) {
  const BinaryBed bed = binary_bed(scene);
  InversionBeside beside;
  beside.measured = scene.inversion.measured;
  beside.simulated = scene.inversion.simulated;
  beside.densities = last(inversion_points(bed, law, "bulk_density"));
  beside.balance = last(inversion_points(bed, law, "force_balance"));
  if (beside.densities && beside.balance && beside.densities->velocity <= beside.balance->velocity)
    beside.mixed = {*beside.densities, *beside.balance};
  for (const std::string& shape : relevance::other_shapes(scene)) {
    core::Scene other = scene;
    other.effects["shape"] = shape;
    beside.shapes[shape] = last(inversion_points(bed, relevance::drag_law_of(other), "force_balance"));
  }
  return beside;
}

core::Json json_of(const InversionBeside& beside) {
  core::Json json;
  json["mixed_interval_m_s"] = nullptr;
  if (beside.mixed) json["mixed_interval_m_s"] = {(*beside.mixed)[0].velocity, (*beside.mixed)[1].velocity};
  json["equal_bulk_density_m_s"] = beside.densities ? core::Json(beside.densities->velocity) : core::Json();
  json["by_shapes"] = core::Json::object();
  for (const auto& [shape, point] : beside.shapes)
    json["by_shapes"][shape] = point ? core::Json(point->velocity) : core::Json();
  json["measured_m_s"] = list_or_null(beside.measured);
  json["simulated_m_s"] = list_or_null(beside.simulated);
  return json;
}

std::string lines_of(const InversionBeside& beside) {
  std::string text;
  if (beside.mixed)
    text += fmt::format(
        "  mixed between equal bulk densities of the pure beds and the force balance: {:.2f} to {:.2f} "
        "mm/s\n",
        1e3 * (*beside.mixed)[0].velocity, 1e3 * (*beside.mixed)[1].velocity);
  else if (beside.densities && beside.balance)
    text += fmt::format(
        "  no mixed interval: the pure beds have equal bulk densities at {:.2f} mm/s, above the force balance, "
        "{:.2f}\n",
        1e3 * beside.densities->velocity, 1e3 * beside.balance->velocity);
  for (const auto& [shape, point] : beside.shapes)
    text += fmt::format("  by shape = \"{}\": {}\n", shape,
                        point ? fmt::format("{:.2f} mm/s", 1e3 * point->velocity) : "no inversion point");
  return text + line_of("measured", beside.measured) + line_of("simulated by others", beside.simulated);
}

bool suits_point(const std::string& name, const closures::DragLaw& law, const BinaryBed& bed,
                 const InversionPoint& point) {
  using relevance::DragScene;
  const bool gas = bed.fluid.density < relevance::lightest_liquid;
  const DragScene kind = gas ? DragScene::gas_bed : DragScene::liquid_bed;
  const std::vector<std::string> of_beds = relevance::laws_of_beds(kind);
  if (std::find(of_beds.begin(), of_beds.end(), name) != of_beds.end()) return true;
  const bool crowded = relevance::unsuited(name, kind).empty() || relevance::unsuited(name, DragScene::fixed).empty();
  if (relevance::serves_comparison(name) || !crowded) return false;
  return range_at(law, bed, point).within;
}

RangeAt range_at(const closures::DragLaw& law, const BinaryBed& bed, const InversionPoint& point) {
  closures::GuardCount count;
  double f = 0, slope = 0;
  const double diameter = closures::sauter_diameter(bed.share, bed.diameter),
               reynolds = bed.fluid.density * point.velocity * diameter / bed.fluid.viscosity;
  closures::drag_of_points(law, {&point.voidage, 1}, {&reynolds, 1}, {&f, 1}, {&slope, 1}, count);
  return {count.guarded == 0, reynolds};
}

std::string range_warning(const closures::DragLaw& law, const BinaryBed& bed, const InversionPoint& point) {
  const std::string fitted = relevance::fitted_range(law);
  const RangeAt at = range_at(law, bed, point);
  if (!fitted.empty() && !law.fitted_to)
    return "  range unknown: the law file does not contain the range of its rows\n";
  if (at.within) return "";
  return fmt::format("  outside the range of the law{}: voidage {:.3g}, Re {:.3g} of the Sauter diameter\n",
                     fitted.empty() ? "" : ", " + fitted, point.voidage, at.reynolds);
}

std::string line_without_point(const core::Scene& scene, const closures::DragLaw& law) {
  if (std::string reason = reason_of(scene); !reason.empty()) return reason;
  const BinaryBed bed = binary_bed(scene);
  std::optional<std::size_t> upper;
  for (const double voidage : {0.45, 0.6, 0.75, 0.9}) {
    const double solids = bed.share[0] * bed.density[0] + bed.share[1] * bed.density[1],
                 bulk = voidage * bed.fluid.density + (1 - voidage) * solids;
    const bool first = bed.density[0] < bulk, second = bed.density[1] < bulk;  // float in it
    const auto here = first != second ? std::optional<std::size_t>(first ? 0 : 1)
                                      : on_top_below(bed, law, {HUGE_VAL, voidage});  // rests at the lower velocity
    if (!here || (upper && *upper != *here)) return "";
    upper = here;
  }
  return fmt::format("by {}: {} is below at all velocities, {} on top\n", relevance::drag_name_of(scene),
                     scene.species[1 - *upper].name, scene.species[*upper].name);
}

}  // namespace polybed::app
