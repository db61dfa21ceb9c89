#include "multiscale/calibrate/box_result.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

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
  const auto estimate = [](const Estimate& value) { return core::Json::array({value.mean, value.error}); };
  const core::Json json = {{"hash", r.hash},
                           {"regime", core::name_of(r.point.regime)},
                           {"seed", r.point.seed},
                           {"binary", r.point.binary},
                           {"pushed", r.point.pushed},
                           {"solids_fraction", r.point.phi},
                           {"stokes", r.point.stokes},
                           {"restitution", r.point.restitution},
                           {"friction", r.point.friction},
                           {"share", r.point.share},
                           {"first_normal_over_p", r.first_normal},
                           {"second_normal_over_p", r.second_normal},
                           {"contact_share", r.contact_share},
                           {"contacts_per_particle", r.contacts},
                           {"sink_W_m3", r.sink},
                           {"balance", r.balance},
                           {"drift", r.drift},
                           {"shear_rate_1_s", r.shear_rate},
                           {"diameter_m", r.diameter},
                           {"density_kg_m3", r.density},
                           {"strain", r.strain},
                           {"drag_rate", r.drag_rate},
                           {"softness", r.softness},
                           {"max_overlap", r.max_overlap},
                           {"cpu_s", r.cpu_seconds},
                           {"particle_steps", r.particle_steps},
                           {"bed_phi", r.bed_phi},
                           {"slip_over_sqrt_theta", r.slip},
                           {"velocity_m_s", r.velocity},
                           {"theta_m2_s2", estimate(r.theta)},
                           {"pressure_Pa", estimate(r.pressure)},
                           {"viscosity_Pa_s", estimate(r.viscosity)},
                           {"dissipation_W_m3", estimate(r.dissipation)},
                           {"temperature_ratio", estimate(r.temperature_ratio)},
                           {"p_ratio", estimate(r.pressure_ratio)},
                           {"mu_ratio", estimate(r.viscosity_ratio)},
                           {"gamma_ratio", estimate(r.dissipation_ratio)},
                           {"exchange_kg_m3_s", estimate(r.exchange)},
                           {"exchange_ratio", estimate(r.exchange_ratio)},
                           {"p_bed", estimate(r.bed_pressure)},
                           {"p_bed_by_balance", estimate(r.bed_balance)}};
  core::write_atomically(path, core::json_text(json) + "\n");
}

}  // namespace polybed::multiscale
