#include "multiscale/calibrate/box_result.hpp"

#include <algorithm>
#include <cmath>

#include "core/output/files.hpp"
#include "core/output/json.hpp"

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

}  // namespace

Estimate estimate_of(const std::vector<double>& blocks) {
  Estimate result = simple(blocks);
  std::vector<double> longer = blocks;
  while (longer.size() > 20) longer = merged(longer);
  for (int n = 0; n < 3 && longer.size() >= 4; ++n, longer = merged(longer))
    result.error = std::max(result.error, simple(longer).error);
  return result;
}

bool error_grows(const std::vector<double>& blocks) {
  std::vector<double> longer = blocks;
  while (longer.size() > 20) longer = merged(longer);
  return simple(merged(longer)).error > 1.3 * simple(longer).error;
}

void write_box(const std::filesystem::path& path, const BoxResult& r) {
  core::Json json;
  const auto estimate = [&](const char* name, const Estimate& value) {
    json.key(name).begin_array().value(value.mean).value(value.error).end_array();
  };
  json.begin_object()
      .member("hash", r.hash)
      .member("regime", core::name_of(r.point.regime))
      .member("seed", r.point.seed);
  json.member("binary", r.point.binary).member("pushed", r.point.pushed);
  json.member("solids_fraction", r.point.phi);
  json.member("stokes", r.point.stokes);
  json.member("restitution", r.point.restitution);
  json.member("friction", r.point.friction);
  json.member("share", r.point.share);
  json.member("first_normal_over_p", r.first_normal);
  json.member("second_normal_over_p", r.second_normal);
  json.member("contact_share", r.contact_share);
  json.member("contacts_per_particle", r.contacts);
  json.member("sink_W_m3", r.sink);
  json.member("balance", r.balance);
  json.member("drift", r.drift);
  json.member("shear_rate_1_s", r.shear_rate);
  json.member("diameter_m", r.diameter);
  json.member("density_kg_m3", r.density);
  json.member("strain", r.strain);
  json.member("drag_rate", r.drag_rate);
  json.member("softness", r.softness);
  json.member("max_overlap", r.max_overlap);
  json.member("cpu_s", r.cpu_seconds);
  json.member("particle_steps", r.particle_steps);
  json.member("bed_phi", r.bed_phi);
  json.member("slip_over_sqrt_theta", r.slip);
  json.member("velocity_m_s", r.velocity);
  estimate("theta_m2_s2", r.theta);
  estimate("pressure_Pa", r.pressure);
  estimate("viscosity_Pa_s", r.viscosity);
  estimate("dissipation_W_m3", r.dissipation);
  estimate("temperature_ratio", r.temperature_ratio);
  estimate("p_ratio", r.pressure_ratio);
  estimate("mu_ratio", r.viscosity_ratio);
  estimate("gamma_ratio", r.dissipation_ratio);
  estimate("exchange_kg_m3_s", r.exchange);
  estimate("exchange_ratio", r.exchange_ratio);
  estimate("p_bed", r.bed_pressure);
  estimate("p_bed_by_balance", r.bed_balance);
  core::write_atomically(path, json.end_object().text() + "\n");
}

}  // namespace polybed::multiscale
