// Finds the pairs that can touch before the next rebuild: a search in cells by levels of size, whose cost hardly
// depends on the ratio of sizes.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "dem/box.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class NeighbourSearch {
 public:
  /// \param reach, wall_reach  as in set_reach
  NeighbourSearch(const Box& box, const Materials& materials, double reach, double wall_reach);
  /// \param reach  skin plus range of the longest pair effect, m: nearer pairs are listed
  /// \param wall_reach  the same for walls
  void set_reach(double reach, double wall_reach);

  /// Pairs with at least one owned particle whose surfaces are within the reach; the first has the lower id. Pairs that
  /// need no ghost come first. In a box less than twice that distance across, a pair can be listed with several images
  /// of the second: the nearest one first, then the others.
  /// \param centre  of the space of these particles: in directions in which they do not fill the box, images are taken
  /// near it   \param whole  directions in which they do
  void find_pairs(const Particles& particles, double time, const Vector& centre, const std::array<bool, 3>& whole,
                  Contacts& contacts);
  /// Pairs of owned particles and walls, likewise.
  void find_walls(const Particles& particles, std::vector<Contacts::Pair>& pairs) const;

  /// Number of pairs checked in the last search.
  [[nodiscard]] std::uint64_t candidates() const { return candidates_; }
  /// An order of the particles in which neighbours are close together.
  [[nodiscard]] std::vector<std::int32_t> order(const Particles& particles) const;

 private:
  /// Cells of one size, with the particles that fit them but are too large for a finer level.
  struct Level {
    double cell = 0;  ///< minimum, m
    Vector low{}, inverse{};
    std::array<int, 3> count{};
    std::array<bool, 3> wraps{};
    std::vector<std::int32_t> start, member;
    std::vector<std::int32_t> next;      ///< of each particle: the member behind it
    std::vector<Place> place_of_member;  ///< contiguous, as cells are read

    [[nodiscard]] int place(double x, std::size_t axis) const;
    /// Whether no cell lies on both sides of another.
    [[nodiscard]] bool roomy() const {
      for (std::size_t k = 0; k < 3; ++k)
        if (wraps[k] && count[k] < 3) return false;
      return true;
    }
  };
  [[nodiscard]] std::size_t level_of(double radius) const;
  void lay_out(const std::array<bool, 3>& whole);
  void sort_in(const Particles& particles);
  void release();
  void search(const Particles& particles, std::size_t i, std::size_t level, const Images& images,
              std::vector<Contacts::Pair>& pairs);

  [[nodiscard]] bool may_be_near(const Place& here, const Place& there) const;
  void add_if_near(const Particles& particles, std::size_t i, std::size_t j, const Place& there, const Images& images,
                   std::vector<Contacts::Pair>& pairs) const;

  const Box& box_;
  const Materials& materials_;
  double reach_ = 0, wall_reach_ = 0;
  static constexpr double far_away = std::numeric_limits<double>::infinity();
  double narrowest_ = far_away;                  ///< extent of the box where it is joined, m
  Vector period_{far_away, far_away, far_away};  ///< m
  std::vector<Level> levels_;                    ///< from the smallest particles to the largest
  std::vector<Vector> near_;                     ///< positions, with images taken near the centre
  std::uint64_t candidates_ = 0;
};

}  // namespace polybed::dem
