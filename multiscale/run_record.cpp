#include "multiscale/run_record.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/vectors.hpp"
#include "core/version.hpp"

namespace polybed::multiscale {

namespace {

using core::Json;

/// A species with a distribution and its classes.
Json size_classes_of(const core::SizeClasses& record) {
  Json json = {{"species", record.species}, {"distribution", core::name_of(record.given.kind.value())}};
  if (record.given.median) json["median_m"] = *record.given.median;
  if (record.given.mean) json["mean_m"] = *record.given.mean;
  if (record.given.deviation) json["deviation"] = *record.given.deviation;
  for (const auto& [opening, share] : record.given.sieves)
    json["sieves"].push_back({{"opening_m", opening}, {"share", share}});
  for (std::size_t k = 0; k < record.diameter.size(); ++k)
    json["classes"].push_back({{"name", record.species + "." + std::to_string(k + 1)},
                               {"diameter_m", record.diameter[k]},
                               {"share", record.share[k]}});
  return json;
}

}  // namespace

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

void write_size_classes(Json& json, const core::Scene& scene) {
  for (const core::SizeClasses& record : scene.size_classes) json["size_classes"].push_back(size_classes_of(record));
}

void begin_record(Json& json, const core::Scene& scene, const std::string& model, const std::string& state, int ranks) {
  const std::string text = core::resolved_case(scene);
  json = {{"filetype", "polybed run"},        {"version", 1},   {"model", model}, {"program", core::version()},
          {"git_commit", core::git_commit()}, {"state", state}, {"case", text},   {"case_hash", core::case_hash(scene)},
          {"overrides", scene.overrides},     {"ranks", ranks}};
  write_size_classes(json, scene);
  if (!scene.drag_record.empty()) json["drag_law"] = core::parse_json(scene.drag_record);
  json["machine"] = {{"processor", processor()},
                     {"vectors", core::vector_width_name()},
                     {"cores", std::thread::hardware_concurrency()}};
}

void write_invariants(Json& json, std::span<const measures::WorstInvariant> worst) {
  Json& all = json["invariants"] = Json::array();
  for (const measures::WorstInvariant& w : worst)
    all.push_back({{"name", w.name},
                   {"worst", w.value},
                   {"limit", w.limit},
                   {"time_s", w.time},
                   {"held", w.value <= w.limit},
                   {"judged", w.judged}});
}

std::vector<std::string> exceeded_lines(std::span<const measures::WorstInvariant> worst) {
  std::vector<std::string> lines;
  for (const measures::WorstInvariant& w : worst)
    if (!(w.value <= w.limit))
      lines.push_back(fmt::format("{} exceeded its limit{}: off by {:.2g}, the limit is {:g}{}{}", w.name,
                                  w.broken() ? " more than tenfold, and the results do not conserve it" : "", w.value,
                                  w.limit, w.remedy.empty() ? "" : "; ", w.remedy));
  return lines;
}

void write_timers(Json& json, const core::Timers& timers) {
  Json& seconds = json["timers"] = Json::object();
  for (const core::Timers::Term& term : timers.terms()) seconds[term.name] = term.seconds;
}

}  // namespace polybed::multiscale
