// The averaging kernel between particles and fluid, with its own width: results must not depend on the size of the
// cells. Values deposited by particles in cells and faces, and values gathered from there, are smoothed by d phi/d tau
// = lap phi up to tau = w^2/(16 ln 2): a Gaussian whose full width at half height is w.
#pragma once

#include <array>
#include <vector>

#include "core/numerics/field.hpp"

namespace polybed::fluid {

/// Fewer particles have no neighbours that average out their individual disturbances.
inline constexpr std::size_t fewest_of_a_bed = 10;

/// The default width of the kernel, m: 0, plain weights, if the smallest cell is at least 1.5 of the largest diameters,
/// else 4 of the mean diameters and at least 1.5 of the largest, the width that plain weights may have. For single
/// particles (fewer than fewest_of_a_bed), whose own disturbance of the fluid must not be mistaken for its speed, 6 of
/// the largest diameters if cells are smaller than 5.
/// \param mean  Sauter's diameter, m
[[nodiscard]] double smoothing_width(double smallest_cell, double largest, double mean, std::size_t particles);

/// tau, m2, in which diffusion turns a point into the Gaussian exp(-r^2/(4 tau)) of full width w at half height:
/// exp(-w^2/(16 tau)) = 1/2.
[[nodiscard]] double smoothing_time(double width);

/// Diffusion along one line of equal cells by equal implicit Euler steps, (1 + lambda L)^-steps with L = (-1, 2, -1),
/// no flux through the ends or the ends joined.
///
/// Each step is a forward and a backward recurrence with only positive coefficients, computed without differences:
/// values >= 0 stay so, and every entry of such a line, hence its sum, is accurate to round-off at any lambda. With
/// joined ends 1 + lambda L = (1 - q E)(1 - q/E)/(1 - q)^2, E the shift by a cell, and both recurrences start from the
/// sum over all turns; Sherman and Morrison's formula would subtract.
class LineDiffusion {
 public:
  static constexpr int lanes = 8;  ///< lines done at once, as a single one is limited by the latency of the arithmetic
  /// \param lambda  of each step: its time over the cell size squared
  LineDiffusion(int count, bool joined, double lambda, int steps);
  /// For entries of unequal open volume V between faces of open share A: (V + lambda L_A)^-1 V, no flux through the
  /// ends. Closed entries stay unchanged.
  /// \param open  of the face below each entry; 0 below the first and next to a closed entry
  LineDiffusion(const std::vector<double>& volume, const std::vector<double>& open, double lambda, int steps);
  [[nodiscard]] int count() const { return int(gain_.size()); }
  /// Smooths `lanes` lines; entry i of line l is tile[i * lanes + l].
  void apply(double* tile) const;

 private:
  template <bool forward>
  void pass(double* tile) const;
  std::vector<double> gain_, carry_, back_;  ///< y[i] = gain[i] b[i] + carry[i] y[i-1]; x[i] = y[i] + back[i] x[i+1]
  double around_ = 0;  ///< 1/(1 - q^count): all turns around joined ends; 0 if they are not joined
  int steps_;
};

/// \pre The whole column is on this rank (grid.ranks is null). One object must not smooth two fields at the same time.
///
/// Smooths axis by axis; on a uniform box the axes commute, and the operator is exactly their product. It is symmetric,
/// positive, keeps constants and conserves the sum of its argument, each to round-off, so that gathering and scattering
/// with it are adjoint. Implicit Euler steps have the exact second moment, 2 tau along each axis, for any number of
/// steps and any cells; their number sets the shape (see smoothing.cpp).
///
/// In a round column the flux passes the open shares of faces, entries are weighted by their open volumes, and lines
/// along x and z do not commute: half of the steps along x come before those along z and half after, so that the
/// operator is symmetric in the volume-weighted product; likewise half of y if the diameter changes. Faces closed by
/// the wall are held.
///
/// smooth_cells(div F) = div(smooth_faces(F)) along joined axes, and for the component of F along a joined axis
/// whatever the other axes are. For the component normal to walls both have the same sum, but they agree only where the
/// kernel does not reach the wall: faces there conserve the sum of F instead.
class Smoothing {
 public:
  /// \param width   w, full width at half height of the kernel, m; 0: no smoothing
  /// \param closed  whether the column's top is a wall for the smoothed quantity: its faces are held
  Smoothing(const core::Grid& grid, double width, bool closed);

  [[nodiscard]] bool present() const { return !work_.empty(); }
  /// Smooths a cell field in place: no flux through walls, bottom and top. Neither reads nor writes ghosts.
  void smooth_cells(core::Field& field) const { smooth(cells_, field); }
  /// Shares of a cell's content that stay in it and that go to the next cell along one axis. The kernel is the product
  /// over the axes, for a box only. \param count  cells along the axis
  [[nodiscard]] std::vector<std::array<double, 2>> nearest(int axis, int count) const;
  /// Smooths a component of a quantity on the faces of an axis. Faces on walls and on the bottom, and those at a closed
  /// top, are held: neither read nor written, no flux between them and their neighbours. Faces at an open top are like
  /// interior ones. No flux through walls across the axis.
  void smooth_faces(core::Field& field, int axis) const { smooth(faces_[std::size_t(axis)], field); }

 private:
  /// The lines of a box of entries along one axis.
  struct Sweep {
    int axis;
    LineDiffusion line;
    core::Index stride;
    std::vector<core::Index> starts;
  };
  using Sweeps = std::vector<Sweep>;
  [[nodiscard]] static Sweeps sweeps(const core::Grid& grid, const core::Box& box, double time);
  [[nodiscard]] static Sweeps open_sweeps(const core::Grid& grid, int of, const core::Box& box, double time);
  void smooth(const Sweeps& sweeps, core::Field& field) const;

  Sweeps cells_;
  std::array<Sweeps, 3> faces_;
  mutable std::vector<double> work_;  ///< the lines in work
};

}  // namespace polybed::fluid
