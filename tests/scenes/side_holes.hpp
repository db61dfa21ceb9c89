// Columns with holes in their sides, flat or curved, and beads of 1 mm that meet them.
#pragma once

#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {

using core::ColumnFace;

inline constexpr double r = 0.5e-3, youngs_modulus = 5e6, poisson_ratio = 0.25, density = 2500, width = 0.02;

/// A box of 20 mm with a hole in a side, 6 mm wide and from 4 to 8 mm high.
inline core::Scene holed(ColumnFace at) {
  core::Scene scene = dry_box(r, {youngs_modulus, poisson_ratio, density}, {width, width, width});
  scene.discharges.push_back({at, {7e-3, 4e-3}, {13e-3, 8e-3}, {{0.0, 0.1}}});
  return scene;
}

/// A place: outward from a side, up, and along the side, m.
inline dem::Vector beside(ColumnFace at, double out, double up, double along) {
  const double across = side_of(at) == 0 ? -out : width + out;
  return axis_of(at) == 0 ? dem::Vector{across, up, along} : dem::Vector{along, up, across};
}

/// The force on a sphere at rest at a place, also outside: a list of particles knows none there.
inline dem::Vector force_at(const core::Scene& scene, const dem::Vector& x) {
  Beads beads(scene, {{"a", {0.01, 0.01, 0.01}}});
  core::Checkpoint there = beads.model.checkpoint();
  std::copy(x.begin(), x.end(), there.arrays.at("particles").begin() + 2);  // after id and species
  beads.model.start_from(there);
  return beads.force(0);
}

/// Water flows through a column from front to back, and carries a bead out.
inline core::Scene flushed(core::ColumnShape shape) {
  core::Scene scene = wet_box(2 * r, 1050, water, {12e-3, 12e-3, 12e-3}, {8, 8, 8});
  scene.column.shape = shape;
  scene.column.closed = false;
  scene.inlet.superficial_velocity = {{0.0, 0.0}};
  scene.jets.push_back({{3e-3, 3e-3}, {9e-3, 9e-3}, {{0.0, 0.3}}, ColumnFace::front});
  scene.discharges.push_back({ColumnFace::back, {3e-3, 3e-3}, {9e-3, 9e-3}, {{0.0, 0.3}}});
  return scene;
}

inline void expect_same_bits(const Beads& through, const Beads& again) {
  const core::Checkpoint one = through.model.checkpoint(), other = again.model.checkpoint();
  EXPECT_EQ(one.integers, other.integers);
  EXPECT_EQ(one.numbers, other.numbers);
  EXPECT_EQ(one.arrays, other.arrays);
}

}  // namespace polybed::scenes
