// The shares of a particle in the surrounding cells and faces, in a round column or between walls inside.
//
//   share of entry e = w_e g_e / sum(w g)
//
// w are the shares of Weights; those on closed entries count for open ones near them. g is fitted once: particles
// spread evenly over the column fill the open volume V of every entry evenly. g = V alone would fill small cut cells
// half, and the cells next to them a seventh too much. V of a face is the volume of its momentum. Faces of open cells
// that the wall closes have their share, and keep it at rest, as faces on the walls of a box do. Beside walls inside
// the entry that takes a share lies on the particle's side of the wall.
//
// If the diameter is constant, all layers are alike and have one g. A round column has it for a quarter and its mirror
// images; walls inside are anywhere.
#pragma once

#include <memory>
#include <vector>

#include "core/numerics/inner_walls.hpp"
#include "dem/coupling/weights.hpp"

namespace polybed::dem {

/// Entries around a place, with their shares. Some can be the same.
struct EntryShares {
  std::array<core::Index, 8> at;
  std::array<double, 8> w;
};

/// Weights of cells, or of faces of one axis.
class EntryWeights {
 public:
  /// \param grid  of the whole column  \param of  axis of the faces; -1: cells
  EntryWeights(const core::Grid& grid, int of);

  [[nodiscard]] EntryShares operator()(const Vector& x) const {
    const Around around = find(x);
    EntryShares shares;
    double sum = 0;
    for (std::size_t n = 0; n < 8; ++n) {
      const Entry& entry = entries_[around.entry[n]];
      shares.at[n] = entry.at + around.lift[n / 4];
      shares.w[n] = around.w[n] * entry.weight;
      sum += shares.w[n];
    }
    for (double& w : shares.w) w /= sum;
    return shares;
  }

 private:
  struct Around {
    std::array<std::size_t, 8> entry;
    std::array<double, 8> w;
    std::array<core::Index, 2> lift;  ///< of both layers, if all have one g
  };
  /// The target of an entry's share: itself or an open one near it.
  struct Entry {
    std::size_t taker;
    core::Index at;    ///< of the taker in a field; if all layers are alike, in the first
    double weight;     ///< g of the taker
    int corners = -1;  ///< place in corners_; -1: the taker is the same on all sides
  };
  [[nodiscard]] Around find(const Vector& x) const {
    std::array<std::array<std::size_t, 2>, 3> at;
    std::array<std::array<double, 2>, 3> w;
    for (std::size_t a = 0; a < 3; ++a) {
      const double cells = a == 1 && graded_ ? in_layers(*graded_, x[1]) : x[a] * per_spacing_[a];
      const double place = cells - offset_[a], below = std::floor(place);
      w[a] = {1 - (place - below), place - below};
      for (int n = 0; n < 2; ++n) at[a][std::size_t(n)] = std::size_t(std::clamp(int(below) + n, 0, count_[a] - 1));
    }
    Around around;
    for (std::size_t j = 0; j < 2; ++j) {
      const std::size_t layer = alike_ ? 0 : at[1][j];
      around.lift[j] = alike_ ? core::Index(at[1][j]) * lift_ : 0;
      for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t i = 0; i < 2; ++i) {
          const std::size_t n = 4 * j + 2 * k + i, own = entry(at[0][i], layer, at[2][k]);
          const int corners = entries_[own].corners;
          around.entry[n] = corners < 0 ? own : corners_[std::size_t(corners)][n];
          around.w[n] = w[0][i] * w[2][k] * w[1][j];
        }
    }
    return around;
  }
  [[nodiscard]] std::size_t entry(std::size_t i, std::size_t layer, std::size_t k) const {
    return i + std::size_t(count_[0]) * (k + std::size_t(count_[2]) * layer);
  }
  [[nodiscard]] std::size_t layers() const { return alike_ ? 1 : std::size_t(count_[1]); }
  [[nodiscard]] double distance(int i, int k) const;
  [[nodiscard]] bool near_wall(std::size_t entry) const;
  [[nodiscard]] std::size_t taker(const std::vector<double>& volume, int i, int layer, int k) const;
  [[nodiscard]] std::size_t taker_between_walls(const std::vector<double>& volume, int i, int j, int k) const;
  [[nodiscard]] std::size_t nearest_open(const std::vector<double>& volume, const Vector& place,
                                         const Vector* from) const;
  void divide_sides(const core::Grid& grid, const std::vector<double>& volume);
  [[nodiscard]] Vector place_of(std::size_t entry) const;
  [[nodiscard]] bool sees(const Vector& from, std::size_t entry) const;
  [[nodiscard]] std::size_t in_quarter(std::size_t entry) const;
  template <class Body>
  void for_each_place(const core::Grid& grid, Body&& body) const;
  void fit(const core::Grid& grid, const std::vector<double>& volume);

  std::array<int, 3> count_{};
  std::array<double, 3> per_spacing_{}, offset_{};  ///< 1/m; spacings
  std::shared_ptr<const core::Layers> graded_;      ///< null: all of one height
  bool alike_;                                      ///< all layers are cut alike
  core::Index lift_;                                ///< from a layer to the next in a field
  double radius_;                                   ///< of the column where it is widest, m
  std::shared_ptr<const core::InnerWalls> walls_;   ///< null: none
  std::vector<Entry> entries_;
  std::vector<std::array<std::size_t, 8>> corners_;  ///< takers of an entry as each of the corners around a particle
  std::vector<Vector> seen_at_;  ///< of each entry between walls: the centre of an open cell that it belongs to, m
};

/// Shares of a particle for each kind of entry.
struct RoundShares {
  EntryShares cell;
  std::array<EntryShares, 3> face;
};

class RoundWeights {
 public:
  /// \param grid  of the whole column, with a metric
  explicit RoundWeights(const core::Grid& grid)
      : cell_(grid, -1), face_{EntryWeights(grid, 0), EntryWeights(grid, 1), EntryWeights(grid, 2)} {}

  [[nodiscard]] RoundShares operator()(const Vector& x) const {
    return {cell_(x), {face_[0](x), face_[1](x), face_[2](x)}};
  }

 private:
  EntryWeights cell_;
  std::array<EntryWeights, 3> face_;
};

/// Null for a box without walls inside.
[[nodiscard]] std::shared_ptr<const RoundWeights> round_weights(const core::Grid& grid);

/// As with the Lines in a box: calls body(at, share).
template <class Body>
void for_each_cell(int /*dimensions*/, const RoundShares& shares, Body&& body) {
  for (std::size_t n = 0; n < 8; ++n) body(std::size_t(shares.cell.at[n]), shares.cell.w[n]);
}

template <class Body>
void for_each_face(int /*dimensions*/, const RoundShares& shares, int axis, Body&& body) {
  const EntryShares& face = shares.face[std::size_t(axis)];
  for (std::size_t n = 0; n < 8; ++n) body(std::size_t(face.at[n]), face.w[n]);
}

/// Multiplies the shares on the faces along y.
inline void weaken_upright_faces(Lines& lines, double by) {
  for (double& w : lines.face[1].w) w *= by;
}
inline void weaken_upright_faces(RoundShares& shares, double by) {
  for (double& w : shares.face[1].w) w *= by;
}

}  // namespace polybed::dem
