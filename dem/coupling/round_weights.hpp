// The shares in which a particle of a round column belongs to the cells and the faces around it.
//
//   share of entry e = w_e g_e / sum(w g)
//
// w are the shares of Weights, and those on closed entries count for open ones near them. g is fitted once: particles
// spread evenly over the cross-section fill the open volume V of every entry evenly. g = V alone would fill small cut
// cells by half, and the cells next to them by a seventh too much. V of a face is the volume of its momentum. Faces of
// open cells that the wall closes have theirs, and hold it at rest, as the faces on the walls of a box do.
#pragma once

#include <memory>
#include <vector>

#include "dem/coupling/weights.hpp"

namespace polybed::dem {

/// Entries of a horizontal layer around a place, and its shares of them. Two may be the same.
struct LayerShares {
  std::array<core::Index, 4> at;
  std::array<double, 4> w;
};

/// Those of cells, or of faces of one horizontal axis.
class LayerWeights {
 public:
  /// \param grid  of the whole column  \param of  axis of the faces; -1: cells
  LayerWeights(const core::Grid& grid, int of);

  [[nodiscard]] LayerShares operator()(double x, double z) const {
    const Around around = find(x, z);
    LayerShares shares;
    double sum = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      const Entry& entry = entries_[around.entry[n]];
      shares.at[n] = entry.at;
      shares.w[n] = around.w[n] * entry.weight;
      sum += shares.w[n];
    }
    for (double& w : shares.w) w /= sum;
    return shares;
  }

 private:
  struct Around {
    std::array<std::size_t, 4> entry;
    std::array<double, 4> w;
  };
  /// What a share on an entry counts for: itself or an open one near it.
  struct Entry {
    std::size_t taker;
    core::Index at;  ///< of the taker in a field, in the layer that is the first of a field
    double weight;   ///< g of the taker
  };
  [[nodiscard]] Around find(double x, double z) const {
    const double px = x * per_spacing_[0] - offset_[0], pz = z * per_spacing_[1] - offset_[1];
    const double below_x = std::floor(px), below_z = std::floor(pz), fx = px - below_x, fz = pz - below_z;
    const auto place = [](int n, int count) { return std::size_t(std::clamp(n, 0, count - 1)); };
    const std::array<std::size_t, 2> i{place(int(below_x), count_[0]), place(int(below_x) + 1, count_[0])};
    const std::array<std::size_t, 2> k{place(int(below_z), count_[1]), place(int(below_z) + 1, count_[1])};
    const auto row = std::size_t(count_[0]);
    return {{i[0] + row * k[0], i[1] + row * k[0], i[0] + row * k[1], i[1] + row * k[1]},
            {(1 - fx) * (1 - fz), fx * (1 - fz), (1 - fx) * fz, fx * fz}};
  }
  [[nodiscard]] double distance(int i, int k) const;
  [[nodiscard]] std::size_t taker(const std::vector<double>& volume, int i, int k) const;
  [[nodiscard]] std::vector<Around> places_to_fit() const;
  [[nodiscard]] std::vector<double> filled(const std::vector<Around>& places, const std::vector<double>& weight) const;
  void fit(const std::vector<double>& volume);

  std::array<int, 2> count_{};
  std::array<double, 2> per_spacing_{}, offset_{};  ///< 1/m; spacings
  double radius_;                                   ///< of the column, m
  std::vector<Entry> entries_;
};

/// Of a particle, of each kind of entries.
struct RoundShares {
  LayerShares cell, face_x, face_z;
  Line upright_cell, upright_face;
};

class RoundWeights {
 public:
  /// \param grid  of the whole column, which is round
  explicit RoundWeights(const core::Grid& grid) : upright_(grid), cell_(grid, -1), face_x_(grid, 0), face_z_(grid, 2) {}

  [[nodiscard]] RoundShares operator()(const Vector& x) const {
    const Lines lines = upright_(x);
    return {cell_(x[0], x[2]), face_x_(x[0], x[2]), face_z_(x[0], x[2]), lines.cell[1], lines.face[1]};
  }

 private:
  Weights upright_;
  LayerWeights cell_, face_x_, face_z_;
};

/// Null for a box.
[[nodiscard]] std::shared_ptr<const RoundWeights> round_weights(const core::Grid& grid);

/// Calls body(at, share) for the entries of layers that a line along y crosses.
template <class Body>
void for_each_share(const LayerShares& layer, const Line& upright, Body&& body) {
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t n = 0; n < 4; ++n) body(std::size_t(layer.at[n] + upright.at[j]), layer.w[n] * upright.w[j]);
}

/// As for the Lines of a box.
template <class Body>
void for_each_cell(int /*dimensions*/, const RoundShares& shares, Body&& body) {
  for_each_share(shares.cell, shares.upright_cell, body);
}

template <class Body>
void for_each_face(int /*dimensions*/, const RoundShares& shares, int axis, Body&& body) {
  if (axis == 1) return for_each_share(shares.cell, shares.upright_face, body);
  for_each_share(axis == 0 ? shares.face_x : shares.face_z, shares.upright_cell, body);
}

/// The line of the faces along y.
[[nodiscard]] inline Line& upright_faces(Lines& lines) { return lines.face[1]; }
[[nodiscard]] inline Line& upright_faces(RoundShares& shares) { return shares.upright_face; }

}  // namespace polybed::dem
