// Hard cases of the closures: T5, T6, T7, T9.
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "closures/drag.hpp"
#include "closures/well_posedness.hpp"
#include "hard/cases.hpp"
#include "hard/scenes.hpp"

namespace polybed::hard {

namespace {

closures::Guard guard_of(const Trial& trial) { return trial.naive() ? closures::Guard::off : closures::Guard::on; }

/// T5, a cell: Sauter form of drag in a dense bed with a trace of fines.
void trace_of_fines(Trial& trial) {
  for (const closures::DragLawInfo& info : closures::drag_laws()) {
    if (!info.obeys_sum_rule) continue;
    const closures::DragLaw law = closures::drag_law(info.name, guard_of(trial));
    for (const double ratio : {10.0, 20.0})
      for (const double fines : {0.003, 0.01, 0.03, 0.1, 0.3})
        for (const auto& [eps, reynolds] : {std::pair{0.35, 1e-6}, {0.35, 500.0}, {0.33, 1.0}, {0.30, 100.0}}) {
          const std::array<double, 2> share{fines, 1 - fines}, diameter{1e-3, ratio * 1e-3};
          const double mean = closures::sauter_diameter(share, diameter), slip = reynolds * 1e-3 / (1000 * mean);
          std::array<double, 2> f{}, slope{};
          closures::drag_of_mixture(law, eps, share, diameter, std::array{slip, slip}, 1000, 1e-3, f, slope);
          const double f_mean = closures::drag_of_mean(law, eps, reynolds, share, diameter, f);
          double total = 0;
          for (std::size_t j = 0; j < 2; ++j) {
            total += share[j] * f[j] * (mean / diameter[j]) * (mean / diameter[j]);
            trial.measure("V13 f_j not above 0", f[j] > 0 ? 0 : 1 - f[j], 0);
          }
          trial.measure("sum of forces = total", std::abs(total / f_mean - 1), 1e-12);
        }
  }
}

/// T5: the same in a bed that settles in water, 2 mm and 0.2 mm, 3 % fines.
void size_ratio(Trial& trial) {
  trace_of_fines(trial);
  core::Scene scene = two_species(40, 0.08, true);
  scene.species[0].diameter = 0.2e-3;
  scene.species[1].diameter = 2e-3;
  scene.species[0].density = scene.species[1].density = 2500;
  scene.bed.volume_share = {0.03, 0.97};
  scene.bed.solids_fraction = 0.70;
  scene.bed.start_solids_fraction = 0.68;
  scene.bed.static_height = 0.05;
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.2);
}

/// T6: every law over voidages, Reynolds numbers from 0 through subnormal ones to 1e6.
void every_law(Trial& trial) {
  for (const std::string& name : trial.naive() ? std::vector<std::string>{"cello"} : closures::drag_law_names()) {
    const closures::DragLaw law = closures::drag_law(name, guard_of(trial));
    for (double eps = 0.05; eps <= 1.0; eps += 0.05) {
      std::vector<double> reynolds{0.0, 1e-320, 1e-300};
      for (double power = -8; power <= 6; power += 0.125) reynolds.push_back(std::pow(10, power));
      const std::vector<double> voidage(reynolds.size(), std::min(eps, 1.0));
      std::vector<double> f(reynolds.size()), slope(reynolds.size());
      closures::GuardCount count;
      closures::drag_of_points(law, voidage, reynolds, f, slope, count);
      for (std::size_t n = 0; n < f.size(); ++n) {
        const bool finite = std::isfinite(f[n]) && std::isfinite(slope[n]);
        trial.measure("V3 finite f and derivative", finite ? 0 : 1, 0);
        trial.measure("f above 0", f[n] > 0 ? 0 : 1, 0);
        // A force that falls by round-off of its own size is no fall.
        if (n > 3) trial.measure("force grows with slip", 1 - reynolds[n] * f[n] / (reynolds[n - 1] * f[n - 1]), 1e-14);
      }
    }
  }
}

/// Wave speeds of the linearised equations without drag from a general eigenvalue solver: unknowns phi, u_s in
/// (u_s - c) phi' + phi u_s' = 0 and the difference of the momentum equations with u_f' from continuity.
double greatest_growth(double k, double phi, double rho_s, double rho_f, double w, double slope) {
  const double eps = 1 - phi, a = rho_s / phi, b = rho_f / eps;  // u_s = 0, u_f = w; x = (phi', c phi')
  Eigen::Matrix2d companion;
  companion << 0, 1, (slope / phi - b * w * w) / (a + b), 2 * b * w / (a + b);
  double most = 0;
  for (const std::complex<double>& c : companion.eigenvalues()) most = std::max(most, k * c.imag());
  return most;
}

/// Growth rate, 1/s, of a wave of number k, 1/m, without drag: k Im(c); 0 where the equations are well-posed.
/// For G = 0: k |w| sqrt(a b)/(a + b), without bound as waves become short.
double growth_without_drag(double wave_number, double solids_fraction, double solids_density, double fluid_density,
                           double slip, double slope) {
  const double a = solids_density / solids_fraction, b = fluid_density / (1 - solids_fraction);
  const double missing = closures::critical_slope(solids_fraction, solids_density, fluid_density, slip) - slope;
  return missing > 0 ? wave_number * std::sqrt(missing / solids_fraction / (a + b)) : 0.0;
}

/// T7: glass in air and in water; slope over critical slope 0 to 10; five wave lengths, each half the last.
void well_posedness(Trial& trial) {
  struct State {
    double phi, rho_s, rho_f, w;
  };
  for (const State& s : {State{0.55, 2500, 1.2, 0.6 / 0.45}, State{0.36, 2200, 998.207, 0.05 / 0.64},
                         State{0.084, 1395, 998.207, 0.0343 / 0.916}}) {
    const double critical = closures::critical_slope(s.phi, s.rho_s, s.rho_f, s.w);
    for (const double ratio : {0.0, 0.5, 0.99, 1.01, 10.0}) {
      const double slope = trial.naive() ? 0.0 : ratio * critical;
      for (double k = 2 * 3.14159265358979 / 0.02; k < 2e4; k *= 2) {
        const double exact = greatest_growth(k, s.phi, s.rho_s, s.rho_f, s.w, slope);
        const double found = growth_without_drag(k, s.phi, s.rho_s, s.rho_f, s.w, slope);
        // Round-off of a root of a difference: 1e-8 of the largest possible growth.
        trial.measure("growth as the eigenvalues", std::abs(found - exact) / (k * s.w), 1e-8);
        if (ratio > 1) trial.measure("growth where the case is well-posed, of short waves", found, 0);
      }
    }
    const auto ill_posed = [&](double ratio) {
      return growth_without_drag(1, s.phi, s.rho_s, s.rho_f, s.w, ratio * critical) > 0;
    };
    trial.measure("switches at 1", ill_posed(1 - 1e-9) && !ill_posed(1 + 1e-9) ? 0 : 1, 0);
  }
}

/// The textbook's drag coefficient of a sphere, 24/Re (1 + 0.15 Re^0.687), brought back to drag over Stokes.
double drag_by_coefficient(double reynolds) {
  const double coefficient = 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687));
  return coefficient * reynolds / 24;
}

