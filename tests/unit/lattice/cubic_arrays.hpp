// Cubic arrays of spheres, whose drag in Stokes flow is tabulated.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "multiscale/resolve/lattice/steady.hpp"

namespace polybed::multiscale::lattice {

enum class Cubic { simple, body_centred, face_centred };

/// Spheres of a solids fraction in a box of `cells` sites a side, `copies` unit cells along each edge; off the sites by
/// a fraction of a cell, so that no symmetry of the lattice helps.
inline std::vector<Sphere> cubic_array(Cubic kind, double solids, int cells, int copies = 1, double shift = 0.13) {
  std::vector<Point> basis{{0.25, 0.25, 0.25}};
  if (kind == Cubic::body_centred) basis.push_back({0.75, 0.75, 0.75});
  if (kind == Cubic::face_centred)
    basis.insert(basis.end(), {{0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}});
  const double edge = double(cells) / copies;
  const double radius = edge * std::cbrt(3 * solids / (4 * std::numbers::pi * double(basis.size())));
  std::vector<Sphere> spheres;
  for (int i = 0; i < copies; ++i)
    for (int j = 0; j < copies; ++j)
      for (int k = 0; k < copies; ++k)
        for (const Point& b : basis)
          spheres.push_back(
              {{(i + b[0]) * edge + shift, (j + b[1]) * edge + shift, (k + b[2]) * edge + shift}, radius});
  return spheres;
}

/// Net force on the spheres, the pressure gradient times the volume of the box, over that of Stokes on as many: what
/// Zick and Homsy tabulate as K.
inline double net_force(const std::vector<Sphere>& spheres, const FlowSetup& setup, const SteadyFlow& flow) {
  const double volume = double(setup.box[0]) * setup.box[1] * setup.box[2];
  const double speed = std::hypot(flow.velocity[0], flow.velocity[1], flow.velocity[2]);
  const double push = std::hypot(flow.driving[0], flow.driving[1], flow.driving[2]);
  return push * volume / (6 * std::numbers::pi * setup.viscosity * spheres[0].radius * speed * double(spheres.size()));
}

struct CubicFlow {
  SteadyFlow flow;
  double net = 0;
};

template <class Real = double>
CubicFlow flow_through(const std::vector<Sphere>& spheres, FlowSetup setup, const Point& velocity = {1e-3, 0, 0},
                       double tolerance = 1e-6) {
  Flow<Real> flow(setup, Spheres(spheres, setup.box));
  const SteadyFlow steady = run_until_steady(flow, {velocity, 100, tolerance, 50000});
  return {steady, net_force(spheres, setup, steady)};
}

}  // namespace polybed::multiscale::lattice
