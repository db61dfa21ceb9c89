// Hard cases of small waves on an even bed: T7 on five grids, T8.
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

#include "closures/well_posedness.hpp"
#include "hard/cases.hpp"
#include "hard/scenes.hpp"
#include "scenes/dispersion.hpp"
#include "scenes/waves.hpp"

namespace polybed::hard {

namespace {

using scenes::Wave;

/// T7 on five grids: a wave of 20 mm in an even bed at a slope of the solids pressure. Where the equations are
/// well-posed every halving of the cells changes its growth less than the one before (V14), and the finest grid gives
/// that of the dispersion relation; where they are not the state is flagged on every grid, and what the grids give is
/// reported.
void on_five_grids(Trial& trial) {
  const tfm::Scheme scheme = trial.treatment().flux == "upwind" ? tfm::Scheme::upwind : tfm::Scheme::limited;
  for (const Wave& wave :
       {Wave{0, 1.2012, 0.04291}, Wave{2 * 1.1585, 0.5585, 0.04323}, Wave{10 * 1.1585, -2.0677, 0.04463}}) {
    double before = 0, change = 0;
    for (const int cells : {16, 32, 64, 128, 256}) {
      core::Scene scene = scenes::uniform_liquid_bed(cells);
      if (wave.slope > 0) scenes::add_stress(scene, wave.slope);
      scenes::HeldFlux bed(scene, scheme);
      const tfm::WellPosedness margin = bed.margin_of(scenes::small_wave(bed.layout(), cells, wave));
      trial.measure("flagged as it is", (margin.share_below > 0) == (wave.slope == 0) ? 0 : 1, 0);
      const double growth = scenes::rate_of(wave, cells, scheme).real(), now = std::abs(growth - before);
      if (wave.slope == 0)
        trial.report("growth without stress on " + std::to_string(cells) + " cells, 1/s", growth);
      else if (cells > 32)
        trial.measure("V14 change over the one before", now / change, 1);
      before = growth;
      change = now;
    }
    if (wave.slope > 0) trial.measure("growth on the finest grid", std::abs(before / wave.growth - 1), 0.02);
  }
}

/// The wave on the bed of a model at its start; no solids cross the ends of the column.
void put_on(tfm::Model& model, int cells, const Wave& wave, double velocity) {
  using Kind = tfm::StateLayout::Entry::Kind;
  core::Checkpoint start = model.checkpoint();
  const tfm::StateLayout layout(model.constants().grid, 1,
                                model.integrator_kind() == core::TfmIntegrator::implicit_steps);
  std::vector<double> y = scenes::small_wave(layout, cells, wave, velocity);
  for (const tfm::StateLayout::Entry& entry : layout.entries())
    if (entry.kind == Kind::velocity && entry.axis == 1) y[entry.begin] = y[entry.begin + entry.size - 1] = 0;
  start.arrays.at("state") = y;
  model.start_from(start);
}

/// T8, one wave: three of it fill a column that the fluid carries evenly. What the grid makes of it at the start
/// differs a little from the exact wave; once the other wave, which that leaves, is 1e-3 of itself, the middle third is
/// watched while the wave runs two fifths of its length, so that nothing of the ends reaches it. The tolerance is far
/// below the amplitude, or the error test would not see the wave. 96 cells to a wave: the grid takes some (kh)^3/12 of
/// the frequency from the growth, which for the longest wave is less than a hundredth of the frequency.
void small_wave(Trial& trial, double length, double slope) {
  constexpr int cells = 96, waves = 3;
  constexpr double amplitude = 1e-6;
  core::Scene scene = scenes::uniform_liquid_bed(waves * cells, waves * length);
  scenes::add_stress(scene, slope);
  scene.tfm.rtol = 1e-10;
  const double velocity = scenes::carrying_velocity(scene), k = 2 * std::numbers::pi / length;
  scene.inlet.superficial_velocity = {{0.0, velocity}};
  const auto [exact, other] = scenes::rates_of_linear_theory(scene, velocity, k, slope);
  const Wave wave{slope, exact.real(), -exact.imag() / k, 0, length, amplitude};
  const auto run = trial.begin(scene, [&](tfm::Model& model) { put_on(model, cells, wave, velocity); });
  const auto mode = [&] {
    return scenes::first_mode(std::span<const double>(profile_of(*run).fraction[0]).subspan(cells, cells));
  };
  const double start = std::log(1e3) / std::abs(other.real()), span = 0.4 * length / wave.speed;
  trial.advance(*run, start);
  const std::complex<double> before = mode();
  trial.advance(*run, start + span);
  const std::complex<double> found = std::log(mode() / before) / span;
  trial.measure("growth off linear theory", std::abs(found.real() / exact.real() - 1), 0.02);
  trial.measure("speed off linear theory", std::abs(found.imag() / exact.imag() - 1), 0.02);
}

/// T8: waves of 1e-6 of the solids fraction, six lengths, where a stress lets them grow and where it damps them.
void small_waves(Trial& trial) {
  const core::Scene scene = scenes::uniform_liquid_bed(1);
  const double slip = scenes::carrying_velocity(scene) / scenes::voidage;
  const double critical =
      closures::critical_slope(1 - scenes::voidage, scene.species[0].density, scene.fluid.density.value(), slip);
  for (const double over_critical : {2.0, 10.0})
    for (const double length : {20e-3, 40e-3, 80e-3, 120e-3, 160e-3, 240e-3})
      small_wave(trial, length, over_critical * critical);
}

}  // namespace

std::vector<HardCase> wave_cases() {
  return {{"T7 grids",
           "growth of a wave on 16 to 256 cells, well-posed and not",
           {},
           {{"explicit", "limited", ""}, {"explicit", "upwind", ""}},
           on_five_grids},
          {"T8",
           "waves of 1e-6, six lengths, against linear theory",
           {"drag_explicit"},
           all_schemes(),
           small_waves,
           false}};
}

}  // namespace polybed::hard
