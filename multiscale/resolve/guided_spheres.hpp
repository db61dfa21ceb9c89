// Spheres whose species move at given velocities. Those that meet push each other aside.
#pragma once

#include <vector>

#include "multiscale/resolve/lattice/flow.hpp"
#include "multiscale/resolve/lattice/obstacles.hpp"

namespace polybed::multiscale {

/// In cells and steps, in a periodic cube. Contacts act as between spheres without inertia in a viscous fluid: they
/// move two spheres apart along the line of their centres, the larger one less by the ratio of diameters. The mean
/// velocity of a species stays exact: its spheres are shifted together. The contact force itself is not computed.
class GuidedSpheres {
 public:
  /// \param species   of each sphere  \param velocity  of each species, below half a cell a step
  GuidedSpheres(std::vector<lattice::Sphere> spheres, std::vector<std::size_t> species,
                std::vector<lattice::Point> velocity, double edge);

  /// Two steps of the fluid. Throws core::NumericsError if spheres cannot pass each other.
  void move();
  /// Centres now, and velocities until the next move().
  [[nodiscard]] const std::vector<lattice::Sphere>& spheres() const { return spheres_; }
  [[nodiscard]] const std::vector<lattice::Motion>& motion() const { return motion_; }
  void restore(const std::vector<lattice::Point>& centres);

  /// Impulse along x on each sphere from the unresolved films until the next move().
  [[nodiscard]] std::vector<double> film_impulses(double viscosity, double resolved, double roughness) const;

 private:
  struct Pair {
    std::size_t m, n;
  };
  [[nodiscard]] std::vector<Pair> pairs_within(double gap) const;
  /// From the centre of n to the nearest image of m.
  [[nodiscard]] lattice::Point between(const lattice::Point& m, const lattice::Point& n) const;
  /// Greatest overlap before it.
  [[nodiscard]] double push_apart(const std::vector<Pair>& pairs, std::vector<lattice::Point>& centre) const;
  void keep_means(const std::vector<lattice::Point>& aimed, std::vector<lattice::Point>& centre) const;
  void find_motion();

  std::vector<lattice::Sphere> spheres_;
  std::vector<lattice::Motion> motion_;
  std::vector<std::size_t> species_;
  std::vector<lattice::Point> velocity_;
  std::vector<double> count_;
  double edge_;
};

}  // namespace polybed::multiscale
