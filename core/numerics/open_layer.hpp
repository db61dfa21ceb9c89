// A horizontal layer of a round column on its grid: the open shares of cells and faces, and the merging of small cells.
#pragma once

#include <cmath>
#include <vector>

#include "core/numerics/metric.hpp"

namespace polybed::core {

/// Places up to this share of a cell beyond its face are round-off.
inline constexpr double near_face = 1e-9;

class Disc;

/// The neighbour that a cell was merged into.
struct Taken {
  std::size_t from;
  std::vector<std::size_t> to;
};

/// A layer of the column under construction.
struct OpenLayer {
  CrossSection open;
  std::vector<double> around;  ///< rings: outward push of an even pressure on a cell, in faces along x
  std::vector<Taken> taken;    ///< from the outside in
};

/// Builds the grid of a column about its axis.
class Sections {
 public:
  Sections(const Grid& column, bool rings)
      : rings_(rings),
        nx_(column.cells[0]),
        nz_(column.cells[2]),
        hx_(column.spacing[0]),
        hz_(column.spacing[2]),
        hy_(column.spacing[1]),
        radius_(rings ? nx_ * hx_ : 0.5 * nx_ * hx_) {}

  /// Adds a share of the area within a radius of the axis.
  void add(double radius, double share, OpenLayer& layer) const;
  [[nodiscard]] OpenLayer empty() const {
    const auto cells = std::size_t(nx_ * nz_);
    OpenLayer layer{
        {nx_, nz_, std::vector<double>(cells), {}, std::vector<double>(std::size_t((nx_ + 1) * nz_)), {}, {}, {}},
        std::vector<double>(cells),
        {}};
    if (!rings_) layer.open.open_z.resize(std::size_t(nx_ * (nz_ + 1)));
    for (int i = 0; rings_ && i <= nx_; ++i) layer.open.radius.push_back(i * hx_);
    return layer;
  }
  /// Opens the cells of a duct, from the side to where they are whole, and marks them.
  void open_duct(const Duct& duct, OpenLayer& layer, std::vector<bool>& in_duct) const;
  /// Merges a small cell with the neighbour across its largest face, or in equal parts with two alike.
  void absorb_small_cells(OpenLayer& layer) const;
  /// Sets the wall of a layer with the open shares `below` at its low faces and `above` at its high ones.
  void set_wall(const std::vector<double>& below, const std::vector<double>& above, const Taper& taper, double height,
                OpenLayer& layer) const;
  [[nodiscard]] double radius() const { return radius_; }
  /// Radii at which the open part of a cell or face begins and ends.
  [[nodiscard]] std::vector<double> steps() const {
    std::vector<double> radii;
    for (int i = 0; rings_ && i <= nx_; ++i) radii.push_back(i * hx_);
    return radii;
  }

 private:
  /// A radius that equals a face's up to round-off becomes that face's.
  [[nodiscard]] double in_cells(double radius) const {
    const double cells = radius / hx_, face = std::round(cells);
    return std::abs(cells - face) < 1e-14 * nx_ ? face : cells;
  }
  [[nodiscard]] double x(int i) const { return i * hx_ - (rings_ ? 0 : radius_); }
  [[nodiscard]] double z(int k) const { return k * hz_ - radius_; }
  [[nodiscard]] double from_axis(int i, int k) const {
    const double along_x = x(i) + 0.5 * hx_;
    return rings_ ? along_x : std::hypot(along_x, z(k) + 0.5 * hz_);
  }
  /// Volume of a whole cell.
  [[nodiscard]] double whole(int i) const { return rings_ ? (2.0 * i + 1) / nx_ : 1.0; }

  void add_disc(const Disc& disc, double share, OpenLayer& layer) const;
  /// \param radius  in cells
  void add_rings(double radius, double share, OpenLayer& layer) const;
  void absorb(int i, int k, OpenLayer& layer) const;

  bool rings_;
  int nx_, nz_;
  double hx_, hz_, hy_, radius_;
};

}  // namespace polybed::core
