// From particles to the fluid: their volumes in cells and their responses on faces, T(2.9), as sums in whole units,
// which depend neither on the order of the particles nor on the number of ranks.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "dem/coupling/fluid_motion.hpp"
#include "dem/coupling/open_faces.hpp"
#include "dem/coupling/round_weights.hpp"
#include "dem/parallel/grid_exchange.hpp"
#include "fluid/particle_phase.hpp"

namespace polybed::dem {

class Scatter {
 public:
  /// \param grid  of the whole column  \param block  of this rank's fluid, or the column
  /// \param volume  of all particles, m3  \param speed  greatest expected, m/s
  Scatter(const core::Grid& grid, const core::Grid& block, const Materials& materials, bool added_mass, double volume,
          double speed);
  /// From here on particles pass the openings of a box or come in, and count as far as they are inside.
  void open(const Box& box) { open_.emplace(grid_, box); }
  /// Null: no particle passes a face.
  [[nodiscard]] OpenFaces* open_faces() { return open_ ? &*open_ : nullptr; }
  /// Null in a box.
  [[nodiscard]] const std::shared_ptr<const RoundWeights>& round() const { return round_; }

  /// Sums over this rank's particles. \param dt  of the fluid's step, s
  void collect(const Particles& particles, const std::vector<FluidLoad>& loads, double dt);
  /// The same for a fixed bed, whose particles receive drag and do not move. Collective.
  void collect_held(const core::Ranks* ranks, const Particles& particles, const std::vector<FluidLoad>& loads,
                    double dt);
  /// Collective: sums over all ranks, per open volume of a cell or of a face's momentum; faces closed by a round wall
  /// have no particles. \param open_top  the faces at the top move
  /// \param exchange  with the owners of the blocks; null: every rank has the whole column
  void give(const core::Ranks* ranks, const GridExchange* exchange, bool open_top, fluid::ParticlePhase& phase,
            std::vector<core::Field>& fraction);
  [[nodiscard]] const std::vector<Species>& species() const { return species_; }

 private:
  /// Sums on a face, in this order.
  enum Sum { volume, flux, impulse, drag, follow, slide, yield, carry, carry_flux };
  /// Number of vectors of four for a count.
  static constexpr std::size_t fours(std::size_t count) { return (count + 3) / 4; }

  void fit_units(const core::Ranks* ranks, const std::vector<FluidLoad>& loads, double dt);
  /// Contribution of one particle. `same` is for the faces of all axes: drag, follow, slide, yield, carry, carry_flux.
  struct Given {
    double volume;
    std::array<double, 6> same;
    Vector velocity, impulse;
    std::size_t species;
  };
  /// Shares of a particle: lines in a box, else round ones.
  template <bool round>
  [[nodiscard]] auto shares(const Vector& x) const {
    if constexpr (round)
      return (*round_)(x);
    else
      return weights_(x);
  }
  template <std::size_t count, bool open, bool round>
  static void add_moving(Scatter& sums, const Particles& particles, const std::vector<FluidLoad>& loads, double dt);
  template <std::size_t count, class Shares>
  void add(const Shares& shares, const Given& given);
  template <std::size_t count, bool round>
  void add_cut(const Place& place, std::int64_t id, Given given);
  template <class Act>
  void with_count(Act&& act) const;
  void add_up(const core::Ranks* ranks);
  void give_faces(std::span<const std::int64_t> sums, bool open_top, fluid::ParticlePhase& phase) const;

  core::Grid grid_, block_;
  Weights weights_;
  std::optional<OpenFaces> open_;  ///< absent: no particle passes a face
  std::vector<Species> species_;
  std::size_t count_;                          ///< number of sums on a face, which come first
  std::size_t of_axis_, width_;                ///< number of sums per axis, and over all axes and the cell of an entry
  std::vector<FixedPoint> unit_;               ///< for each sum
  std::vector<std::int64_t> sums_, shared_;    ///< [entry][axis, place; species]; for the column, and for a block
  std::shared_ptr<const RoundWeights> round_;  ///< null: weights_ are used
};

}  // namespace polybed::dem
