// The boxes of resolved flow that programs are timed with.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

/// Spheres of ten cells on a jittered lattice: about this many links and gaps a random packing of that voidage has.
/// \tparam Sphere  an aggregate of a centre and a radius, in cells
template <class Sphere>
std::vector<Sphere> jittered_spheres(int edge, double solids) {
  std::vector<Sphere> made;
  if (solids == 0) return made;
  const int across = std::max(1, int(edge / (10 * std::cbrt(0.5236 / solids))));
  const double pitch = double(edge) / across, radius = pitch * std::cbrt(3 * solids / (4 * M_PI));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.1 * pitch, 0.1 * pitch);
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k)
        made.push_back({{(i + 0.5) * pitch + jitter(random), (j + 0.5) * pitch + jitter(random),
                         (k + 0.5) * pitch + jitter(random)},
                        radius});
  return made;
}
