#include "multiscale/inversion/scan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/output/json.hpp"
#include "core/version.hpp"

namespace polybed::multiscale {

namespace {

using core::Json;

void write_run(Json& json, const ScanRun& run, const RunOfScan& of_run) {
  json.begin_object().member("velocity_m_s", run.velocity).key("from");
  run.from ? json.value(std::int64_t(*run.from)) : json.null();
  json.member("centre_difference", run.mean.value).member("error", run.mean.error);
  json.member("bed_height_m", of_run.bed_height).member("bed_height_error_m", of_run.bed_height_error);
  json.member("begin_s", of_run.begin).member("end_s", of_run.end).member("cpu_s", of_run.cpu_seconds);
  json.member("directory", of_run.directory.string())
      .member("git_commit", of_run.git_commit)
      .key("warnings")
      .begin_array();
  for (const std::string& line : of_run.drifts) json.value(line);
  json.end_array().end_object();
}

void write_band(Json& json, const ScanOfModel& scan);

void write_scan(Json& json, const ScanOfModel& scan, const std::string& name) {
  const ScanResult& found = scan.result;
  json.key(name).begin_object().member("outcome", name_of(found.end));
  json.member("velocity_m_s", found.velocity);
  json.member("error_m_s", found.error);
  json.member("low_m_s", found.low).member("high_m_s", found.high);
  json.member("slope_s_m", found.slope);
  double cpu = 0;
  for (const RunOfScan& run : scan.runs) cpu += run.cpu_seconds;
  json.member("cpu_s", cpu).key("runs").begin_array();
  for (std::size_t n = 0; n < scan.runs.size(); ++n) write_run(json, found.runs[n], scan.runs[n]);
  json.end_array();
  write_band(json, scan);
  json.end_object();
}

/// Both scans with the table moved, and the band; nothing where there are none.
void write_band(Json& json, const ScanOfModel& scan) {
  if (scan.moved.empty()) return;
  json.key("stress_uncertainty").begin_object().member("standard_errors", 1);
  const auto band = stress_band(scan);
  json.member("low_m_s", band ? std::optional(band->low) : std::nullopt);
  json.member("high_m_s", band ? std::optional(band->high) : std::nullopt);
  write_scan(json, scan.moved[0], "minus");
  write_scan(json, scan.moved[1], "plus");
  json.end_object();
}

void write_agreement(Json& json, const std::optional<ScanAgreement>& agreement) {
  json.key("agreement");
  if (!agreement) {
    json.null();
    return;
  }
  json.begin_object().member("value", agreement->difference).member("error", agreement->error);
  json.member("goal", agreement->goal).member("reached", std::abs(agreement->difference) <= agreement->goal);
  json.end_object();
}

std::string band_line(const ScanOfModel& scan) {
  if (const auto band = stress_band(scan))
    return fmt::format("{}: {:.4g} to {:.4g} mm/s within one standard error of the table\n", scan.model,
                       1e3 * band->low, 1e3 * band->high);
  return scan.moved.empty() ? "" : fmt::format("{}: no band of the table: not every scan has found one\n", scan.model);
}

std::string finding(const ScanOfModel& scan) {
  const ScanResult& found = scan.result;
  if (!found.velocity)
    return fmt::format("{}: no inversion between {:.4g} and {:.4g} mm/s\n", scan.model, 1e3 * found.low,
                       1e3 * found.high);
  return fmt::format(
      "{}: inversion at {:.4g} +-{:.1g} mm/s, between {:.4g} and {:.4g} (ended by {}), slope {:.3g} s/m\n", scan.model,
      1e3 * *found.velocity, 1e3 * *found.error, 1e3 * found.low, 1e3 * found.high, name_of(found.end), *found.slope);
}

}  // namespace

std::optional<StressBand> stress_band(const ScanOfModel& scan) {
  if (scan.moved.empty() || !scan.result.velocity) return std::nullopt;
  StressBand band{*scan.result.velocity, *scan.result.velocity};
  for (const ScanOfModel& moved : scan.moved) {
    if (!moved.result.velocity) return std::nullopt;
    band = {std::min(band.low, *moved.result.velocity), std::max(band.high, *moved.result.velocity)};
  }
  return band;
}

std::optional<ScanAgreement> agreement_of(const std::vector<ScanOfModel>& scans) {
  const auto of = [&](const std::string& model) -> const ScanResult* {
    const auto scan = std::find_if(scans.begin(), scans.end(), [&](const auto& s) { return s.model == model; });
    return scan == scans.end() || !scan->result.velocity ? nullptr : &scan->result;
  };
  const ScanResult *tfm = of("tfm"), *dem = of("dem");
  if (tfm == nullptr || dem == nullptr) return std::nullopt;
  const double quotient = *tfm->velocity / *dem->velocity;
  return ScanAgreement{quotient - 1, quotient * std::hypot(*tfm->error / *tfm->velocity, *dem->error / *dem->velocity),
                       std::max(0.05, 0.5 * (tfm->width() + dem->width()))};
}

std::string scan_json(const std::vector<ScanOfModel>& scans, const ScanRequest& request) {
  Json json;
  json.begin_object().member("filetype", "polybed inversion").member("version", 1);
  json.member("git_commit", core::git_commit()).member("case", request.case_file);
  json.member("case_hash", request.case_hash).member("directory", request.directory.string());
  json.key("overrides").begin_array();
  for (const std::string& override : request.overrides) json.value(override);
  json.end_array().member("scan", request.models).member("from_m_s", request.range.low);
  json.member("to_m_s", request.range.high).member("until_s", request.until);
  json.member("ranks", std::int64_t(request.ranks)).key("species").begin_array();
  for (const std::string& name : request.species) json.value(name);
  json.end_array().key("force_balance");
  if (const auto& point = request.force_balance)
    json.begin_object().member("velocity_m_s", point->velocity).member("voidage", point->voidage).end_object();
  else
    json.null();
  json.key("models").begin_object();
  for (const ScanOfModel& scan : scans) write_scan(json, scan, scan.model);
  json.end_object();
  write_agreement(json, agreement_of(scans));
  return json.end_object().text();
}

std::string scan_head() {
  return fmt::format("{:5} {:>8} {:>10} {:>20} {:>16} {:>8}\n", "model", "mm/s", "from mm/s", "centre_difference",
                     "bed height, mm", "CPU s");
}

std::string scan_line(const std::string& model, const ScanRun& run, const RunOfScan& of_run,
                      const std::optional<double>& from) {
  return fmt::format("{:5} {:8.2f} {:>10} {:>20} {:>16} {:8.3g}{}{}\n", model, 1e3 * run.velocity,
                     from ? fmt::format("{:.2f}", 1e3 * *from) : "start",
                     fmt::format("{:.4f} +-{:.1g}", run.mean.value, run.mean.error),
                     fmt::format("{:.1f} +-{:.1g}", 1e3 * of_run.bed_height, 1e3 * of_run.bed_height_error),
                     of_run.cpu_seconds, of_run.reused ? "  finished before" : "",
                     of_run.drifts.empty() ? "" : "  not steady");
}

std::string scan_findings(const std::vector<ScanOfModel>& scans, const ScanRequest& request) {
  std::string text = "\n";
  for (const ScanOfModel& scan : scans) text += finding(scan) + band_line(scan);
  if (request.force_balance) text += fmt::format("force balance: {:.4g} mm/s\n", 1e3 * request.force_balance->velocity);
  if (const auto agreement = agreement_of(scans))
    text += fmt::format("tfm/dem - 1: {:.3f} +-{:.1g}, goal {:.3f}: {}\n", agreement->difference, agreement->error,
                        agreement->goal, std::abs(agreement->difference) <= agreement->goal ? "reached" : "missed");
  return text;
}

}  // namespace polybed::multiscale
