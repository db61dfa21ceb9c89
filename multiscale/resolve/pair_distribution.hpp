// Pair distribution of spheres in a periodic cube, by pairs of species.
#pragma once

#include <cstddef>
#include <vector>

#include "core/case/scene.hpp"
#include "multiscale/resolve/lattice/obstacles.hpp"

namespace polybed::multiscale {

/// Shells of the distance r of two centres over the distance at contact, from 1 on: those inside a sphere of half the
/// edge, to 3 at most.
class PairDistribution {
 public:
  static constexpr double width = 0.1;  ///< of a shell

  /// \param radius  of each species; edge: of the cube, in the same unit; count: spheres of each species
  PairDistribution(std::vector<double> radius, std::vector<double> count, double edge);

  /// Adds the pairs at one time; pairs that overlap count as touching. \param species  of each sphere
  void add(const std::vector<lattice::Sphere>& spheres, const std::vector<std::size_t>& species);

  /// Mean of g_jk(r) in each shell: number of pairs over that of points placed at random. In the order 11, 12, ..., 22,
  /// ..., without pairs of which there are none; 0 before the first add().
  [[nodiscard]] std::vector<double> mean() const;

  /// Two species, from 0, and a shell.
  struct Shell {
    std::size_t j = 0, k = 0;
    double middle = 0;  ///< r over the distance at contact
  };
  /// In the order of mean().
  [[nodiscard]] std::vector<Shell> shells() const;

  void forget() { restore(std::vector<double>(number_.size() + 1, 0)); }
  /// Times and numbers of pairs so far.
  [[nodiscard]] std::vector<double> sums() const;
  void restore(const std::vector<double>& sums);

 private:
  /// Of two species: j at most k.
  struct Pair {
    std::size_t j = 0, k = 0, first = 0, shells = 0;  ///< first: of its shells
  };
  [[nodiscard]] std::size_t pair_of(std::size_t j, std::size_t k) const;

  std::vector<double> radius_, count_;
  double edge_, times_ = 0;
  std::vector<Pair> pairs_;
  std::vector<double> number_;  ///< by shell
};

/// For the boxes of a case, in m.
[[nodiscard]] PairDistribution pair_distribution(const core::Scene& scene, double voidage);

}  // namespace polybed::multiscale
