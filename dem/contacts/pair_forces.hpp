// Forces between touching particles and on walls: find touching pairs, gather a batch, apply each law to it, scatter.
#pragma once

#include <cstdint>

#include "dem/box.hpp"
#include "dem/contacts/batch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/loader.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/effects.hpp"
#include "dem/joined_work.hpp"
#include "dem/ledger.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// An error in a pair: found after the loop, so that the loop has no branch for it.
struct PairTrouble {
  double excess = 0;       ///< m, greatest excess over the allowed overlap; above 0 the run must stop
  std::int32_t pair = -1;  ///< in its list
  bool wall = false;
};

class PairForces {
 public:
  /// \param max_overlap  greatest overlap allowed, as a share of the smaller diameter
  PairForces(const Box& box, const Materials& materials, const PairLaws& laws, FixedPoint force, FixedPoint torque,
             double max_overlap);
  /// Counts energies in a ledger from now on; it must outlive this.
  void keep(Ledger& ledger) { ledger_ = &ledger; }
  /// Likewise the work of a sheared box, in addition to a ledger.
  void keep(JoinedWork& work) { joined_work_ = &work; }

  // Adds forces and torques of all pairs in a list to their particles' loads and advances their memory: first for pairs
  // that need no ghost, then, once the ghosts are there, for the others.
  // \param images  present ones, with the numbers in the list  \param dt  s, since the last call
  void add_inner_pairs(Particles& particles, Contacts& contacts, const Images& images, double dt);
  void add_outer_pairs(Particles& particles, Contacts& contacts, const Images& images, double dt);
  /// The same for the walls.
  void add_walls(Particles& particles, Contacts& contacts, double dt);

  [[nodiscard]] const PairTrouble& trouble() const { return trouble_; }
  [[nodiscard]] std::uint64_t pair_checks() const { return pair_checks_; }
  [[nodiscard]] std::uint64_t contact_steps() const { return contact_steps_; }

  /// The loader of batches, for code that inspects single contacts.
  [[nodiscard]] const ContactLoader& loader() const { return loader_; }

 private:
  void add_pairs(Particles& particles, Contacts& contacts, const Images& images, std::size_t begin, std::size_t end,
                 double dt);
  void act(double dt, bool wall);
  void add_film(double dt, bool wall);
  void treat(const Particles& particles, Contacts& contacts, bool wall, double dt);
  void mark_counted(std::size_t owned);
  void watch_overlap(bool wall);

  ContactLoader loader_;
  const PairLaws& laws_;
  FixedPoint force_, torque_;
  double max_overlap_;
  Ledger* ledger_ = nullptr;           ///< null: energies are not counted
  JoinedWork* joined_work_ = nullptr;  ///< null: the box is not sheared, or energies are not counted
  ContactBatch batch_;
  alignas(64) ContactBatch::Row counted_ = {};  ///< in the ledger: 1, or 0 for pairs that another rank counts
  PairTrouble trouble_;
  std::uint64_t pair_checks_ = 0, contact_steps_ = 0;
};

}  // namespace polybed::dem
