// Obstacles that move through the fluid: walls with a velocity, sites that become covered and uncovered.
#include <algorithm>
#include <cmath>
#include <utility>

#include "multiscale/resolve/lattice/flow.hpp"

namespace polybed::multiscale::lattice {

namespace {

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point along(std::size_t way) { return {double(ways[way][0]), double(ways[way][1]), double(ways[way][2])}; }

void add(const Point& b, double times, Point& a) {
  for (std::size_t k = 0; k < 3; ++k) a[k] += times * b[k];
}

/// Velocity of a rigid body at an arm from its centre.
Point velocity_of(const Motion& motion, const Point& arm) {
  Point u = cross(motion.spin, arm);
  add(motion.velocity, 1, u);
  return u;
}

/// Equilibrium at a velocity and the density at rest, as in collide_row.
double equilibrium(std::size_t way, const Point& u, bool inertia) {
  const double c = dot(along(way), u);
  return weight(way) * (3 * c + (inertia ? 4.5 * c * c - 1.5 * dot(u, u) : 0.0));
}

}  // namespace

template <class Real>
void Flow<Real>::set_velocity(const Point& velocity) {
  for (std::size_t way = 0; way < directions; ++way)
    std::fill_n(&populations_[place(way, 0)], sites_.count(), Real(equilibrium(way, velocity, setup_.inertia)));
}

/// A wall with velocity u lowers the returning population by 2 w c.u/c_s^2 half-way (Ladd, J. Fluid Mech. 271 (1994)
/// 285), and by 4/(1 + 2q) w c.u/c_s^2 interpolated (Ginzburg et al. 2008): 6 (1 + part) w c.u with the link's `part`.
template <class Real>
void Flow<Real>::set_motion(const std::vector<Motion>& motion) {
  torque_.resize(motion.size());
  moving_links_.resize(links_.size());
  for (const Bundle& bundle : bundles_) {
    const auto way = std::size_t(bundle.way);
    const Motion& body = motion[std::size_t(bundle.owner)];
    const Point c = along(way);
    for (std::size_t n = bundle.begin; n < bundle.end; ++n) {
      const double part = double(links_[n].part), whole = 6 * (1 + part), beyond = 1 - 0.5 * (1 - part) / (1 + part);
      const std::size_t covered = links_[n].here - way * stride_ + std::size_t(sites_.step(ways[way]));
      Point arm = sites_.from(body.centre, covered);
      add(c, -beyond, arm);
      const Point lever = cross(arm, c);
      moving_links_[n] = {Real(-whole * weight(way) * dot(c, velocity_of(body, arm))),
                          {Real(lever[0]), Real(lever[1]), Real(lever[2])}};
    }
  }
}

/// After the bounce, which leaves the departed population of a link in place.
template <class Real>
void Flow<Real>::push_walls(bool second) {
  Real* const f = populations_.data();
  for (const Bundle& bundle : bundles_) {
    const auto owner = std::size_t(bundle.owner);
    double sent = 0;
    for (std::size_t n = bundle.begin; n < bundle.end; ++n) {
      const Link& link = links_[n];
      const MovingLink& wall = moving_links_[n];
      Real& back = f[second ? link.fluid : link.covered];
      back += wall.sent;
      sent += double(wall.sent);
      const double impulse = double(f[second ? link.covered : link.fluid]) + double(back);
      for (std::size_t k = 0; k < 3; ++k) torque_[owner][k] += double(wall.torque[k]) * impulse;
    }
    add(along(std::size_t(bundle.way)), sent, on_obstacle_[owner]);
    add(along(std::size_t(bundle.way)), sent, on_all_);
  }
}

template <class Real>
void Flow<Real>::move_to(const Obstacles& obstacles, const std::vector<Motion>& motion) {
  torque_.resize(motion.size());
  const std::vector<std::int32_t> before = std::exchange(owner_, obstacles.owners(sites_));
  for (std::size_t site = 0; site < owner_.size(); ++site) {
    const bool was = before[site] != Obstacles::none, is = owner_[site] != Obstacles::none;
    if (was == is || !sites_.in_box(sites_.place(site))) continue;
    if (is)
      cover(site, owner_[site], motion[std::size_t(owner_[site])]);
    else
      uncover(site, before[site], motion[std::size_t(before[site])], before);
  }
  find_runs();
  find_links(obstacles);
  set_motion(motion);
}

template <class Real>
void Flow<Real>::cover(std::size_t site, std::int32_t by, const Motion& motion) {
  const Point given = momentum_at(site);
  add(given, 1, on_obstacle_[std::size_t(by)]);
  add(cross(sites_.from(motion.centre, site), given), 1, torque_[std::size_t(by)]);
}

/// Equilibrium at the velocity of the wall, with density and non-equilibrium part from the outermost neighbour that was
/// and is fluid: at rest if there is none.
template <class Real>
void Flow<Real>::uncover(std::size_t site, std::int32_t by, const Motion& motion,
                         const std::vector<std::int32_t>& before) {
  const Point arm = sites_.from(motion.centre, site), u = velocity_of(motion, arm);
  const std::array<int, 3> here = sites_.place(site);
  std::size_t like = site;
  double farthest = 0;
  for (std::size_t way = 1; way < directions; ++way) {
    std::array<int, 3> next;
    for (std::size_t k = 0; k < 3; ++k) next[k] = (here[k] - 1 + ways[way][k] + sites_.box[k]) % sites_.box[k] + 1;
    const std::size_t neighbour = sites_.at(next[0], next[1], next[2]);
    const double outwards = dot(along(way), arm) / std::sqrt(dot(along(way), along(way)));
    if (before[neighbour] != Obstacles::none || owner_[neighbour] != Obstacles::none || outwards <= farthest) continue;
    like = neighbour;
    farthest = outwards;
  }
  Point there = momentum_at(like);
  add(force_, 0.5, there);
  for (std::size_t way = 0; way < directions; ++way) {
    const double other =
        like == site ? 0 : double(populations_[place(way, like)]) - equilibrium(way, there, setup_.inertia);
    populations_[place(way, site)] = Real(equilibrium(way, u, setup_.inertia) + other);
  }
  const Point taken = momentum_at(site);
  add(taken, -1, on_obstacle_[std::size_t(by)]);
  add(cross(arm, taken), -1, torque_[std::size_t(by)]);
}

template <class Real>
std::vector<Impulse> Flow<Real>::impulses() const {
  std::vector<Impulse> impulses;
  for (std::size_t n = 0; n < torque_.size(); ++n) impulses.push_back({on_obstacle_[n], torque_[n]});
  return impulses;
}

template <class Real>
void Flow<Real>::restore_impulses(const std::vector<Impulse>& impulses) {
  for (std::size_t n = 0; n < impulses.size(); ++n) {
    on_obstacle_.at(n) = impulses[n].force;
    torque_.at(n) = impulses[n].torque;
  }
}

template void Flow<float>::set_velocity(const Point&);
template void Flow<double>::set_velocity(const Point&);
template void Flow<float>::set_motion(const std::vector<Motion>&);
template void Flow<double>::set_motion(const std::vector<Motion>&);
template void Flow<float>::push_walls(bool);
template void Flow<double>::push_walls(bool);
template void Flow<float>::move_to(const Obstacles&, const std::vector<Motion>&);
template void Flow<double>::move_to(const Obstacles&, const std::vector<Motion>&);
template void Flow<float>::cover(std::size_t, std::int32_t, const Motion&);
template void Flow<double>::cover(std::size_t, std::int32_t, const Motion&);
template void Flow<float>::uncover(std::size_t, std::int32_t, const Motion&, const std::vector<std::int32_t>&);
template void Flow<double>::uncover(std::size_t, std::int32_t, const Motion&, const std::vector<std::int32_t>&);
template std::vector<Impulse> Flow<float>::impulses() const;
template std::vector<Impulse> Flow<double>::impulses() const;
template void Flow<float>::restore_impulses(const std::vector<Impulse>&);
template void Flow<double>::restore_impulses(const std::vector<Impulse>&);

}  // namespace polybed::multiscale::lattice
