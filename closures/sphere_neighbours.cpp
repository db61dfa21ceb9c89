#include "closures/sphere_neighbours.hpp"

#include <algorithm>

namespace polybed::closures {

SphereNeighbours::SphereNeighbours(std::span<const double> fraction, std::span<const double> diameter)
    : unit_(*std::max_element(diameter.begin(), diameter.end())) {
  double phi = 0;
  for (const double f : fraction) phi += f;
  const double held = phi > most_fraction ? most_fraction / phi : 1;
  Matrix4 moments = Matrix4::Zero();
  for (std::size_t j = 0; j < diameter.size(); ++j) {
    const Vector4 d = powers(diameter[j]);
    moments += held * fraction[j] / (std::numbers::pi / 6 * d[3]) * d * d.transpose();
  }
  const auto xi = [&](int n) { return std::numbers::pi / 6 * moments(n, 0); };
  const double z = 1 / (1 - xi(3)), z2 = z * z, x1 = xi(1), x2 = xi(2);
  Matrix4 a = Matrix4::Zero();
  a(0, 3) = a(3, 0) = z;
  a(1, 2) = a(2, 1) = 3 * z;
  a(1, 3) = a(3, 1) = 3 * x2 * z2;
  a(2, 2) = 9 * x2 * z2;
  a(2, 3) = a(3, 2) = 3 * x1 * z2 + 9 * x2 * x2 * z2 * z;
  a(3, 3) = xi(0) * z2 + 6 * x1 * x2 * z2 * z + 9 * x2 * x2 * x2 * z2 * z2;
  a *= std::numbers::pi / 6;
  response_ = a * (Matrix4::Identity() + moments * a).inverse();
}

}  // namespace polybed::closures
