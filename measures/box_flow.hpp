// Mean motion in a box whose ends are joined, the same for both models: what a law of drag or a stream is measured by.
#pragma once

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

  /// Of some species together, by volume; 0 without any.
  [[nodiscard]] double of_solids(Members members) const {
    double flux = 0, all = 0;
    for (const std::size_t j : members) {
      flux += fraction[j] * velocity[j];
      all += fraction[j];
    }
    return all > 0 ? flux / all : 0;
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
                   [](const Source& s, Members j) { return s.box.fluid - s.box.of_solids(j); }});
  table.push_back({"superficial_slip", "m_s",
                   "likewise, mean voidage times the mean velocity of the fluid less that of all solids by volume: the "
                   "superficial velocity of the fluid as seen from the solids",
                   [](const Source& s) {
                     std::vector<std::size_t> all(s.box.fraction.size());
                     for (std::size_t j = 0; j < all.size(); ++j) all[j] = j;
                     return s.box.voidage() * (s.box.fluid - s.box.of_solids(all));
                   }});
  table.push_back({"mass_velocity", "m_s",
                   "likewise, momentum over mass of fluid and solids in the frame of the box: without walls and with "
                   "column.pressure_gradient = \"weight\" it stays 0",
                   [](const Source& s) { return s.box.mass_velocity; }});
  if (of_particles)
    table.push_back({"frame_velocity", "m_s",
                     "likewise, velocity that everything has been given since the start to keep the momentum, as "
                     "averages over particles are not exact; it moves nothing relative to anything else",
                     [](const Source& s) { return s.box.moved; }});
  table.push_back({"pressure_gradient", "Pa_m", "likewise, mean gradient of the net pressure, negative upwards",
                   [](const Source& s) { return s.box.gradient; }});
}

}  // namespace polybed::measures
