// Particles that enter the box through [[feed]]: their number, time and place, and totals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/arrivals.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/energy_sum.hpp"
#include "dem/feed_strip.hpp"
#include "dem/kept_part.hpp"
#include "dem/particles.hpp"
#include "fluid/inlet.hpp"

namespace polybed::dem {

class Decomposition;

/// By a time t a feed calls for as many particles as the volume that it has let in fills, rounded down: what is left
/// over counts on. A particle enters in the step in which it is called for, just inside the end, at the feed's velocity
/// and at a random place where it overlaps nothing; for a fluid its volume grows as if it came through the face at that
/// velocity. One that finds no place waits, and is tried again later. Feeds that
/// call for particles more often than the list of pairs has to be made for their speed let them in several at a time.
///
/// The same on every rank, and on any number of ranks to the bit: places depend on bed.seed, the feed and a number.
class Feeding final : public KeptPart {
 public:
  /// \param skin  of the list of pairs, m  \param count  of particles at the start, numbered from 0
  Feeding(const core::Scene& scene, const Materials& materials, const Box& box, double skin, std::int64_t count);

  std::vector<std::int64_t> number;  ///< of entered particles of each species, since the start
  std::int64_t steps = 0;            ///< step numbers at their entry, summed over them
  /// Their motion and gravity at entry, in the unit of energy.
  EnergySum energy;

  /// Ids continue after the last one.
  [[nodiscard]] std::int64_t next_id() const { return next_id_; }
  /// Particles of all species.
  [[nodiscard]] std::int64_t all() const;
  /// Number due by a time, for each species.
  [[nodiscard]] std::vector<std::int64_t> called_for(double t) const;
  /// Number without room when places were last drawn, for each species.
  [[nodiscard]] std::vector<std::int64_t> waiting() const;
  /// Warning about waiting particles; empty: none wait.
  [[nodiscard]] std::string warning() const;

  /// Whether a particle must enter at a time, s.
  [[nodiscard]] bool due(double t) const;
  /// Selects the particles that enter at a time, counts them, and returns their number. Collective.
  std::int64_t choose(const Model& model, double t);
  /// At a time that is not before that of the last call.
  [[nodiscard]] Arrivals arrivals(double t);
  /// At the time of the last call.
  [[nodiscard]] Arrivals arrivals() const;
  /// Adds the particles that enter in this rank's part of the box. \param decomposition  null: the rank has all of it
  void enter(Particles& particles, const Decomposition* decomposition, int rank);

  void write(core::Checkpoint& checkpoint, const Particles& particles, const core::Ranks* ranks) const override;
  void read(const Restored& from) override;

 private:
  struct Feed {
    std::int32_t species;
    core::ColumnFace at;
    double velocity;    ///< inwards, m/s
    double pause;       ///< least time between two entries, s
    fluid::Ramp rate;   ///< superficial velocity of the solids, m/s
    double per_height;  ///< particles in a volume of one metre height over the feed's area
    Vector low, high;   ///< of centres, m
    double curved;      ///< radius of the side that it lies in, m; 0: it is flat
    std::int64_t entered = 0;
    std::int64_t tries = 0;   ///< random places drawn so far
    double tried_at = never;  ///< time of the last draw, s

    [[nodiscard]] std::int64_t called_for(double t) const;
    [[nodiscard]] bool due(double t) const;
  };
  /// A particle that comes in.
  struct Coming {
    double since, radius, velocity;  ///< s, m, m/s
    core::ColumnFace at;
  };
  static constexpr double never = -1e30;
  [[nodiscard]] bool find_place(std::size_t n, const FeedStrip& strip, Place& place);

  const Materials& materials_;
  std::vector<Feed> feeds_;
  std::uint64_t seed_;
  std::int64_t next_id_;
  std::vector<Particle> entering_;
  std::vector<Coming> coming_;  ///< into a fluid, the last that have entered, in the order of their numbers
  double seen_at_ = 0;          ///< when arrivals() has last been asked, s
};

}  // namespace polybed::dem
