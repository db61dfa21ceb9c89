// A box of spheres that move freely through resolved flow, under drag, weight, contacts and films. Weight acts along
// -x; the mean pressure gradient that balances it acts on liquid and spheres alike: the total force on the box is zero.
#pragma once

#include <vector>

#include "core/timers.hpp"
#include "dem/model.hpp"
#include "multiscale/resolve/box_drag.hpp"
#include "multiscale/resolve/lattice/flow.hpp"
#include "multiscale/resolve/pair_distribution.hpp"

namespace polybed::multiscale {

template <class Real>
class FreeBox {
 public:
  FreeBox(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing);

  /// Two steps of the fluid, with the motion of the spheres.
  void step();
  /// Sets the walls to the spheres' positions and motions.
  void let_walls_follow();
  /// Resets the mean density and rebuilds the list of neighbours, as a resumed box does: both then have the same bits.
  void begin_window();
  /// Adds the present velocities and places to the means.
  void sample();
  /// Means of the samples and forces since forget().
  [[nodiscard]] BoxDrag means() const;
  void forget() {
    sums_ = Sums(sums_.of.size());
    pairs_.forget();
  }

  /// Along x, in lattice units: of liquid and spheres together; the sum of the magnitudes over the spheres.
  struct Momentum {
    double all = 0, of_spheres = 0;
  };
  [[nodiscard]] Momentum momentum() const;
  [[nodiscard]] core::Checkpoint state() const;
  void restore(const core::Checkpoint& state);

  [[nodiscard]] const BoxPlan& plan() const { return plan_; }
  [[nodiscard]] lattice::Flow<Real>& flow() { return flow_; }
  [[nodiscard]] dem::Model& spheres() { return spheres_; }

 private:
  /// A sphere of a species, in lattice units.
  struct Body {
    double radius = 0, volume = 0, mass = 0, inertia = 0, weight = 0;  ///< weight minus buoyancy in the liquid at rest
  };
  struct OfSpecies {
    double slip = 0, force = 0, along = 0, across = 0;
  };
  struct Sums {
    double samples = 0, steps = 0, push = 0;
    std::vector<OfSpecies> of;
    explicit Sums(std::size_t species) : of(species) {}
  };

  [[nodiscard]] const Body& body(std::size_t i) const { return bodies_[std::size_t(spheres_.particles().species[i])]; }
  [[nodiscard]] double push() const;
  void kick_spheres();
  void move_spheres();

  double voidage_;
  BoxPlan plan_;
  std::vector<Body> bodies_;
  std::vector<double> count_;  ///< spheres of each species
  core::Timers timers_;
  int substeps_;  ///< steps of the spheres per two of the fluid
  dem::Model spheres_;
  lattice::Flow<Real> flow_;
  Sums sums_;
  PairDistribution pairs_;
};

/// Means over the last two thirds of the simulated time. Throws as box_drag().
[[nodiscard]] BoxDrag free_box(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                               const StillWanted& wanted, const KeptBox* kept);

}  // namespace polybed::multiscale
