// Text of an estimate, for people and for programs.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/print.hpp"
#include "multiscale/card/card.hpp"

namespace polybed::multiscale {

namespace {

std::string bytes_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.3g} MB", 1e-6 * bytes) : fmt::format("{:.3g} GB", 1e-9 * bytes);
}

}  // namespace

core::Json seconds_of(const TimeBand& time) {
  return {{"expected_s", time.expected}, {"least_s", time.least}, {"most_s", time.most}};
}

void write_estimate(core::Json& json, const CostEstimate& e) {
  core::Json ways = core::Json::array();
  for (const Way& way : e.ways)
    ways.push_back({{"change", way.change}, {"time", way.time}, {"loss", way.loss}, {"evidence", way.evidence}});
  json.update({{"model", e.model},
               {"ranks", e.ranks},
               {"cpu_s", {{"least", e.time.least}, {"expected", e.time.expected}, {"most", e.time.most}}},
               {"band", 0.9},
               {"wall_s", e.wall},
               {"basis", e.basis},
               {"steps", e.steps},
               {"step_s", e.step},
               {"limited_by", e.limited_by},
               {"memory_MB", 1e-6 * e.memory},
               {"disk_MB", 1e-6 * e.disk},
               {"ways", ways}});
}

void print_estimate(const core::Scene& scene, const CostEstimate& e) {
  constexpr std::string_view continuum = "tfm";
  core::print("{:.4g} s by the {} on {} rank{}: about {} of computing, with 90 % confidence {} to {}\n",
              scene.run.until, e.model == continuum ? "two-fluid model" : "particle model", e.ranks,
              e.ranks > 1 ? "s" : "", short_time(e.time.expected), short_time(e.time.least), short_time(e.time.most));
  core::print("  based on  {}\n", e.basis);
  if (e.ranks > 1) core::print("  wall time {}\n", short_time(e.wall));
  core::print("  steps     {:.0f} of {:.2g} s, limited by {}\n", e.steps, e.step, e.limited_by);
  core::print("  memory    {}\n  disk      {}\n", bytes_text(e.memory), bytes_text(e.disk));
  core::print("to shorten it, and what each way costs:\n");
  for (const Way& way : e.ways)
    core::print("  {}: {:.0f} % of the time\n      {} ({})\n", way.change, 100 * way.time, way.loss, way.evidence);
}

void write_prediction(core::Json& json, const TimeBand& predicted, bool ended, double actual) {
  core::Json& prediction = json["prediction"] = {{"cpu_s", predicted.expected},
                                                 {"least_s", predicted.least},
                                                 {"most_s", predicted.most},
                                                 {"actual_s", ended ? core::Json(actual) : core::Json()}};
  if (ended) prediction["within"] = actual >= predicted.least && actual <= predicted.most;
}

}  // namespace polybed::multiscale
