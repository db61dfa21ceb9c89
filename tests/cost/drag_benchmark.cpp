// What one evaluation of a drag law costs, derivative included, with and without its guard: alone, in batches of points
// of one size, and in batches of cells that hold a mixture of two and of four species.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "closures/drag.hpp"

namespace {

using namespace polybed::closures;

constexpr std::size_t points = 4096;

/// Voidages of 0.4 to 0.99 and Reynolds numbers of 0.1 to 400, as in a liquid-fluidised bed; the same in every run.
struct Inputs {
  std::vector<double> voidage, reynolds;
  Inputs() : voidage(points), reynolds(points) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> eps(0.4, 0.99), log_re(std::log(0.1), std::log(400.0));
    for (std::size_t n = 0; n < points; ++n) {
      voidage[n] = eps(random);
      reynolds[n] = std::exp(log_re(random));
    }
  }
};

/// One call for each point, the law chosen anew each time: what a script or a single particle pays.
void alone(benchmark::State& state, const std::string& name, Guard guard) {
  const DragLaw law = drag_law(name, guard);
  const Inputs in;
  GuardCount count;
  double f = 0, slope = 0;
  for (auto _ : state)
    for (std::size_t n = 0; n < points; ++n) {
      drag_of_points(law, {&in.voidage[n], 1}, {&in.reynolds[n], 1}, {&f, 1}, {&slope, 1}, count);
      benchmark::DoNotOptimize(f);
      benchmark::DoNotOptimize(slope);
    }
  state.SetItemsProcessed(state.iterations() * std::int64_t(points));
}

/// All points of one size in one call.
void points_at_once(benchmark::State& state, const std::string& name, Guard guard) {
  const DragLaw law = drag_law(name, guard);
  const Inputs in;
  std::vector<double> f(points), slope(points);
  GuardCount count;
  for (auto _ : state) {
    drag_of_points(law, in.voidage, in.reynolds, f, slope, count);
    benchmark::DoNotOptimize(f.data());
    benchmark::DoNotOptimize(slope.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(points));
}

/// All cells with a mixture in one call, as the solvers do for a row of cells; an item is the drag of one species in
/// one cell.
void cells_at_once(benchmark::State& state, const std::string& name, Guard guard, std::size_t species) {
  const DragLaw law = drag_law(name, guard);
  const Inputs in;
  std::vector<double> diameter(species);
  std::vector<std::vector<double>> share(species), slip(species), f(species, std::vector<double>(points));
  std::vector<const double*> share_at, slip_at;
  std::vector<double*> f_at;
  std::mt19937 random(12);
  std::uniform_real_distribution<double> part(0.1, 1);
  std::vector<double> sum(points, 0.0);
  for (std::size_t j = 0; j < species; ++j) {
    diameter[j] = 0.8e-3 * (1 + double(j) / 2);
    for (std::size_t c = 0; c < points; ++c) {
      share[j].push_back(part(random));
      sum[c] += share[j][c];
      slip[j].push_back(in.reynolds[c] * 1e-6 / diameter[j]);
    }
    slip_at.push_back(slip[j].data());
    f_at.push_back(f[j].data());
  }
  for (std::vector<double>& x : share) {
    for (std::size_t c = 0; c < points; ++c) x[c] /= sum[c];
    share_at.push_back(x.data());
  }
  GuardCount count;
  for (auto _ : state) {
    drag_of_cells(law, in.voidage, share_at, slip_at, diameter, 1000.0, 1e-3, f_at, count);
    benchmark::DoNotOptimize(f_at.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t(points * species));
}

}  // namespace

int main(int argc, char** argv) {
  for (const std::string& name : drag_law_names())
    for (const Guard guard : {Guard::on, Guard::off}) {
      if (name == "fand" && guard == Guard::off) continue;  // refuses the gaps between its regimes
      const std::string end = guard == Guard::on ? "" : "/bare";
      benchmark::RegisterBenchmark(("alone/" + name + end).c_str(), alone, name, guard);
      benchmark::RegisterBenchmark(("batch/" + name + "/1_species" + end).c_str(), points_at_once, name, guard);
      for (const std::size_t species : {2, 4})
        benchmark::RegisterBenchmark(("batch/" + name + "/" + std::to_string(species) + "_species" + end).c_str(),
                                     cells_at_once, name, guard, species);
    }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
