// Flow of a fluid of density 1 through a periodic box of obstacles; lengths in cells, time in steps.
//
// One array of populations serves two steps (Bailey et al., ICPP 2009): the first collides each site in place and
// stores the departing population along i at the opposite direction; the second reads from the neighbours and writes to
// them. A covered site returns populations that depart towards it, by `links`.
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
  interpolated  ///< central and linear, from the surface's position on the link (CLI of Ginzburg et al., Commun.
                ///< Comput. Phys. 3 (2008) 427): independent of the viscosity in a steady state, like half_way
};

/// Rigid-body motion of an obstacle.
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

  /// Sets a uniform velocity: the start of a flow whose walls, or most of them, move with it.
  void set_velocity(const Point& velocity);
  /// Two steps with a force on each site of the fluid.
  void advance(const Point& force);

  /// Mean force on each obstacle since forget_forces(), without the effect of the driving pressure.
  [[nodiscard]] std::vector<Point> forces() const;
  void forget_forces();
  /// Since forget_forces(), for moving obstacles.
  [[nodiscard]] std::vector<Impulse> impulses() const;
  void restore_impulses(const std::vector<Impulse>& impulses);

  /// Lets each wall move with its obstacle from now on, at fixed positions: sufficient for Stokes flow.
  void set_motion(const std::vector<Motion>& motion);
  /// Moves the obstacles by less than a cell and rebuilds the walls. Momentum that the fluid loses at newly covered
  /// sites and gains at uncovered ones is an impulse on the obstacle: total momentum is then exact.
  void move_to(const Obstacles& obstacles, const std::vector<Motion>& motion);
  /// Sum over all obstacles, mean over the last two steps.
  [[nodiscard]] Point force() const;
  /// Mean velocity over the whole box, obstacles counted with 0: the superficial velocity.
  [[nodiscard]] Point velocity() const;
  [[nodiscard]] Point velocity_at(int i, int j, int k) const;
  /// Subtracts the mean density: interpolated walls do not conserve mass to round-off.
  void level_density();

  /// Populations along one direction at the sites of the box, in C order. The flow consists of those for all directions
  /// and the force in the last steps, to the bit.
  [[nodiscard]] std::vector<double> populations(std::size_t way) const;
  [[nodiscard]] const Point& last_force() const { return force_; }
  void restore_populations(std::size_t way, const std::vector<double>& populations);
  void restore_last_force(const Point& force) { force_ = force; }

  [[nodiscard]] const Sites& sites() const { return sites_; }
  /// Fluid sites in the box; links cut by surfaces.
  [[nodiscard]] double fluid_sites() const { return fluid_sites_; }
  [[nodiscard]] std::size_t links() const { return links_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  /// Indices in the array of populations, and the bounced part.
  struct Link {
    std::uint32_t fluid, covered;  ///< departing population towards the obstacle after the first step; after the second
    std::uint32_t here, behind;    ///< ends of the interpolation
    Real part;                     ///< share of their difference
  };
  /// Links of one obstacle along one way, one after the other: their impulses have one direction and one sum.
  struct Bundle {
    std::uint32_t begin, end;
    std::int32_t way, owner;
  };
  struct Span {
    std::size_t begin = 0, end = 0;
  };
  /// For the sites at one x: runs, and bundles of links that stay clear of the layer around the box.
  struct Layer {
    Span runs, bundles;
  };
  struct Run {
    std::uint32_t begin, length;
  };

  /// Data for a link to a moving wall.
  struct MovingLink {
    Real sent;                   ///< part of the returning population from the motion
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
  std::vector<MovingLink> moving_links_;  ///< for each link; empty for obstacles at rest
  std::vector<Point> on_obstacle_;        ///< sums over the steps since then
  std::vector<Point> torque_;             ///< likewise; empty for obstacles at rest
  std::int64_t steps_ = 0;
  Point on_all_{};  ///< over the last two steps
  Point force_{};   ///< in the last steps, per site
  Halo<Real> halo_;
};

extern template class Flow<float>;
extern template class Flow<double>;

}  // namespace polybed::multiscale::lattice
