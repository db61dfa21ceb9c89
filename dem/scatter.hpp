// From particles to the fluid: their volumes in cells and what they answer on faces, T(2.9), as sums in whole units, so
// that they depend neither on the order of the particles nor on how many ranks share them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/ranks.hpp"
#include "dem/fluid_motion.hpp"
#include "dem/weights.hpp"
#include "fluid/particle_phase.hpp"

namespace polybed::dem {

class Scatter {
 public:
  /// \param grid  of the whole column  \param volume  of all particles, m3  \param speed  greatest expected, m/s
  Scatter(const core::Grid& grid, const Materials& materials, bool added_mass, double volume, double speed);

  /// Sums over this rank's particles. \param dt  of the fluid's step, s
  /// \param held  the particles do not move: a fixed bed
  void collect(const Particles& particles, const std::vector<FluidLoad>& loads, double dt, bool held);
  /// Collective: sums over all ranks, per volume of a cell. \param open_top  the faces at the top move
  void give(const core::Ranks* ranks, bool open_top, fluid::ParticlePhase& phase, std::vector<core::Field>& fraction);

 private:
  /// What stands on a face, in this order.
  enum Sum { volume, flux, impulse, drag, follow, slide, yield, carry, carry_flux };

  void add(const Place& place, const std::array<double, 6>& same, const Vector& velocity, const Vector& impulse,
           std::size_t species);
  void give_faces(bool open_top, fluid::ParticlePhase& phase) const;
  [[nodiscard]] std::int64_t* face(int axis, std::size_t at) {
    return sums_.data() + (std::size_t(axis) * grid_.padded_size() + at) * count_;
  }

  core::Grid grid_;
  Weights weights_;
  std::vector<Species> species_;
  std::size_t count_;               ///< sums on a face
  std::vector<FixedPoint> unit_;    ///< of each
  std::vector<std::int64_t> sums_;  ///< [axis][face][sum], then [species][cell]
};

}  // namespace polybed::dem
