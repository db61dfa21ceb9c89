// Small waves of an even fluidised bed, and the rate at which the equations make them grow and run.
#pragma once

#include <complex>
#include <numbers>
#include <ostream>
#include <span>

#include "closures/stress_frictional.hpp"
#include "scenes/box_equations.hpp"
#include "tfm/well_posedness.hpp"

namespace polybed::scenes {

constexpr double wavelength = 0.02, voidage = 0.76397, superficial_velocity = 0.05, wave_span = 0.1;

/// 1 mm, 2200 kg/m3, in water at 20 degC at the voidage at which 50 mm/s carries it; one column, m high.
inline core::Scene uniform_liquid_bed(int cells, double height = wavelength) {
  core::Scene scene = uniform_bed(1e-3, 2200, 998.207, 1.00157e-3, 1 - voidage, cells, height);
  scene.tfm.bulk_viscosity = 0;
  return scene;
}

/// A frictional pressure that acts from 0.1 on, with dp_s/dphi = slope, Pa, at the bed's solids fraction.
inline void add_stress(core::Scene& scene, double slope) {
  scene.effects["solids_stress"] = "frictional";
  scene.tfm.frictional_onset = 0.1;
  scene.tfm.max_packing = 0.64;
  scene.tfm.frictional_pressure = slope / closures::FrictionalLaw{1.0, 0.1, 0.64}(1 - voidage).slope;
}

/// The flux of the mixture is held; in one dimension the gradient that holds it follows face by face.
class HeldFlux : public BoxEquations {
 public:
  explicit HeldFlux(const core::Scene& scene, tfm::Scheme scheme = tfm::Scheme::limited)
      : BoxEquations(scene, joined_box(scene), {scheme, scheme, fluid::WallSlip::free_slip}, 1e-10) {}

  /// How far a state is from being ill-posed.
  tfm::WellPosedness margin_of(const std::vector<double>& y) {
    std::vector<double> rate(y.size());
    (void)rates(0, y, rate);
    return tfm::well_posedness(constants(), fields());
  }

 protected:
  void add(tfm::Fields&) override {}
  bool project(tfm::Fields& fields) override {
    auto& free = fields.flux_rate.free[1];
    for (std::size_t f = 0; f < free.size(); ++f) {
      if (!(fields.flux_rate.mobility[1][f] > 0)) continue;
      fields.solids.acceleration[0][1][f] -= free[f] / fields.flux_rate.mobility[1][f] / constants().density[0];
      free[f] = 0;
    }
    return true;
  }
};

struct Wave {
  double slope, growth, speed;
  double resistance = 0;                         ///< M, Pa s: M U_xx is the viscous force on the solids per volume
  double length = wavelength, amplitude = 1e-4;  ///< m; relative, of the solids fraction
  friend void PrintTo(const Wave& wave, std::ostream* out) {
    *out << "dp_s/dphi " << wave.slope << " Pa, M " << wave.resistance << " Pa s";
  }
};

/// A shear viscosity of the solids that is the same at every fraction and rate: that of the cap, which these beds reach
/// at rates below 6e-3 1/s; theirs begin at 2e-3. M = 4/3 mu_s, the rest of grad U + grad U^T - 2/3 div U I along the
/// wave.
inline void add_viscosity(core::Scene& scene, double resistance) {
  scene.effects["solids_viscosity"] = "schaeffer";
  scene.tfm.viscosity_cap = 0.75 * resistance;
  scene.tfm.least_shear_rate = 1e-4;
}

/// A wave exp(ikx + st) on an even bed under the flux J, m/s, with the solids' velocity that continuity asks for,
/// s phi' + ik phi U' = 0: without it the relation's other wave, which dies out, would be there too. Pressures are 0.
/// \param cells  to a wave
inline std::vector<double> small_wave(const tfm::StateLayout& layout, int cells, const Wave& wave,
                                      double velocity = superficial_velocity) {
  using Kind = tfm::StateLayout::Entry::Kind;
  const double k = 2 * std::numbers::pi / wave.length;
  const std::complex<double> i(0, 1), s(wave.growth, -k * wave.speed);
  const auto at = [&](double x) { return wave.amplitude * std::exp(i * k * x * (wave.length / cells)); };
  std::vector<double> y(layout.size(), 0.0);
  for (const auto& entry : layout.entries())
    for (std::size_t n = 0; n < entry.size; ++n) {
      if (entry.kind == Kind::fraction)
        y[entry.begin + n] = (1 - voidage) * (1 + at(double(n) + 0.5).real());
      else if (entry.axis == 1)
        y[entry.begin + n] = entry.species < 0 ? velocity : (-s / (i * k) * at(double(n))).real();
    }
  return y;
}

/// The first Fourier mode of the solids fraction over the cells of one wave.
inline std::complex<double> first_mode(std::span<const double> fraction) {
  std::complex<double> sum = 0;
  for (std::size_t n = 0; n < fraction.size(); ++n)
    sum += fraction[n] * std::polar(1.0, -2 * std::numbers::pi * (double(n) + 0.5) / double(fraction.size()));
  return sum;
}

/// s, 1/s, from the first Fourier mode of the fractions before and after 0.1 s.
inline std::complex<double> rate_of(const Wave& wave, int cells, tfm::Scheme scheme = tfm::Scheme::limited) {
  core::Scene scene = uniform_liquid_bed(cells, wave.length);
  if (wave.slope > 0) add_stress(scene, wave.slope);
  if (wave.resistance > 0) add_viscosity(scene, wave.resistance);
  HeldFlux bed(scene, scheme);
  std::vector<double> y = small_wave(bed.layout(), cells, wave);
  const auto mode = [&] { return first_mode(std::span<const double>(y).first(std::size_t(cells))); };
  const std::complex<double> before = mode();
  // Ripples from cell to cell must not grow: M/(phi rho_s) 4/h2 times the step stays below the 2.5 of the scheme.
  bed.advance(y, wave_span, 1e-3, wave.resistance > 0 ? 5e-5 : 2.5e-4);
  return std::log(mode() / before) / wave_span;
}

}  // namespace polybed::scenes
