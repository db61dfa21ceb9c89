#include "app/inversion_beside.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

}  // namespace polybed::app
