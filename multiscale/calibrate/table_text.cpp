#include "multiscale/calibrate/table_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "closures/stress_reference.hpp"
#include "multiscale/calibrate/fit.hpp"

namespace polybed::multiscale {

namespace {

std::string list(const std::vector<double>& values) { return fmt::format("[{:.6g}]", fmt::join(values, ", ")); }

/// The least and greatest of a number of the boxes.
std::string range(const std::vector<BoxResult>& boxes, double BoxResult::*what) {
  double least = 1e300, most = -1e300;
  for (const BoxResult& b : boxes) {
    least = std::min(least, b.*what);
    most = std::max(most, b.*what);
  }
  return fmt::format("[{:.6g}, {:.6g}]", least, most);
}

/// Temperature ratio and exchange of boxes of two species; nothing of others.
std::string species_lines(const std::vector<BoxResult>& boxes) {
  std::string out;
  for (const BoxResult& b : boxes) {
    if (!b.point.binary) continue;
    if (out.empty())
      out = fmt::format("{:>6} {:>6} {:>5} {:>4} {:>16} {:>16} {:>8} {:>8}\n", "phi", "e", "x2", "seed", "T_2/T_1",
                        "beta_12/ref", "slip", "balance");
    const auto text = [](const Estimate& e) { return fmt::format("{:.4g}+-{:.1g}", e.mean, e.error); };
    out += fmt::format("{:>6g} {:>6g} {:>5g} {:>4} {:>16} {:>16} {:>8.3f} {:>8.5f}\n", b.point.phi, b.point.restitution,
                       b.point.share, b.point.seed, text(b.temperature_ratio),
                       b.point.pushed ? text(b.exchange_ratio) : "", b.slip, b.balance);
  }
  return out;
}

}  // namespace

std::string table_toml(const fluid::SolidsTable& t, const Plan& plan, const std::vector<BoxResult>& boxes) {
  double cpu = 0, steps = 0;
  for (const BoxResult& b : boxes) {
    cpu += b.cpu_seconds;
    steps += b.particle_steps;
  }
  std::string out = fmt::format(
      "filetype = \"polybed solids table\"\nversion = 1\ngit_commit = \"{}\"\ncreated = \"{}\"\ncase_hash = \"{}\"\n"
      "regime = \"{}\"\nregime_reason = \"{}\"\nreference = \"{}\"\nfit_residual = {:.4g}\nleft_out_residual = {:.4g}\n"
      "greatest_error = {:.4g}\n"
      "lambda = {:.6g}\nsize_ratio = {:.6g}\nboxes = {}\nparticle_steps = {:.4g}\ncpu_s = {:.4g}\n",
      t.git_commit, t.created, t.case_hash, t.regime, plan.regime.reason, t.reference, t.residual, t.left_out,
      greatest_error(t), t.inertia, t.size_ratio, boxes.size(), steps, cpu);
  out += fmt::format("balance = {}\nsoftness = {}\nmax_overlap = {}\ndrift = {}\nstrain = {}\ndrag_rate = {}\n",
                     range(boxes, &BoxResult::balance), range(boxes, &BoxResult::softness),
                     range(boxes, &BoxResult::max_overlap), range(boxes, &BoxResult::drift),
                     range(boxes, &BoxResult::strain), range(boxes, &BoxResult::drag_rate));
  out += fmt::format("\n[axes]\nphi = {}\nstokes = {}\ne = {}\nmu_p = {}\nx2 = {}\n", list(t.phi), list(t.stokes),
                     list(t.restitution), list(t.friction), list(t.share));
  out += fmt::format(
      "\n[ratios]  # [phi][stokes][e][mu_p][x2]\nseeds = {}\np = {}\np_se = {}\nmu = {}\nmu_se = {}\ngamma = {}\n"
      "gamma_se = {}\nT_12 = {}\nT_12_se = {}\nS = {}\n",
      list(t.pressure.seeds), list(t.pressure.value), list(t.pressure.error), list(t.viscosity.value),
      list(t.viscosity.error), list(t.dissipation.value), list(t.dissipation.error), list(t.temperature.value),
      list(t.temperature.error), list(t.shear_number));
  if (!t.exchange.value.empty())
    out += fmt::format("beta_12 = {}\nbeta_12_se = {}\n", list(t.exchange.value), list(t.exchange.error));
  if (t.regime == "dry")
    out += fmt::format("\n[fit]  # chi_eff = chi_CS (1 + a S)\na = {}\n", list(structure_coefficients(t)));
  return out;
}

std::string box_lines(const std::vector<BoxResult>& boxes) {
  std::string out = fmt::format(
      "{:>6} {:>6} {:>6} {:>5} {:>5} {:>4} {:>7} {:>16} {:>16} {:>16} {:>7} {:>7} {:>7} {:>8}\n", "phi", "St", "e",
      "mu_p", "x2", "seed", "S", "theta/(g d)^2", "p", "mu", "p/ref", "mu/ref", "G/ref", "balance");
  for (const BoxResult& b : boxes) {
    if (b.point.pushed) continue;
    const double unit = b.density * b.diameter * b.diameter * b.shear_rate;
    const auto text = [](const Estimate& e, double per) {
      return fmt::format("{:.4g}+-{:.1g}", e.mean / per, e.error / per);
    };
    out += fmt::format(
        "{:>6g} {:>6g} {:>6g} {:>5g} {:>5g} {:>4} {:>7.4g} {:>16} {:>16} {:>16} {:>7.4g} {:>7.4g} "
        "{:>7.4g} {:>8.5f}\n",
        b.point.phi, b.point.stokes, b.point.restitution, b.point.friction, b.point.share, b.point.seed,
        b.shear_number(), text(b.theta, std::pow(b.shear_rate * b.diameter, 2)), text(b.pressure, unit * b.shear_rate),
        text(b.viscosity, unit), b.pressure_ratio.mean, b.viscosity_ratio.mean, b.dissipation_ratio.mean, b.balance);
  }
  return out + species_lines(boxes);
}

}  // namespace polybed::multiscale
