// A fluid of density 1 that flows through a periodic box of obstacles; lengths in cells, time in steps.
//
// One array of populations serves two steps (Bailey et al., ICPP 2009): the first collides each site in its own place
// and leaves what departs along i in the place of the opposite direction; the second reads from the neighbours, and
// writes to them. A covered site passes on what departs towards it, from `links`.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "multiscale/resolve/lattice/collision.hpp"
#include "multiscale/resolve/lattice/halo.hpp"
#include "multiscale/resolve/lattice/obstacles.hpp"

namespace polybed::multiscale::lattice {

enum class Wall {
  half_way,     ///< bounce-back: momentum and mass exact
  interpolated  ///< central and linear, by where the surface cuts the link (CLI of Ginzburg et al., Commun. Comput.
                ///< Phys. 3 (2008) 427): in a steady state independent of the viscosity, as half_way is
};

/// Of an obstacle that moves, as a rigid body.
struct Motion {
  Point centre{}, velocity{}, spin{};
};

/// Impulses of force on an obstacle and of torque about its centre.
struct Impulse {
  Point force{}, torque{};
};

struct FlowSetup {
  std::array<int, 3> box{};  ///< sites
  double viscosity = 1.0 / 6;
  bool inertia = false;  ///< else Stokes flow
  Wall wall = Wall::half_way;
};

template <class Real>
class Flow {
 public:
  /// A fluid at rest. Throws core::CaseError if the box is too large.
  Flow(const FlowSetup& setup, const Obstacles& obstacles);

  /// The fluid moves as a whole: the start of a flow whose walls move with it, or with most of it.
  void set_velocity(const Point& velocity);
  /// Two steps under a force on each site of the fluid.
  void advance(const Point& force);

  /// Force on each obstacle, mean since forget_forces(), without what the pressure that drives the flow adds.
  [[nodiscard]] std::vector<Point> forces() const;
  void forget_forces();
  /// Since forget_forces(), where obstacles move.
  [[nodiscard]] std::vector<Impulse> impulses() const;
  void restore_impulses(const std::vector<Impulse>& impulses);

  /// Walls move from now on, each with its obstacle, while their places stay: enough for Stokes flow.
  void set_motion(const std::vector<Motion>& motion);
  /// The obstacles have moved, by less than a cell: walls are found anew. What the fluid loses by a site that is
  /// covered, and gains by one that is uncovered, is an impulse on the obstacle: with it momentum is exact.
  void move_to(const Obstacles& obstacles, const std::vector<Motion>& motion);
  /// Sum over all obstacles, mean of the last two steps.
  [[nodiscard]] Point force() const;
  /// Mean velocity over the whole box, obstacles counted with 0: the superficial velocity.
  [[nodiscard]] Point velocity() const;
  [[nodiscard]] Point velocity_at(int i, int j, int k) const;
  /// Subtracts the mean density: interpolated walls do not conserve mass to round-off.
  void level_density();

  /// Populations along one direction at the sites of the box, in C order. Those of all directions and the force of
  /// the last steps are the flow, to the bit.
  [[nodiscard]] std::vector<double> populations(std::size_t way) const;
  [[nodiscard]] const Point& last_force() const { return force_; }
  void restore_populations(std::size_t way, const std::vector<double>& populations);
  void restore_last_force(const Point& force) { force_ = force; }

  [[nodiscard]] const Sites& sites() const { return sites_; }
  /// Sites of fluid in the box; links that are cut.
  [[nodiscard]] double fluid_sites() const { return fluid_sites_; }
  [[nodiscard]] std::size_t links() const { return links_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  /// Places in the array of populations, and what of each bounces.
  struct Link {
    std::uint32_t fluid, covered;  ///< where what departs to the obstacle stands after the first step; after the second
    std::uint32_t here, behind;    ///< between what it is interpolated
    Real part;                     ///< of their difference
  };
  /// Links of one obstacle along one way, one after the other: their impulses have one direction and one sum.
  struct Bundle {
    std::uint32_t begin, end;
    std::int32_t way, owner;
  };
  struct Span {
    std::size_t begin = 0, end = 0;
  };
  /// Of the sites at one x: runs, and bundles of links that stay clear of the layer round the box.
  struct Layer {
    Span runs, bundles;
  };
  struct Run {
    std::uint32_t begin, length;
  };

  /// Of a link to a wall that moves.
  struct MovingLink {
    Real sent;                   ///< what the motion adds to what comes back
    std::array<Real, 3> torque;  ///< per impulse
  };

  [[nodiscard]] std::size_t place(std::size_t i, std::size_t site) const { return i * stride_ + site; }
  void find_runs();
  void find_links(const Obstacles& obstacles);
  [[nodiscard]] Link link_of(const Obstacles& obstacles, const std::array<int, 3>& at, std::size_t way) const;
  [[nodiscard]] Point momentum_at(std::size_t site) const;
  void cover(std::size_t site, std::int32_t by, const Motion& motion);
  void uncover(std::size_t site, std::int32_t by, const Motion& motion, const std::vector<std::int32_t>& before);
  void push_walls(bool second);
  void collide(bool second, const Span& runs);
  void collide_and_bounce(bool second);
  void bounce(bool second, const Span& bundles);

  FlowSetup setup_;
  Sites sites_;
  std::vector<std::int32_t> owner_;
  std::size_t stride_ = 0;
  double fluid_sites_ = 0;
  std::vector<Real> populations_;
  std::vector<Run> runs_;
  std::vector<Link> links_;
  std::vector<Bundle> bundles_;
  std::vector<Layer> layers_;             ///< by x, from 0
  Span rim_;                              ///< the other bundles
  std::vector<MovingLink> moving_links_;  ///< of each link; empty where obstacles are at rest
  std::vector<Point> on_obstacle_;        ///< sums over the steps taken since
  std::vector<Point> torque_;             ///< likewise; empty where obstacles are at rest
  std::int64_t steps_ = 0;
  Point on_all_{};  ///< of the last two steps
  Point force_{};   ///< of the last steps, on a site
  Halo<Real> halo_;
};

extern template class Flow<float>;
extern template class Flow<double>;

}  // namespace polybed::multiscale::lattice
