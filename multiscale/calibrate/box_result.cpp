#include "multiscale/calibrate/box_result.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/output/json_value.hpp"

namespace polybed::multiscale {

namespace {

Estimate simple(const std::vector<double>& blocks) {
  double sum = 0, squares = 0;
  for (const double b : blocks) sum += b;
  const double n = double(blocks.size()), mean = sum / n;
  for (const double b : blocks) squares += (b - mean) * (b - mean);
  return {mean, n > 1 ? std::sqrt(squares / (n * (n - 1))) : 0};
}

std::vector<double> merged(const std::vector<double>& blocks) {
  std::vector<double> pairs;
  for (std::size_t n = 0; n + 1 < blocks.size(); n += 2) pairs.push_back(0.5 * (blocks[n] + blocks[n + 1]));
  return pairs;
}

/// Every number of a result by name: one list to write and to read.
void each_number(BoxResult& r, const std::function<void(const char*, double&)>& see) {
  see("solids_fraction", r.point.phi);
  see("stokes", r.point.stokes);
  see("restitution", r.point.restitution);
  see("friction", r.point.friction);
  see("share", r.point.share);
  see("first_normal_over_p", r.first_normal);
  see("second_normal_over_p", r.second_normal);
  see("contact_share", r.contact_share);
  see("contacts_per_particle", r.contacts);
  see("sink_W_m3", r.sink);
  see("balance", r.balance);
  see("drift", r.drift);
  see("shear_rate_1_s", r.shear_rate);
  see("diameter_m", r.diameter);
  see("density_kg_m3", r.density);
  see("strain", r.strain);
  see("drag_rate", r.drag_rate);
  see("softness", r.softness);
  see("max_overlap", r.max_overlap);
  see("cpu_s", r.cpu_seconds);
  see("particle_steps", r.particle_steps);
  see("bed_phi", r.bed_phi);
  see("slip_over_sqrt_theta", r.slip);
  see("velocity_m_s", r.velocity);
}

void each_estimate(BoxResult& r, const std::function<void(const char*, Estimate&)>& see) {
  see("theta_m2_s2", r.theta);
  see("pressure_Pa", r.pressure);
  see("viscosity_Pa_s", r.viscosity);
  see("dissipation_W_m3", r.dissipation);
  see("temperature_ratio", r.temperature_ratio);
  see("p_ratio", r.pressure_ratio);
  see("mu_ratio", r.viscosity_ratio);
  see("gamma_ratio", r.dissipation_ratio);
  see("exchange_kg_m3_s", r.exchange);
  see("exchange_ratio", r.exchange_ratio);
  see("p_bed", r.bed_pressure);
  see("p_bed_by_balance", r.bed_balance);
}

}  // namespace

Estimate estimate_of(const std::vector<double>& blocks) {
  Estimate result = simple(blocks);
  std::vector<double> longer = blocks;
  while (longer.size() > 20) longer = merged(longer);
  for (int n = 0; n < 3 && longer.size() >= 4; ++n, longer = merged(longer))
    result.error = std::max(result.error, simple(longer).error);
  return result;
}

double student_one_sigma(std::size_t degrees) {
  constexpr std::array<double, 9> table{1.837, 1.321, 1.197, 1.142, 1.111, 1.091, 1.077, 1.067, 1.059};
  if (degrees == 0) throw std::invalid_argument("no degrees of freedom");
  if (degrees <= table.size()) return table[degrees - 1];
  const double n = double(degrees);
  return 1 + 1 / (2 * n) + 1 / (4 * n * n);
}

Estimate mean_of_seeds(const std::vector<Estimate>& seeds) {
  double sum = 0, squares = 0, scatter = 0;
  const double n = double(seeds.size());
  for (const Estimate& s : seeds) {
    sum += s.mean;
    squares += s.error * s.error;
  }
  for (const Estimate& s : seeds) scatter += (s.mean - sum / n) * (s.mean - sum / n);
  const double inner = std::sqrt(squares) / n;
  if (seeds.size() < 2) return {sum / n, inner};
  const double outer = student_one_sigma(seeds.size() - 1) * std::sqrt(scatter / (n * (n - 1)));
  return {sum / n, seeds.size() < seeds_that_tell ? std::max(inner, outer) : outer};
}

bool error_grows(const std::vector<double>& blocks) {
  std::vector<double> longer = blocks;
  while (longer.size() > 20) longer = merged(longer);
  return simple(merged(longer)).error > 1.3 * simple(longer).error;
}

double BoxResult::shear_number() const { return shear_rate * diameter / std::sqrt(theta.mean); }

void write_box(const std::filesystem::path& path, const BoxResult& result) {
  BoxResult r = result;
  core::Json json;
  json.begin_object().member("hash", r.hash).member("regime", r.point.regime).member("seed", r.point.seed);
  json.member("binary", r.point.binary).member("pushed", r.point.pushed);
  each_number(r, [&](const char* name, double& value) { json.member(name, value); });
  each_estimate(r, [&](const char* name, Estimate& value) {
    json.key(name).begin_array().value(value.mean).value(value.error).end_array();
  });
  const std::string text = json.end_object().text() + "\n";
  core::write_atomically(path, text);
}

std::optional<BoxResult> read_box(const std::filesystem::path& path, const std::string& hash) {
  if (!std::filesystem::exists(path)) return {};
  try {
    const core::JsonValue json = core::read_json(path);
    if (json.of("hash").text() != hash) return {};
    BoxResult r;
    r.hash = hash;
    r.point.regime = json.of("regime").text();
    r.point.seed = int(json.of("seed").number());
    r.point.binary = json.of("binary").truth();
    r.point.pushed = json.of("pushed").truth();
    each_number(r, [&](const char* name, double& value) { value = json.of(name).number(); });
    each_estimate(r, [&](const char* name, Estimate& value) {
      value = {json.of(name).array().at(0).number(), json.of(name).array().at(1).number()};
    });
    return r;
  } catch (const core::FileError&) {
    return {};  // damaged: it is run again
  }
}

}  // namespace polybed::multiscale
