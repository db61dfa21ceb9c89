// What an estimate says, to people and to programs.
#include <fmt/format.h>

#include "core/print.hpp"
#include "core/progress.hpp"
#include "multiscale/estimate/estimate.hpp"

namespace polybed::multiscale {

namespace {

std::string time_text(double seconds) {
  constexpr double short_time = 9.5;  // what rounds to one digit
  return seconds < short_time ? fmt::format("{:.2g} s", seconds) : core::duration_text(seconds);
}

std::string bytes_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.3g} MB", 1e-6 * bytes) : fmt::format("{:.3g} GB", 1e-9 * bytes);
}

}  // namespace

void write_estimate(core::Json& json, const CostEstimate& e) {
  json.member("model", e.model).member("ranks", e.ranks).key("cpu_s").begin_object();
  json.member("least", e.time.least).member("expected", e.time.expected).member("most", e.time.most).end_object();
  json.member("band", 0.8).member("wall_s", e.wall).member("basis", e.basis).member("steps", e.steps);
  json.member("step_s", e.step).member("limited_by", e.limited_by).member("memory_MB", 1e-6 * e.memory);
  json.member("disk_MB", 1e-6 * e.disk).key("ways").begin_array();
  for (const Way& way : e.ways)
    json.begin_object()
        .member("change", way.change)
        .member("time", way.time)
        .member("loss", way.loss)
        .member("evidence", way.evidence)
        .end_object();
  json.end_array();
}

void print_estimate(const core::Scene& scene, const CostEstimate& e) {
  core::print("{:.4g} s by {} on {} rank{}: about {} of computing, in 80 % of runs between {} and {}\n",
              scene.run.until, e.model, e.ranks, e.ranks > 1 ? "s" : "", time_text(e.time.expected),
              time_text(e.time.least), time_text(e.time.most));
  core::print("  rests on  {}\n", e.basis);
  if (e.ranks > 1) core::print("  wall time {}\n", time_text(e.wall));
  core::print("  steps     {:.3g} of {:.2g} s, limited by {}\n", e.steps, e.step, e.limited_by);
  core::print("  memory    {}\n  disk      {}\n", bytes_text(e.memory), bytes_text(e.disk));
  core::print("to halve the time:\n");
  for (const Way& way : e.ways)
    core::print("  {} (x {:.2g}): loses {} [{}]\n", way.change, way.time, way.loss, way.evidence);
}

void write_prediction(core::Json& json, const TimeBand& predicted, bool ended, double actual) {
  json.key("prediction").begin_object().member("cpu_s", predicted.expected).member("least_s", predicted.least);
  json.member("most_s", predicted.most).key("actual_s");
  if (ended)
    json.value(actual).member("within", actual >= predicted.least && actual <= predicted.most);
  else
    json.null();
  json.end_object();
}

}  // namespace polybed::multiscale
