// Finds touching pairs and fills batches with the input of the contact laws.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem/box.hpp"
#include "dem/contacts/batch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class ContactLoader {
 public:
  /// \param reach  range of the longest pair effect beyond contact, m
  ContactLoader(const Box& box, const Materials& materials, double reach);

  /// Fills a batch with pairs within their range, from index p of the list to before another. Returns the index at
  /// which to continue.
  std::int32_t find_pairs(const Particles& particles, const Contacts& contacts, const Images& images, std::int32_t p,
                          std::int32_t end, ContactBatch& batch) const;
  std::int32_t find_walls(const Particles& particles, const Contacts& contacts, std::int32_t p,
                          ContactBatch& batch) const;

  /// Loads the rest, once the batch has its pairs and, for particles, their distances.
  void load_pairs(const Particles& particles, const Contacts& contacts, const Images& images,
                  ContactBatch& batch) const;
  void load_walls(const Particles& particles, const Contacts& contacts, ContactBatch& batch) const;

  /// The same for the pairs that touched at the last force, from one of them on, for observers.
  void load_touching_pairs(const Particles& particles, const Contacts& contacts, const Images& images,
                           std::size_t begin, ContactBatch& batch) const;
  void load_touching_walls(const Particles& particles, const Contacts& contacts, std::size_t begin,
                           ContactBatch& batch) const;

 private:
  struct Kind {
    double first, second;  ///< radii, m
    double near;           ///< square of the distance at which they begin to act, m2
  };
  /// Distance of a centre from a flat wall, positive inside the box, m.
  [[nodiscard]] double height_over(std::int32_t wall, const Place& place) const;
  /// Vector to a centre from the nearest point on a face with an opening, or on a plate; nothing for a whole face.
  [[nodiscard]] std::optional<Vector> from_nearest(std::int32_t wall, const Vector& centre) const;
  /// The same for a box that is not plain: these walls return the distance from that point, never negative.
  [[nodiscard]] double distance_from(std::int32_t wall, const Place& place) const;
  template <class Distance>
  [[nodiscard]] std::int32_t find_walls_by(const Distance& distance, const Particles& particles,
                                           const Contacts& contacts, std::int32_t p, ContactBatch& batch) const;
  void turn_to_nearest(const Particles& particles, ContactBatch& batch) const;

  const Box& box_;
  double reach_;
  std::vector<Kind> kinds_;
};

}  // namespace polybed::dem
