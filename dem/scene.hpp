// Data of the particle model from a scene: its box, gravity, units of force, skin and speeds.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/effects.hpp"

namespace polybed::dem {

/// Area of a part of an end or side, m2; from and to as for a feed.
[[nodiscard]] double area_of(core::ColumnFace at, const std::vector<double>& from, const std::vector<double>& to,
                             const core::Column& column);

/// The column as a box of particles. A 2-D column is periodic in its depth.
[[nodiscard]] Box box_of(const core::Scene& scene);
/// Its size and which sides are joined: the box without walls.
[[nodiscard]] Box bare_box_of(const core::Column& column);

/// Gravity, m/s2.
[[nodiscard]] Vector gravity_of(const core::Scene& scene);

/// Distance of surfaces, m, up to which the list must contain pairs: from the case, or a tenth of the least diameter.
[[nodiscard]] double skin_of(const core::Scene& scene, const Materials& materials);

/// Volume of particles, m3: of each species, and of all.
struct SolidsVolume {
  std::vector<double> of;
  double all = 0;
};
[[nodiscard]] SolidsVolume volume_of(const std::vector<Particle>& particles, std::size_t species);

/// Upper bound on all particles in a box: the range of sums over fed particles.
struct Content {
  double volume = 0, mass = 0;  ///< m3, kg
};
[[nodiscard]] Content greatest_content(const Box& box, const Materials& materials);
/// Whether particles enter the box. No if its ends are joined, even in a case with feeds.
[[nodiscard]] bool is_fed(const core::Scene& scene);
/// Whether particles leave through the top. No if the ends of the box are joined, nor from a fixed bed.
[[nodiscard]] bool is_open_at_top(const core::Scene& scene);

/// Expected speeds of particles, m/s.
struct Speeds {
  double impact = 0;    ///< in typical collisions
  double greatest = 0;  ///< of any particle, at least as high: for the time step
};

/// From the case; or from the shear or a fall, sqrt(v^2 + 2 g h) from the top of the starting bed with the greatest
/// initial or feed speed v (h is the height of the box if the start does not define a lower one, or if particles are
/// fed from the top), plus what a light particle gains from a heavy one. In a fluid both are at most twice the terminal
/// velocity of the fastest, or v, and the inflow, or four times the inflow's velocity between packed particles. 0 if
/// unknown.
/// \param start  the particles, or some as fast as any; places matter only for a list
[[nodiscard]] Speeds known_speeds(const core::Scene& scene, const Materials& materials, const Box& box,
                                  const std::vector<Particle>& start);

/// The same for a run: for particles at rest that nothing moves it is the speed that suits dem.fixed_step. Throws
/// core::CaseError if it is unknown.
[[nodiscard]] Speeds expected_speeds(const core::Scene& scene, const Materials& materials, const Box& box,
                                     const std::vector<Particle>& start);

/// Unit of forces: for the greatest allowed overlap, on as many contacts as fit around the largest particle. Includes
/// the dashpots of particles far too fast for their contacts. \param speed  expected, m/s
[[nodiscard]] FixedPoint force_unit(const core::Scene& scene, const Materials& materials, const PairLaws& laws,
                                    double speed = 0);
[[nodiscard]] FixedPoint torque_unit(const FixedPoint& force, const Materials& materials);

/// Why a particle could touch another and its image along an axis; empty if none can: joined sides need room for two of
/// the largest and twice the range. T: the thesis too, whose depth for system B is slightly too small.
/// \param greatest_diameter  m  \param reach  range of forces beyond contact, m
/// \param skin  of the list of neighbours, m: a sheared box needs room for it too, as its list has only one image
[[nodiscard]] std::string no_room_for_images(const Box& box, std::size_t axis, double greatest_diameter, double reach,
                                             double skin);

/// Message if the speed of the particles is unknown.
inline constexpr const char* unknown_speed =
    "dem.greatest_speed: without gravity, shear or particles that move nothing tells how fast they will be; give the "
    "greatest speed expected, which sets the time step";

}  // namespace polybed::dem
