// What the hard cases of dry particles share: a product's run or a textbook's, and what a run that stops must say.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "hard/hard_case.hpp"
#include "hard/textbook.hpp"
#include "scenes/beads.hpp"

namespace polybed::hard {

using scenes::Bead;
using scenes::Beads;
using scenes::dry_box;

constexpr double radius = 0.5e-3, gravity = 9.81;
constexpr scenes::Material glass{5e6, 0.25, 2500};

/// Step that the product takes for a scene, s.
inline double own_step(const core::Scene& scene, const std::vector<Bead>& beads) { return Beads(scene, beads).dt(); }

/// Calls body(run) with the product's run of a scene, or with a textbook's, whose step is `step`.
template <class Body>
void with_run(const Trial& trial, core::Scene scene, const std::vector<Bead>& beads, double step, Body&& body) {
  if (!trial.naive()) {
    Beads run(scene, beads);
    return body(run);
  }
  scene.dem.fixed_step = step;
  body(*textbook::spheres(trial.treatment().naive, scene, beads));
}

inline double speed(const dem::Motion& m) { return std::hypot(m.v[0], m.v[1], m.v[2]); }

/// Whether a message names the first particle of a list, and a place.
inline bool names_particle_and_place(const std::string& text) {
  return text.find("particle 0 ") != std::string::npos && text.find(") m;") != std::string::npos;
}

/// A run that must stop: what it says names particles by their ids and places.
inline void stops_with_ids(Trial& trial, const core::Scene& scene, const std::vector<Bead>& beads, std::int64_t steps) {
  try {
    Beads run(scene, beads);
    run.steps(steps);
  } catch (const core::NumericsError& error) {
    trial.measure("V16 names particle and place", names_particle_and_place(error.what()) ? 0 : 1, 0);
    throw;
  }
}

/// Kinetic and rotational energy, J.
inline double kinetic(const dem::Motion& m) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += 0.5 * m.v[k] * m.v[k] / m.inverse_mass + 0.5 * m.w[k] * m.w[k] / m.inverse_inertia;
  return sum;
}

/// D9 to D15, in boxes: joined on all sides, or with walls that are only just touched or not at all.
[[nodiscard]] std::vector<HardCase> box_cases();

}  // namespace polybed::hard
