// Mean motion in a box whose ends are joined, the same for both models: what a law of drag or a stream is measured by.
#pragma once

#include <numeric>
#include <vector>

#include "measures/table.hpp"

namespace polybed::measures {

/// Means over the box along the height. Velocities are of volumes: sum phi_j U_j / sum phi_j.
struct BoxFlow {
  double gradient = 0;                ///< mean of the net pressure's, Pa/m
  double fluid = 0;                   ///< m/s
  std::vector<double> velocity = {};  ///< of each species, m/s; 0 without particles
  std::vector<double> fraction = {};  ///< of each species in the box
  double mass_velocity = 0;           ///< momentum over mass of fluid and solids, m/s
  double moved = 0;  ///< by which all particles and the fluid have been moved to keep the momentum, m/s

  /// Of the fluid less that of some species together, by volume; empty without any.
  [[nodiscard]] Value slip(Members members) const {
    double flux = 0, all = 0;
    for (const std::size_t j : members) {
      flux += fraction[j] * velocity[j];
      all += fraction[j];
    }
    return all > 0 ? Value(fluid - flux / all) : Value();
  }
  [[nodiscard]] double voidage() const {
    double eps = 1;
    for (const double phi : fraction) eps -= phi;
    return eps;
  }
};

/// The mean gradient, Pa/m, with which the net pressure carries all solids. \param gravity  along the height, m/s2
[[nodiscard]] inline double gradient_of_weight(const std::vector<double>& fraction, const std::vector<double>& density,
                                               double fluid_density, double gravity) {
  double gradient = 0;
  for (std::size_t j = 0; j < fraction.size(); ++j) gradient += fraction[j] * (density[j] - fluid_density) * gravity;
  return gradient;
}

/// Columns for a source with `box`. \param of_particles  or of a continuum, whose momentum needs no correction
template <class Source>
void add_box_flow(bool of_particles, Table<Source>& table) {
  table.push_back({"slip", "m_s",
                   "between joined ends in a fluid: mean velocity of the fluid less that of the species, upwards",
                   [](const Source& s, Members j) { return s.box.slip(j); }});
  table.push_back({"superficial_slip", "m_s",
                   "between joined ends in a fluid: mean voidage times the mean velocity of the fluid less that of all "
                   "solids by volume, the superficial velocity of the fluid as seen from the solids",
                   [](const Source& s) {
                     std::vector<std::size_t> all(s.box.fraction.size());
                     std::iota(all.begin(), all.end(), std::size_t(0));
                     const Value slip = s.box.slip(all);
                     return slip ? Value(s.box.voidage() * *slip) : Value();
                   }});
  table.push_back({"mass_velocity", "m_s",
                   "between joined ends in a fluid: momentum over mass of fluid and solids in the frame of the box: "
                   "without walls and with column.pressure_gradient = \"weight\" it stays 0",
                   [](const Source& s) { return s.box.mass_velocity; }});
  if (of_particles)
    table.push_back(
        {"frame_velocity", "m_s",
         "between joined ends in a fluid: velocity that everything has been given since the start to keep "
         "the momentum, as averages over particles are not exact; it moves nothing relative to anything else",
         [](const Source& s) { return s.box.moved; }});
  table.push_back({"pressure_gradient", "Pa_m",
                   "between joined ends in a fluid: mean gradient of the net pressure, negative upwards",
                   [](const Source& s) { return s.box.gradient; }});
}

}  // namespace polybed::measures