/// T9: solids and fluid move as one, slip exactly 0: every law gives its limit, and a run goes on from there.
void no_slip(Trial& trial) {
  for (const std::string& name : closures::drag_law_names()) {
    const closures::DragLaw law = closures::drag_law(name, closures::Guard::on);
    for (const double eps : {0.4, 0.6, 0.9}) {
      std::array<double, 2> f{}, slope{};
      closures::GuardCount count;
      closures::drag_of_points(law, std::array{eps, eps}, std::array{0.0, 1e-20}, f, slope, count);
      if (trial.naive()) f[0] = drag_by_coefficient(0) * f[1];
      trial.measure("f at slip 0", std::abs(f[0] / f[1] - 1), 1e-9);
    }
  }
  if (trial.naive()) return;
  core::Scene scene = two_species(30, 0.06, true);
  scene.column.gravity = 0;
  scene.tfm.max_packing = 0.64;
  scene.bed.static_height = 0.03;
  scene.bed.start_solids_fraction = 0.4;
  const auto run = trial.begin(scene);
  trial.advance(*run, 1.0, {.rests = true});
}

}  // namespace

std::vector<HardCase> closure_cases() {
  const std::vector<Treatment> one{{"closures", "", ""}};  // no run, no scheme
  return {{"T5",
           "size ratio 10 and 20, a trace of fines, phi 0.65 to 0.70",
           {"unguarded_alpha"},
           all_schemes(),
           size_ratio},
          {"T6", "every drag law, any voidage, Reynolds number and slip 0", {"raw_drag"}, one, every_law},
          {"T7", "slope of the solids pressure against the critical one", {"no_stress"}, one, well_posedness},
          {"T9", "slip exactly 0", {"divide_by_phi"}, all_schemes(), no_slip}};
}

}  // namespace polybed::hard
