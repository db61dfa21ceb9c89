// Site updates of resolved flow a second against the copy bandwidth of the same run: an update of a site moves 19
// populations in and out. Each round measures the copy and the flows one after the other, in processor time of this
// thread, so that other work on the machine disturbs the ratio less; medians of the ratios are printed.
//
//   build/tests/lbm_benchmark [sites per edge]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "multiscale/resolve/lattice/flow.hpp"
#include "tests/cost/lbm_boxes.hpp"

namespace {

using namespace polybed::multiscale::lattice;

constexpr int rounds = 15;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

template <class Work>
double seconds_of(const Work& work) {
  const double begin = processor_seconds();
  work();
  return processor_seconds() - begin;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Bytes a second, read and written, of copies of arrays of this size.
double copy_rate(std::size_t bytes, int copies) {
  static std::vector<float> from, to;
  from.resize(bytes / sizeof(float) / 2, 1);
  to.resize(from.size());
  const double seconds = seconds_of([&] {
    for (int n = 0; n < copies; ++n) {
      std::copy(from.begin(), from.end(), to.begin());
      from[std::size_t(n)] = to[std::size_t(n) + 1] + 1;
    }
  });
  return double(bytes) * copies / seconds;
}

template <class Real>
void measure(const char* name, int edge, double solids, bool inertia) {
  const FlowSetup setup{{edge, edge, edge}, 1.0 / 6, inertia, Wall::interpolated};
  Flow<Real> flow(setup, Spheres(jittered_spheres<Sphere>(edge, solids), setup.box));
  const double sites = double(edge) * edge * edge, moved = 2.0 * directions * sizeof(Real);
  const int steps = std::max(2, int(4e6 / sites));
  std::vector<double> rate, copied, part;
  for (int n = 0; n < rounds; ++n) {
    copied.push_back(copy_rate(std::size_t(sites * sizeof(Real) * directions), std::max(2, steps)));
    const double seconds = seconds_of([&] {
      for (int step = 0; step < steps; ++step) flow.advance({1e-6, 0, 0});
    });
    rate.push_back(2 * steps * sites / seconds);
    part.push_back(rate.back() * moved / copied.back());
  }
  fmt::print(
      "{:28} {:6.1f} million sites a second, {:5.1f} GB/s copied, part {:4.2f}; {:.2f} links a site, {:.0f} bytes\n",
      name, median(rate) / 1e6, median(copied) / 1e9, median(part), double(flow.links()) / sites,
      double(flow.memory_bytes()) / sites);
}

/// Net force over that of Stokes on a sphere of a simple cubic array, solids fraction 0.125, 18 sites an edge, as
/// palabos_flow.cpp has it.
double cubic_drag() {
  constexpr int edge = 18, steps = 4000;
  const double radius = edge * std::cbrt(3 * 0.125 / (4 * M_PI)), force = 1e-6, viscosity = 1.0 / 6;
  Flow<double> flow({{edge, edge, edge}, viscosity, true, Wall::half_way},
                    Spheres({{{edge / 2.0, edge / 2.0, edge / 2.0}, radius}}, {edge, edge, edge}));
  for (int step = 0; step < steps; step += 2) flow.advance({force, 0, 0});
  return force * std::pow(edge, 3) / (6 * M_PI * viscosity * radius * flow.velocity()[0]);
}

}  // namespace

int main(int count, char** words) {
  const int edge = count > 1 ? std::atoi(words[1]) : 96;
  if (edge < 12 || edge > 400) {
    fmt::print(stderr, "sites per edge: 12 to 400\n");
    return 2;
  }
  measure<float>("no spheres, single", edge, 0, true);
  measure<float>("no spheres, single, Stokes", edge, 0, false);
  measure<float>("voidage 0.9, single", edge, 0.1, true);
  measure<float>("voidage 0.5, single", edge, 0.5, true);
  measure<float>("voidage 0.5, single, Stokes", edge, 0.5, false);
  measure<double>("voidage 0.5, double", edge, 0.5, true);
  fmt::print("drag on a sphere of a simple cubic array, half-way walls: {:.4f}\n", cubic_drag());
}
