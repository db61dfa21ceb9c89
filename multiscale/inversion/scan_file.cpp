#include "multiscale/inversion/scan_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/json_value.hpp"

namespace polybed::multiscale {

namespace {

std::optional<double> velocity_of(const core::JsonValue& found, const std::string& model) {
  const auto& models = found.of("models").object();
  const auto scan = models.find(model);
  if (scan == models.end() || scan->second.of("velocity_m_s").is_null()) return std::nullopt;
  return scan->second.of("velocity_m_s").number();
}

}  // namespace

std::string hash_of_scanned(core::Scene scene) {
  scene.inlet.superficial_velocity = {};
  scene.bed.start = {};
  scene.run.until = 1;
  scene.output = {};
  return core::text_hash(core::resolved_case(scene));
}

bool FoundInversion::near(double velocity) const {
  return std::abs(velocity / tfm - 1) <= 0.05 || std::abs(velocity / dem - 1) <= 0.05;
}

std::optional<FoundInversion> read_inversion(const std::filesystem::path& directory, const core::Scene& scene) {
  const std::filesystem::path path = directory / "inversion.json";
  if (!std::filesystem::exists(path)) return std::nullopt;
  const core::JsonValue found = core::read_json(path, "polybed inversion");
  try {
    if (found.of("case_hash").text() != hash_of_scanned(scene))
      throw core::CaseError(path.string() + ": the scan is of another case");
    const auto tfm = velocity_of(found, "tfm"), dem = velocity_of(found, "dem");
    if (!tfm || !dem) return std::nullopt;
    const core::JsonValue& agreement = found.of("agreement");
    return FoundInversion{
        path,
        {agreement.of("value").number(), agreement.of("error").number(), agreement.of("goal").number()},
        *tfm,
        *dem};
  } catch (const core::FileError& error) {
    throw core::FileError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace polybed::multiscale
