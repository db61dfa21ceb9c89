#include "core/numerics/operators.hpp"

#include "core/vectors.hpp"

namespace polybed::core {

namespace {

void divergence_loops(const Grid& grid, const FaceField& faces, Field& out) {
  for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a) {
    const Index s = grid.stride(int(a));
    const double per_length = 1 / grid.spacing[a];
    const double* f = faces[a].data();
    double* to = out.data();
    for_each_row(grid, [&](Index begin, Index end) {
      if (a == 0) {
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) to[c] = per_length * (f[c + s] - f[c]);
      } else {
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) to[c] += per_length * (f[c + s] - f[c]);
      }
    });
  }
}

}  // namespace

void divergence(const Grid& grid, const FaceField& faces, Field& out) {
  in_vectors<divergence_loops>(grid, faces, out);
}

}  // namespace polybed::core
