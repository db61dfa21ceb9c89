#include "multiscale/calibrate/bed_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "closures/stress_table.hpp"
#include "core/error.hpp"
#include "core/output/file.hpp"
#include "fluid/solids_table_file.hpp"

namespace polybed::multiscale {

namespace {

/// What both measures of the pressure may differ by.
constexpr double agreement = 0.05;

}  // namespace

BedTable bed_table(const Plan& plan, const std::vector<BoxResult>& boxes, double weight) {
  BedTable table;
  const std::size_t seeds = boxes.size() / plan.axes.points();
  for (std::size_t p = 0; p < plan.axes.phi.size(); ++p) {
    double phi = 0, theta = 0;
    std::vector<Estimate> slabs, balance;
    for (std::size_t k = 0; k < seeds; ++k) {
      const BoxResult& b = boxes[p * seeds + k];
      phi += b.bed_phi / double(seeds);
      theta += b.theta.mean / double(seeds);
      slabs.push_back(b.bed_pressure);
      balance.push_back(b.bed_balance);
    }
    const Estimate pressure = mean_of_seeds(slabs), other = mean_of_seeds(balance);
    table.phi.push_back(phi);
    table.velocity.push_back(boxes[p * seeds].velocity);
    table.pressure.push_back(pressure.mean);
    table.error.push_back(pressure.error);
    table.balance.push_back(other.mean);
    table.balance_error.push_back(other.error);
    table.temperature.push_back(theta / weight);
    table.seeds.push_back(double(seeds));
  }
  return table;
}

void require_usable(const BedTable& t) {
  for (std::size_t n = 0; n < t.phi.size(); ++n) {
    const double off = std::abs(t.balance[n] - t.pressure[n]);
    if (off > agreement * std::abs(t.pressure[n]) && off > 2 * std::hypot(t.error[n], t.balance_error[n]))
      throw core::NumericsError(
          fmt::format("at phi = {:.3f} the pressure is {:.4g} by slabs and {:.4g} by the balance of forces, over the "
                      "unit: {:.0f} % apart, {:.0f} % are allowed",
                      t.phi[n], t.pressure[n], t.balance[n], 100 * off / std::abs(t.pressure[n]), 100 * agreement));
    if (n > 0 && !(t.phi[n] > t.phi[n - 1] && t.pressure[n] > t.pressure[n - 1]))
      throw core::NumericsError(fmt::format("p_bed falls between phi = {:.3f} and {:.3f}: {:.4g} and {:.4g}",
                                            t.phi[n - 1], t.phi[n], t.pressure[n - 1], t.pressure[n]));
  }
}

void write_bed_table(const std::filesystem::path& path, const BedTable& table, const std::string& created,
                     const std::string& case_hash) {
  core::OutputFile file = fluid::new_table();
  file.set_attribute("/", "regime", std::string("bed"));
  file.set_attribute("/", "units",
                     std::string("p_bed over |rho_p - rho_f| g D; theta_bed over that and rho_p; velocity m/s"));
  file.set_attribute("/", "created", created);
  file.set_attribute("/", "case_hash", case_hash);
  const std::vector<std::size_t> shape{table.phi.size()};
  file.write("phi", shape, table.phi);
  file.write("p_bed", shape, table.pressure);
  file.write("p_bed_se", shape, table.error);
  file.write("p_bed_n", shape, table.seeds);
  file.write("p_bed_by_balance", shape, table.balance);
  file.write("p_bed_by_balance_se", shape, table.balance_error);
  file.write("theta_bed", shape, table.temperature);
  file.write("velocity", shape, table.velocity);
  fluid::save_table(file, path);
}

void take_bed(fluid::SolidsTable& table, const std::filesystem::path& path) { table.bed = fluid::read_bed_table(path); }

std::string bed_rows(const BedTable& t) {
  std::string out = fmt::format("{:>8} {:>8} {:>20} {:>20} {:>12} {:>8}\n", "mm/s", "phi", "p_bed by slabs",
                                "by balance", "difference", "theta");
  for (std::size_t n = 0; n < t.phi.size(); ++n)
    out += fmt::format("{:>8.3f} {:>8.4f} {:>20} {:>20} {:>12} {:>8.3g}\n", 1e3 * t.velocity[n], t.phi[n],
                       fmt::format("{:.4g}+-{:.1g}", t.pressure[n], t.error[n]),
                       fmt::format("{:.4g}+-{:.1g}", t.balance[n], t.balance_error[n]),
                       fmt::format("{:+.1f} %", 100 * t.difference(n)), t.temperature[n]);
  return out;
}

std::string bed_lines(const std::vector<BoxResult>& boxes) {
  std::string out = fmt::format("{:>8} {:>8} {:>5} {:>20} {:>20} {:>12}\n", "planned", "phi", "seed", "p_bed by slabs",
                                "by balance", "slabs/balance");
  for (const BoxResult& b : boxes)
    out += fmt::format("{:>8g} {:>8.4f} {:>5} {:>20} {:>20} {:>12.3f}\n", b.point.phi, b.bed_phi, b.point.seed,
                       fmt::format("{:.4g}+-{:.1g}", b.bed_pressure.mean, b.bed_pressure.error),
                       fmt::format("{:.4g}+-{:.1g}", b.bed_balance.mean, b.bed_balance.error),
                       b.bed_pressure.mean / b.bed_balance.mean);
  return out;
}

}  // namespace polybed::multiscale
