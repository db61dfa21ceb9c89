// What the particle model reads from a scene: its box, gravity, units of force, skin and speeds.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/effects.hpp"

namespace polybed::dem {

/// The column as a box of particles. A 2-D column is periodic in its depth.
[[nodiscard]] Box box_of(const core::Scene& scene);
/// Its size and which sides are joined: the box without walls.
[[nodiscard]] Box bare_box_of(const core::Column& column);

/// m/s2.
[[nodiscard]] Vector gravity_of(const core::Scene& scene);

/// m, how much nearer than contact two surfaces may be before the list of pairs must know them: as the case gives it,
/// or a tenth of the least diameter.
[[nodiscard]] double skin_of(const core::Scene& scene, const Materials& materials);

/// Volume of particles, m3: of each species, and of all.
struct SolidsVolume {
  std::vector<double> of;
  double all = 0;
};
[[nodiscard]] SolidsVolume volume_of(const std::vector<Particle>& particles, std::size_t species);

/// More than any particles in a box take: what sums over particles that are fed have room for.
struct Content {
  double volume = 0, mass = 0;  ///< m3, kg
};
[[nodiscard]] Content greatest_content(const Box& box, const Materials& materials);
/// Whether particles enter the box. One whose ends are joined, made from a case that is fed, has none.
[[nodiscard]] bool is_fed(const core::Scene& scene);
/// Whether particles leave through the top. In a box whose ends are joined they do not, nor does a fixed bed.
[[nodiscard]] bool is_open_at_top(const core::Scene& scene);

/// What particles are expected to reach, m/s.
struct Speeds {
  double impact = 0;    ///< at which many meet others
  double greatest = 0;  ///< of any, at least that: what the step is made for
};

/// As the case gives it; or that of the shear or of a fall, sqrt(v^2 + 2 g h) from the top of the bed as it starts with
/// the greatest speed v there or of a feed (h is the height of the box where the start does not tell more, or where
/// particles are fed from the top), and what the heaviest pass on to the lightest when they meet so. In a fluid both
/// are at most twice the terminal velocity of the fastest, or v, and the inflow, or four times what the inflow becomes
/// between packed particles. 0 if nothing tells it.
/// \param start  the particles, or some as fast as any; the places matter of a list alone
[[nodiscard]] Speeds known_speeds(const core::Scene& scene, const Materials& materials, const Box& box,
                                  const std::vector<Particle>& start);

/// The same for a run: of particles at rest that nothing moves it is what dem.fixed_step is made for. Throws
/// core::CaseError if nothing tells it.
[[nodiscard]] Speeds expected_speeds(const core::Scene& scene, const Materials& materials, const Box& box,
                                     const std::vector<Particle>& start);

/// Unit of forces: at the overlap allowed, on as many contacts as the largest particle has room for. The dashpots of
/// particles far too fast for their contacts take part. \param speed  expected, m/s
[[nodiscard]] FixedPoint force_unit(const core::Scene& scene, const Materials& materials, const PairLaws& laws,
                                    double speed = 0);
[[nodiscard]] FixedPoint torque_unit(const FixedPoint& force, const Materials& materials);

/// Why a particle could touch another and its image along an axis; empty if none can: joined sides need room for two of
/// the largest and twice the reach. T: so does the thesis, whose depth for system B is too small by a hair.
/// \param greatest_diameter  m  \param reach  of forces beyond contact, m
/// \param skin  of the list of neighbours, m: a sheared box needs room for it, too, as its list has but one image
[[nodiscard]] std::string no_room_for_images(const Box& box, std::size_t axis, double greatest_diameter, double reach,
                                             double skin);

/// What is said where nothing tells the speed of the particles.
inline constexpr const char* unknown_speed =
    "dem.greatest_speed: without gravity, shear or particles that move nothing tells how fast they will be; give the "
    "greatest speed expected, which sets the time step";

}  // namespace polybed::dem
