#include "app/inversion_beside.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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
  const auto densities = last(inversion_points(bed, law, "bulk_density"));
  const auto balance = last(inversion_points(bed, law, "force_balance"));
  if (densities && balance) {
    beside.mixed = {*densities, *balance};
    if (densities->velocity > balance->velocity) std::swap((*beside.mixed)[0], (*beside.mixed)[1]);
  }
  return beside;
}

core::Json json_of(const InversionBeside& beside) {
  core::Json json;
  json["mixed_interval_m_s"] = nullptr;
  if (beside.mixed) json["mixed_interval_m_s"] = {(*beside.mixed)[0].velocity, (*beside.mixed)[1].velocity};
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
  return text + line_of("measured", beside.measured) + line_of("simulated by others", beside.simulated);
}

}  // namespace polybed::app
