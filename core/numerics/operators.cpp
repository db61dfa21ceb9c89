#include "core/numerics/operators.hpp"

#include "core/vectors.hpp"

namespace polybed::core {

namespace {

template <class Metric>
void divergence_loops(const Metric& metric, const Grid& grid, const FaceField& faces, Field& out) {
  for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a) {
    const Index s = grid.stride(int(a));
    const double per_length = 1 / grid.spacing[a];
    const double* f = faces[a].data();
    double* to = out.data();
    const auto through = [=](Index c) { return metric.open(a, c) * f[c]; };
    for_each_row(grid, [&](Index begin, Index end) {
      if (a == 0) {
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) to[c] = metric.per_volume(c) * per_length * (through(c + s) - through(c));
      } else {
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) to[c] += metric.per_volume(c) * per_length * (through(c + s) - through(c));
      }
    });
  }
}

}  // namespace

void divergence(const Grid& grid, const FaceField& faces, Field& out) {
  with_metric(grid, [&]<class Metric>(const Metric& metric) {
    in_vectors<divergence_loops<Metric>>(metric, grid, faces, out);
  });
}

}  // namespace polybed::core
