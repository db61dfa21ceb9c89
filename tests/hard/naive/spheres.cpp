#include "hard/naive/spheres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

namespace polybed::hard::naive {

using dem::Vector;

namespace {

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector sum(const Vector& a, const Vector& b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

}  // namespace

Spheres::Spheres(const std::string& name, const core::Scene& scene, const std::vector<scenes::Bead>& beads)
    : name_(name), scene_(scene), dt_(scene.dem.fixed_step.value()), force_(beads.size()), torque_(beads.size()) {
  static const std::set<std::string> known{"fixed_dt",  "lost_history", "one_wall",
                                           "one_image", "float_sums",   "nothing"};
  if (!known.contains(name)) throw std::invalid_argument("no textbook treatment of spheres called " + name);
  for (const scenes::Bead& b : beads) {
    const auto species = std::find_if(scene.species.begin(), scene.species.end(),
                                      [&](const core::Species& s) { return s.name == b.species; });
    const double r = 0.5 * species->diameter, mass = 4.0 / 3 * std::numbers::pi * r * r * r * species->density;
    place_.push_back({b.x, r});
    motion_.push_back({b.v, 1 / mass, b.w, 2.5 / (mass * r * r)});
    const double nu = species->poisson_ratio.value_or(scene.dem.poisson_ratio);
    modulus_.push_back(species->youngs_modulus.value_or(scene.dem.youngs_modulus.value_or(core::least_modulus)) /
                       (1 - nu * nu));
  }
  find_forces();
}

void Spheres::steps(std::int64_t number) {
  const double g = scene_.column.gravity;
  const auto kick = [&](std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) {
      motion_[i].v[k] += 0.5 * dt_ * (force_[i][k] * motion_[i].inverse_mass + g * scene_.column.down[k]);
      motion_[i].w[k] += 0.5 * dt_ * torque_[i][k] * motion_[i].inverse_inertia;
    }
  };
  for (std::int64_t n = 0; n < number; ++n) {
    for (std::size_t i = 0; i < place_.size(); ++i) {
      kick(i);
      place_[i].x = sum(place_[i].x, motion_[i].v, dt_);
    }
    constexpr int list_lasts = 50;
    if (name_ == "lost_history" && ++count_ % list_lasts == 0) memory_.clear();
    find_forces();
    for (std::size_t i = 0; i < place_.size(); ++i) kick(i);
  }
}

void Spheres::find_forces() {
  std::fill(force_.begin(), force_.end(), Vector{});
  std::fill(torque_.begin(), torque_.end(), Vector{});
  for (auto& [key, memory] : memory_) memory.seen = false;
  const bool sides = scene_.column.sides == core::Boundary::periodic,
             ends = scene_.column.ends == core::Boundary::periodic;
  const std::array<bool, 3> joined{sides, ends, sides};
  const bool nearest = name_ == "one_image";
  std::array<int, 3> reach{};
  for (std::size_t k = 0; k < 3; ++k) reach[k] = joined[k] && !nearest ? 1 : 0;
  for (std::size_t i = 0; i < place_.size(); ++i) {
    for (std::size_t j = i + 1; j < place_.size(); ++j) {
      Vector base{};
      for (std::size_t k = 0; k < 3; ++k)
        if (joined[k])
          base[k] = -scene_.column.size[k] * std::round((place_[j].x[k] - place_[i].x[k]) / scene_.column.size[k]);
      int key = 0;
      for (int a = -reach[0]; a <= reach[0]; ++a)
        for (int b = -reach[1]; b <= reach[1]; ++b)
          for (int c = -reach[2]; c <= reach[2]; ++c)
            add_pair(i, j, ++key,
                     {base[0] + a * scene_.column.size[0], base[1] + b * scene_.column.size[1],
                      base[2] + c * scene_.column.size[2]});
    }
    add_walls(i);
  }
  std::erase_if(memory_, [](const auto& entry) { return !entry.second.seen; });
}

void Spheres::add_pair(std::size_t i, std::size_t j, int key, const Vector& shift) {
  const Vector apart = sum(sum(place_[j].x, shift, 1), place_[i].x, -1);
  const double distance = std::sqrt(dot(apart, apart)), overlap = place_[i].radius + place_[j].radius - distance;
  if (overlap <= 0) return;
  act({i, j, {apart[0] / distance, apart[1] / distance, apart[2] / distance}, overlap}, key);
}

void Spheres::add_walls(std::size_t i) {
  const core::Column& c = scene_.column;
  std::vector<std::pair<Touch, int>> pressed;
  for (std::size_t k = 0; k < 3; ++k) {
    if ((k == 1 ? c.ends : c.sides) == core::Boundary::periodic) continue;
    for (const int side : {-1, 1}) {
      if (k == 1 && side > 0 && !c.closed) continue;  // the open top
      const double gap = side < 0 ? place_[i].x[k] : c.size[k] - place_[i].x[k];
      Touch touch{i, i, {}, place_[i].radius - gap};
      touch.normal[k] = side;
      // Beyond the wall there is none.
      if (touch.overlap > 0 && gap > -place_[i].radius) pressed.emplace_back(touch, int(2 * k) + (side > 0 ? 1 : 0));
    }
  }
  if (name_ == "one_wall" && pressed.size() > 1) {
    std::sort(pressed.begin(), pressed.end(),
              [](const auto& a, const auto& b) { return a.first.overlap > b.first.overlap; });
    pressed.resize(1);
  }
  for (const auto& [touch, key] : pressed) act(touch, key);
}

void Spheres::act(const Touch& touch, int key) {
  const std::size_t i = touch.first, j = touch.second;
  const bool wall = i == j;
  const double ri = place_[i].radius, rj = place_[j].radius;
  const double radius = wall ? ri : ri * rj / (ri + rj),
               mass = wall ? 1 / motion_[i].inverse_mass : 1 / (motion_[i].inverse_mass + motion_[j].inverse_mass);
  const double modulus = wall ? modulus_[i] : modulus_[i] * modulus_[j] / (modulus_[i] + modulus_[j]);
  const double root = std::sqrt(radius * touch.overlap), nu = scene_.species[0].poisson_ratio.value_or(0.25);
  Vector slip = motion_[i].v;
  const Vector spin_i = cross(motion_[i].w, touch.normal), spin_j = cross(motion_[j].w, touch.normal);
  slip = sum(slip, spin_i, ri);
  if (!wall) slip = sum(sum(slip, motion_[j].v, -1), spin_j, rj);
  const double approach = dot(slip, touch.normal), e = scene_.material.restitution;
  const double beta = -std::log(e) / std::hypot(std::log(e), std::numbers::pi);
  const double stiffness = 2 * modulus * root;
  const double push = std::max(0.0, 4.0 / 3 * modulus * root * touch.overlap +
                                        2 * std::sqrt(5.0 / 6) * beta * std::sqrt(stiffness * mass) * approach);
  slip = sum(slip, touch.normal, -approach);
  // Mindlin's 8 G* sqrt(R* delta) with G* = E* (1 - nu)/(2 - nu) for two bodies alike.
  const double shear = 4 * modulus * (1 - nu) / (2 - nu) * root;
  Memory& m = memory_[{int(i), wall ? -1 : int(j), key}];
  m.seen = true;
  const double kept = m.stiffness > shear ? shear / m.stiffness : 1;  // on unloading it is rescaled
  m.force = sum(m.force, touch.normal, -dot(m.force, touch.normal));
  for (double& f : m.force) f *= kept;
  m.force = sum(m.force, slip, -shear * dt_);
  m.stiffness = shear;
  const double most = scene_.material.friction * push, size = std::sqrt(dot(m.force, m.force));
  if (size > most)
    for (double& f : m.force) f *= most / size;
  const Vector force = sum(m.force, touch.normal, -push), torque = cross(touch.normal, m.force);
  add(i, force, {ri * torque[0], ri * torque[1], ri * torque[2]});
  if (!wall) add(j, {-force[0], -force[1], -force[2]}, {rj * torque[0], rj * torque[1], rj * torque[2]});
}

void Spheres::add(std::size_t i, const Vector& force, const Vector& torque) {
  for (std::size_t k = 0; k < 3; ++k) {
    force_[i][k] += force[k];
    torque_[i][k] += torque[k];
    if (name_ == "float_sums") force_[i][k] = double(float(force_[i][k]));
  }
}

}  // namespace polybed::hard::naive
