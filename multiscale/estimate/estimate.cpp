#include "multiscale/estimate/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/progress.hpp"
#include "core/timers.hpp"
#include "dem/model.hpp"
#include "multiscale/particle_requirements.hpp"
#include "multiscale/requirements.hpp"
#include "tfm/step_estimate.hpp"

namespace polybed::multiscale {

namespace {

/// Ratio of actual to predicted time: its middle, and the factor on either side that covers nine of ten runs.
struct Spread {
  double middle, factor;
};

TimeBand band_of(double seconds, const Spread& spread) {
  const double expected = seconds * spread.middle;
  return {expected / spread.factor, expected, expected * spread.factor};
}

/// Of the two-fluid model. What runs took over the cost of their steps (docs/record/cost.md): 0.2 to 1.3 with split
/// steps, which grow as the bed comes to rest, 0.2 to 8 with implicit ones, which start with many Newton iterations
/// and take longer steps until bubbles form; explicit ones took 0.4 to 2.6 in earlier runs. A probe measures the cost
/// and the length of the first steps, not of those in the expanded bed.
Spread tfm_spread(core::TfmIntegrator integrator) {
  using enum core::TfmIntegrator;
  if (integrator == implicit_steps) return {2, 6};
  return {integrator == split_steps ? 0.55 : 1, 2.6};
}
constexpr double probe_factor = 1.8;
/// Of the particles, with constants of this machine: dilute beds are up to four times as fast as the measured ones.
constexpr Spread dem_spread{1, 2.5};
/// Factor for constants measured on another machine.
constexpr double shipped_factor = 3;

Spread with_machine(Spread spread, const Machine& machine) {
  return {spread.middle, machine.measured ? spread.factor : std::max(spread.factor, shipped_factor)};
}

const char* basis_of(const Machine& machine) {
  return machine.measured ? "measurements of this machine"
                          : "another machine's speed: polybed estimate --machine measures yours in half a minute";
}

/// Ranks share the work except for their waiting times: parallel.md.
double wall_of(double cpu, int ranks) {
  constexpr double efficiency = 0.88;
  return ranks > 1 ? cpu / (ranks * efficiency) : cpu;
}

/// Adds a part that is known within a factor of 2. \param before  its part before the first step
TimeBand beyond(TimeBand band, double more, double before) {
  return {band.least + more / 2, band.expected + more, band.most + 2 * more, before};
}

double rows(double until, double every) { return every > 0 ? std::floor(until / every * (1 + 1e-9)) + 1 : 2; }

/// CPU seconds for output.
double output(const core::Scene& scene, const OutputSpeed& speed, double particles) {
  const double cells =
      scene.fluid.present() ? double(scene.column.cells[0]) * scene.column.cells[1] * scene.column.cells[2] : 0;
  return rows(scene.run.until, *scene.output.every) *
             (speed.stored + speed.stored_cell * cells + speed.stored_particle * particles) +
         rows(scene.run.until, *scene.output.history_every) *
             (speed.row + speed.row_cell * cells + speed.row_particle * particles);
}

/// CPU seconds before the first step of particles: the program's start, their places, and settling.
double before_particles(const core::Scene& scene, const Machine& machine, const ParticleRequirements& need) {
  const bool placed =
      scene.bed.start.kind != core::StartKind::list && scene.bed.start.kind != core::StartKind::checkpoint;
  return machine.start + (placed ? machine.placed_particle * double(need.count()) : 0) + need.before;
}

/// A run of the two-fluid model from the time of its steps.
TimeBand with_start(const TimeBand& steps, const core::Scene& scene, const Machine& machine) {
  return beyond(steps, machine.start + output(scene, machine.output, 0), machine.start);
}

/// A run of particles, likewise.
TimeBand with_start(const TimeBand& steps, const core::Scene& scene, const Machine& machine,
                    const ParticleRequirements& need) {
  const double before = before_particles(scene, machine, need);
  return beyond(steps, before + output(scene, machine.output, double(need.count())), before);
}

/// Bytes of report.html: text, curves, and for each stored time a map of every field and the places of the particles,
/// each part within its limit (python/polybed/report/beds.py). Measured on the templates, within a factor of 2.
double report_of(double stored, double cells, double particles, double species) {
  constexpr double text = 50e3, curves = 15e3, map_cell = 0.5, place = 8, most = 4e6;
  return text + curves * species + std::min(most, map_cell * stored * cells * (2 * species + 2)) +
         std::min(most, place * stored * particles);
}

/// Bytes of a run's files, from their contents: docs/reference/files.md.
double disk_of(const core::Scene& scene, double cells, double particles, double state, double steps) {
  const auto species = double(scene.species.size());
  const double dimensions = scene.column.dimensions;
  constexpr double file = 15e3, history_row = 220, step_row = 45, picture = 250e3, particle = 148;
  const double of_cell = 8 * (2 + species) + (1 + species) * (8 * dimensions + 12);
  const double of_slab = 8 * (3 + 3 * species);
  const double stored = rows(scene.run.until, *scene.output.every);
  double bytes = stored * (file + cells * of_cell + double(scene.column.even_layers()) * of_slab);
  if (particles > 0) bytes += stored * (file + particle * particles);
  bytes += rows(scene.run.until, *scene.output.history_every) * history_row + 2 * state + picture;
  bytes += report_of(stored, cells, particles, species);
  return bytes + (particles > 0 ? 0 : steps * step_row);
}

int cores() { return std::max(1, int(std::thread::hardware_concurrency())); }

/// Runs the case for some CPU seconds. Returns the cost of a simulated second in the second half, and the time reached.
template <class Model>
std::pair<double, double> probed(Model& model, double until, double seconds) {
  const double begin = core::cpu_seconds();
  double half_time = 0, half_spent = 0, spent = 0;
  while (model.time() < until && spent < seconds) {
    model.step(until);
    spent = core::cpu_seconds() - begin;
    if (spent < seconds / 2) {
      half_time = model.time();
      half_spent = spent;
    }
  }
  const double covered = std::min(model.time(), until);
  return {(spent - half_spent) / std::max(covered - half_time, 1e-300), covered};
}

/// A band from a probe: the covered part is known, the rest continues at the predicted rate.
TimeBand probed_band(double covered, double until, double spent, double rest) {
  const double left = 1 - covered / until, factor = 1 + (probe_factor - 1) * left;
  return band_of(spent + rest * left, {1, factor});
}

}  // namespace

TimeBand TimeBand::part(double share, bool from_start) const {
  const double before = from_start ? start : 0;
  return {(least - start / 2) * share + before / 2, (expected - start) * share + before,
          (most - 2 * start) * share + 2 * before, before};
}

TimeBand tfm_time(const core::Scene& scene, const tfm::Model& model, const Machine& machine) {
  const double cells = double(scene.column.cells[0]) * scene.column.cells[1] * scene.column.cells[2];
  const double step = tfm_step_seconds(machine, model.integrator_kind() == core::TfmIntegrator::implicit_steps, cells,
                                       scene.species.size(), scene.column.dimensions);
  return with_start(band_of(expected_of(scene, model, step).time->computing(),
                            with_machine(tfm_spread(model.integrator_kind()), machine)),
                    scene, machine);
}

TimeBand tfm_time(const core::Scene& scene, const tfm::Model& model, const Machine& machine, double seconds_per_step) {
  return tfm_time(scene, expected_of(scene, model, seconds_per_step), machine);
}

TimeBand tfm_time(const core::Scene& scene, const Requirements& need, const Machine& machine) {
  return with_start(band_of(need.time.value().computing(), tfm_spread(need.integrator)), scene, machine);
}

TimeBand dem_time(const core::Scene& scene, const Machine& machine) {
  const ParticleRequirements need = particle_requirements_of(scene, machine.particles);
  return with_start(band_of(need.expected - need.before, with_machine(dem_spread, machine)), scene, machine, need);
}

CostEstimate estimate_tfm(const core::Scene& scene, const Machine& machine, double probe, int ranks) {
  core::Timers timers;
  std::unique_ptr<tfm::Model> part;
  const Requirements need = requirements_of(scene, timers, part);
  CostEstimate e;
  e.model = "tfm";
  e.ranks = ranks;
  e.memory = need.memory.total() + (ranks - 1) * need.memory.program;
  if (need.time) {
    e.time = tfm_time(scene, need, machine);
    e.steps = need.time->steps;
    e.basis = "time scales of the bed, and a few steps timed on a part of it";
  } else {
    e.time = tfm_time(scene, *part, machine);
    e.steps = expected_of(scene, *part, 0).time->steps;
    e.basis = basis_of(machine);
  }
  e.step = scene.run.until / e.steps;
  const auto& scales = need.expanded.scales;
  const auto shortest = std::min_element(scales.begin(), scales.end(),
                                         [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  const bool by_accuracy = need.integrator == core::TfmIntegrator::implicit_steps ||
                           (shortest != scales.end() && e.step < 0.99 * tfm::explicit_step(scales));
  e.limited_by = by_accuracy                ? fmt::format("the relative tolerance, tfm.rtol = {:.2g}", scene.tfm.rtol)
                 : shortest != scales.end() ? shortest->process
                                            : "accuracy";
  if (probe > 0) {
    const double begin = core::cpu_seconds();
    tfm::Model model(scene, timers);
    const auto [rate, covered] = probed(model, scene.run.until, probe);
    e.time = with_start(probed_band(covered, scene.run.until, core::cpu_seconds() - begin, rate * scene.run.until),
                        scene, machine);
    e.basis = fmt::format("a probe of {:.3g} s that reached {:.3g} s", probe, covered);
  }
  e.wall = wall_of(e.time.expected, ranks);
  e.disk = disk_of(scene, double(need.cells), 0, need.memory.state / 8, e.steps);
  e.ways = tfm_ways(scene, need.integrator == core::TfmIntegrator::implicit_steps, ranks, cores());
  return e;
}

CostEstimate estimate_dem(const core::Scene& scene, const Machine& machine, double probe, int ranks) {
  const ParticleRequirements need = particle_requirements_of(scene, machine.particles);
  CostEstimate e;
  e.model = "dem";
  e.ranks = ranks;
  e.memory = need.memory() + (ranks - 1) * need.program;
  e.time = dem_time(scene, machine);
  e.basis = basis_of(machine);
  e.steps = need.steps;
  e.step = need.limits.dt;
  e.limited_by = need.limits.limited_by;
  if (probe > 0) {
    const double begin = core::cpu_seconds();
    core::Timers timers;
    dem::Model model(scene, timers);
    const double placed = core::cpu_seconds() - begin;
    const auto [rate, covered] = probed(model, scene.run.until, probe);
    const double spent = core::cpu_seconds() - begin - placed, before = machine.start + placed + need.before;
    e.time = beyond(probed_band(covered, scene.run.until, spent, rate * scene.run.until),
                    before + output(scene, machine.output, double(need.count())), before);
    e.basis = fmt::format("a probe of {:.3g} s that reached {:.3g} s", probe, covered);
  }
  e.wall = wall_of(e.time.expected, ranks);
  const auto particles = double(need.count());
  e.disk = disk_of(scene, need.fluid ? double(need.fluid->cells) : 0, particles, 200 * particles, e.steps);
  e.ways = dem_ways(scene, e.limited_by, ranks, cores());
  return e;
}

}  // namespace polybed::multiscale
