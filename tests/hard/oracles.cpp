// polybed-hard --oracles: numbers of the program that tests/unit/python/cost_test.py examines. How often the interval
// of a mean has the truth; a particle that settles, by both integrators, which must buy error with work at the rate of
// their order; and a bed of two layers, as cells and as particles counted into slabs.
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "closures/sphere.hpp"
#include "core/numerics/integrator.hpp"
#include "core/numerics/random.hpp"
#include "core/output/json.hpp"
#include "core/output/particles.hpp"
#include "core/print.hpp"
#include "hard/options.hpp"
#include "measures/bed.hpp"
#include "measures/bed_table.hpp"
#include "measures/time_mean.hpp"
#include "scenes/snapshot_profile.hpp"

namespace polybed::hard {

namespace {

/// Of autoregressive series of mean 0: in which share of them 0 is in the interval of the mean.
double coverage() {
  constexpr std::uint64_t series = 2000, rows = 2000, seed = 7;
  constexpr double rho = 0.9;
  double covered = 0;
  for (std::uint64_t n = 0; n < series; ++n) {
    std::vector<double> x{core::normal(seed, n, 0)};
    for (std::uint64_t k = 1; k < rows; ++k)
      x.push_back(rho * x.back() + std::sqrt(1 - rho * rho) * core::normal(seed, n, k));
    const measures::TimeMean mean = measures::time_mean(x).value();
    covered += std::abs(mean.mean) < mean.interval.value() ? 1 : 0;
  }
  return covered / double(series);
}

constexpr double acceleration = 6, terminal = 0.15, relaxation = terminal / acceleration;  // a bead of 1 mm in water

/// dv/dt = g' (1 - (v/u_t)^2), drag in proportion to v^2; from rest v = u_t tanh(g' t/u_t).
double rate_of(double v) { return acceleration * (1 - v * v / (terminal * terminal)); }

class Settling : public core::OdeProblem {
 public:
  core::Rate rates(double, std::span<const double> v, std::span<double> rate) override {
    rate[0] = rate_of(v[0]);
    return core::Rate::ok;
  }
};

class ImplicitSettling : public core::DaeProblem {
 public:
  core::Rate residual(double, std::span<const double> v, std::span<const double> dvdt, std::span<double> r) override {
    r[0] = dvdt[0] - rate_of(v[0]);
    return core::Rate::ok;
  }
  core::Rate setup(double, std::span<const double> v, std::span<const double>, std::span<const double>,
                   double cj) override {
    slope_ = cj + 2 * acceleration * v[0] / (terminal * terminal);
    return core::Rate::ok;
  }
  core::Rate precondition(double, std::span<const double> r, std::span<double> z, double, double) override {
    z[0] = r[0] / slope_;
    return core::Rate::ok;
  }

 private:
  double slope_ = 1;
};

/// The steps that an integrator takes and the relative error that it ends with.
core::Json settling_by(core::Integrator& integrator) {
  constexpr double until = relaxation;
  integrator.restart(0, std::vector<double>{0}, std::vector<double>{acceleration}, 0);
  const auto before = integrator.statistics().steps;
  for (double t = 0; t < until;) t = integrator.step(until).time;
  const double exact = terminal * std::tanh(until / relaxation);
  return {{"steps", integrator.statistics().steps - before}, {"error", std::abs(integrator.state()[0] / exact - 1)}};
}

core::Json settling() {
  core::Json by_explicit = core::Json::array(), by_implicit = core::Json::array();
  for (const int n : {8, 16, 32, 64}) {
    Settling problem;
    by_explicit.push_back(settling_by(*core::make_explicit(problem, {.atol = {1e-12}, .fixed_step = relaxation / n})));
  }
  for (const double rtol : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    ImplicitSettling problem;
    by_implicit.push_back(settling_by(
        *core::make_implicit(problem, {.rtol = rtol, .atol = {rtol * terminal}, .id = {1}, .linear_tolerance = 1e-3})));
  }
  return {{"explicit", by_explicit}, {"implicit", by_implicit}};
}

// Two layers of pure species, 0.6 below 60 mm and 0.3 above, in m.
constexpr double slab = 2e-3, height = 0.2, middle = 0.06, top = 0.16;

measures::Profile layers_in_cells() {
  measures::Profile cells{slab, std::vector(2, std::vector<double>(std::size_t(std::lround(height / slab)))), {}};
  for (std::size_t k = 0; k < cells.slabs(); ++k) {
    if (cells.centre(k) < middle) cells.fraction[0][k] = 0.6;
    if (cells.centre(k) > middle && cells.centre(k) < top) cells.fraction[1][k] = 0.3;
  }
  return cells;
}

/// Spheres on a vertical line, counted into slabs by their exact parts.
measures::Profile layers_counted() {
  constexpr double radius = 2e-4, side = 0.02;
  std::vector<std::int64_t> ids;
  std::vector<double> radii;
  std::vector<std::int32_t> species;
  std::vector<std::array<double, 3>> places, velocities;
  const auto fill = [&](double from, double to, double phi, std::int32_t kind) {
    const double volume = side * side * (to - from) * phi, each = closures::sphere_volume(radius);
    const auto count = std::size_t(std::lround(volume / each));
    for (std::size_t n = 0; n < count; ++n) {
      ids.push_back(std::int64_t(ids.size()));
      radii.push_back(radius);
      species.push_back(kind);
      places.push_back({0, from + (double(n) + 0.5) / double(count) * (to - from), 0});
      velocities.push_back({0, 0, 0});
    }
  };
  fill(0, middle, 0.6, 0);
  fill(middle, top, 0.3, 1);
  const core::ParticleSnapshot particles{ids, species, radii, places, velocities, velocities};
  return measures::particle_profile(particles, 2, {side * side, height, std::size_t(std::lround(height / slab))})
      .solids;
}

}  // namespace

core::ExitCode run_oracles() {
  const measures::Profile cells = layers_in_cells(), counted = layers_counted();
  core::Json measured = core::Json::object();
  for (const auto& one : singles(read_by(&measures::Readers::profile, measures::bed_table()), {"a", "b"}))
    measured[one.name] = {core::or_null(one.of({cells})), core::or_null(one.of({counted}))};
  core::print("{}\n",
              core::json_text({{"coverage", coverage()},
                               {"settling", settling()},
                               {"measures", measured},
                               {"composition", core::or_null(measures::composition_distance(counted, cells))}}));
  return core::ExitCode::done;
}

}  // namespace polybed::hard
