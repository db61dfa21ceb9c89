// Exchange of particles between ranks: migration, and copies of particles near another's part (ghosts).
//
// The thesis keeps three lists on every process: its own particles, those of its neighbours that it needs, and forces
// for others to add. The first two are the owned particles and the ghosts here. The third is not needed: a pair across
// ranks is computed on both, from the same numbers to the same bits.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/numerics/messages.hpp"
#include "core/numerics/ranks.hpp"
#include "dem/contacts/kept.hpp"
#include "dem/coupling/kept_loads.hpp"
#include "dem/effects/side_rows.hpp"
#include "dem/parallel/decomposition.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class Exchange {
 public:
  /// \param reach  m: particles with nearer surfaces can touch before the next choice of ghosts
  Exchange(const Box& box, std::shared_ptr<const core::Ranks> ranks, double reach, double greatest_radius);

  // All of these are collective and do nothing without ranks.

  /// Sends particles to the ranks that own their places, with their contacts. No ghosts before or after.
  void migrate(Particles& particles, KeptContacts& kept);
  /// Sends data of particles, in their order, to the ranks that own their places: call it before they migrate.
  void send_ahead(const Particles& particles, std::vector<KeptLoad>& kept);
  /// Likewise; does nothing without data.
  void send_ahead(const Particles& particles, KeptRows& kept);
  /// \param reach  as in the constructor, from the next choice of ghosts on
  void set_reach(double reach) { reach_ = reach; }
  /// Sends copies of particles to ranks whose parts they are near, and adds those received as ghosts.
  void choose_ghosts(Particles& particles);
  /// Starts to send the ghosts' present places and motions to other ranks. Until receive_ghosts() the owned particles
  /// can be read and their loads changed, but ghosts must not be used.
  void send_ghosts(const Particles& particles);
  /// Sets places and motions of the ghosts to their owners'.
  void receive_ghosts(Particles& particles);
  /// Divides the box again if the ranks' work differs too much; particles must then migrate. At most at every tenth
  /// call, since some work cannot be divided. \param work  of each owned particle
  void balance(const Particles& particles, std::span<const std::int32_t> work);

  /// Cuts since the start, and the greatest over the mean work of the ranks at the last call of balance().
  [[nodiscard]] std::uint64_t cuts() const { return cuts_; }
  [[nodiscard]] double imbalance() const { return imbalance_; }

  [[nodiscard]] Decomposition& decomposition() { return decomposition_; }
  [[nodiscard]] const Decomposition& decomposition() const { return decomposition_; }

 private:
  struct Refresh {
    Vector x, v, w;
  };
  [[nodiscard]] bool near(const Place& place, const Part& part) const;
  [[nodiscard]] bool near(const Part& one, const Part& other) const;

  const Box& box_;
  std::shared_ptr<const core::Ranks> ranks_;
  double reach_, greatest_radius_;
  Decomposition decomposition_;
  std::uint64_t cuts_ = 0;
  double imbalance_ = 1;
  int since_cut_ = 0;               ///< calls of balance()
  std::vector<std::int32_t> sent_;  ///< owned particles that are ghosts elsewhere, in the order of ranks
  std::unique_ptr<core::Messages> ghosts_;
  std::vector<Refresh> outgoing_, incoming_;
};

}  // namespace polybed::dem
