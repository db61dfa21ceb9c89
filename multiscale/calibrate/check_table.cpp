#include "multiscale/calibrate/check_table.hpp"

#include <fmt/format.h>

#include <cmath>

namespace polybed::multiscale {

std::vector<BoxPoint> points_between(const fluid::SolidsTable& t, const Plan& plan) {
  const std::size_t gaps = t.phi.size() - 1, half = (t.stokes.size() - 1) / 2;
  double stokes = t.stokes[half];
  if (t.stokes.size() > 1) stokes = std::sqrt(stokes * t.stokes[half + 1]);
  std::vector<BoxPoint> points;
  for (std::size_t gap = 0; gap < gaps; ++gap) {
    if (gap != 0 && gap != gaps / 2 && gap + 1 != gaps) continue;
    BoxPoint p;
    p.regime = t.regime;
    p.phi = 0.5 * (t.phi[gap] + t.phi[gap + 1]);
    p.stokes = stokes;
    p.restitution = t.restitution.front();
    p.friction = t.friction.front();
    p.share = t.share.front();
    p.binary = plan.binary;
    p.seed = 1001;
    points.push_back(p);
  }
  return points;
}

Deviation deviation(const fluid::SolidsTable& t, const BoxResult& box) {
  const auto at = [&](double sigma) {
    return fluid::ratios_at(t, {box.point.restitution, box.point.friction, box.point.share, sigma})(box.point.phi,
                                                                                                    box.point.stokes);
  };
  const closures::RatioValues mean = at(0), up = at(1);
  const double inertia = 1 + t.inertia * box.point.stokes;
  const auto one = [&](const Estimate& e, double table, double moved, double& off, double& error) {
    off = e.mean / (inertia * table) - 1;
    error = std::hypot(e.error / (inertia * table), moved / table - 1);
  };
  Deviation d{box.point, 0, 0, 0, 0};
  one(box.pressure_ratio, mean.pressure.pressure, up.pressure.pressure, d.pressure, d.pressure_error);
  one(box.viscosity_ratio, mean.viscosity.pressure, up.viscosity.pressure, d.viscosity, d.viscosity_error);
  return d;
}

std::string deviation_lines(const std::vector<Deviation>& deviations) {
  std::string out = fmt::format("{:>6} {:>6} {:>24} {:>24}\n", "phi", "St", "p, box over table", "mu, box over table");
  for (const Deviation& d : deviations) {
    const auto text = [](double off, double error) {
      return fmt::format("{:+.1f} % +- {:.1f} ({:.1f} se)", 100 * off, 100 * error, std::abs(off) / error);
    };
    out += fmt::format("{:>6.4g} {:>6.4g} {:>24} {:>24}\n", d.point.phi, d.point.stokes,
                       text(d.pressure, d.pressure_error), text(d.viscosity, d.viscosity_error));
  }
  return out;
}

}  // namespace polybed::multiscale
