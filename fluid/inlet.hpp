// Inflow through the distributor: a superficial velocity over time, and jets over parts of the bottom; also flow
// through parts of the sides.
#pragma once

#include <utility>
#include <vector>

#include "core/case/scene.hpp"
#include "core/numerics/field.hpp"

namespace polybed::fluid {

/// A velocity over time: linear between the points of a table, constant beyond.
class Ramp {
 public:
  Ramp() = default;
  /// \param factor  for all velocities: -1 for downward flow
  explicit Ramp(std::vector<std::pair<double, double>> table, double factor = 1) : table_(std::move(table)) {
    for (auto& point : table_) point.second *= factor;
  }
  /// Velocity, m/s, at time t, s; after the jump where the table has two points at t.
  [[nodiscard]] double velocity(double t) const;
  /// Its rate, m/s2; from the right at a breakpoint.
  [[nodiscard]] double rate(double t) const;
  /// Its integral from time 0 to t, m; 0 before.
  [[nodiscard]] double integral(double t) const;
  /// The greatest speed at any time, m/s.
  [[nodiscard]] double greatest() const;
  [[nodiscard]] const std::vector<std::pair<double, double>>& table() const { return table_; }

 private:
  [[nodiscard]] std::vector<std::pair<double, double>>::const_iterator after(double t) const;
  std::vector<std::pair<double, double>> table_;
};

/// Share of each of the block's faces at an end or side of the column, row by row, that lies in a part of it; from and
/// to as for a jet, empty: all.
[[nodiscard]] std::vector<double> face_shares(const core::Grid& grid, const std::vector<double>& from,
                                              const std::vector<double>& to,
                                              core::ColumnFace at = core::ColumnFace::bottom);

/// Flow through the bottom of a column, parts of its sides, and its top if the flow is given there too: the same
/// volume, spread evenly. A jet covers its part of a face's area by overlap, so that the inflow does not depend on the
/// grid. The rest of the face has the velocity of the distributor or, in a side, is a wall. Solids fed through the
/// bottom or a side are part of the flux of the mixture and add to it.
class Inlet {
 public:
  Inlet() = default;
  /// Collective.
  Inlet(const core::Grid& grid, const core::Scene& scene);

  /// Sets the flux at time t, m/s, on the faces where it is given.
  void set_velocity(double t, core::FaceField& flux) const;
  /// Leaves of the flux at time t, m/s, what the fluid has of it. \param voidage  in the cells, where particles are
  void take_solids_out(double t, const core::Field& voidage, core::FaceField& flux) const;
  /// Sets its rate, m/s2, there.
  void set_rate(double t, core::FaceField& rate) const;
  /// Continues a velocity unchanged beyond the sides where something flows through them.
  void extend(core::FaceField& velocity) const;
  /// Calls body(axis, face, cell inside) for the faces of the sides where the flux is given.
  template <class Body>
  void for_each_side_face(Body&& body) const {
    for (const Port& port : ports_) {
      const core::Index inward = side_of(port.at) == 0 ? 0 : -grid_.stride(axis_of(port.at));
      for (const core::Index face : port.face) body(std::size_t(axis_of(port.at)), face, face + inward);
    }
  }
  /// Mean over the bottom, m/s.
  [[nodiscard]] double mean_velocity(double t) const;
  /// The greatest speed in any part of the bottom, and in any part at all, at any time, m/s.
  [[nodiscard]] double greatest_below() const;
  [[nodiscard]] double greatest() const;
  /// Whether the flow is zero at some time.
  [[nodiscard]] bool shuts() const;
  /// Times at which a rate jumps: the integrator must stop there.
  [[nodiscard]] std::vector<double> breakpoints() const;

 private:
  /// What a flux consists of. In a discharge fluid and solids move alike.
  enum class Carries { fluid, solids, both };
  /// One velocity, the share of each of the block's bottom faces, row by row, that has it, and that of the whole
  /// bottom.
  struct Part {
    Ramp ramp;
    std::vector<double> share;
    double mean_share;
    Carries carries;
  };
  /// A part of a side, with the faces of the block that it covers.
  struct Port {
    core::ColumnFace at;
    Ramp ramp;          ///< along the axis
    double mean_share;  ///< what flows in through all of it, over the bottom's area and its ramp's velocity
    Carries carries;
    std::vector<core::Index> face;
    std::vector<double> share;  ///< of each face
  };
  template <class Side>
  void add_port(const Side& part, double inward, Carries carries);
  [[nodiscard]] double mean_over_bottom(const std::vector<double>& share) const;
  template <class Value>
  void set(core::FaceField& faces, Value&& value) const;

  core::Grid grid_;
  std::vector<Part> parts_;  ///< the distributor first
  std::vector<Port> ports_;
  std::vector<Part> fed_above_;  ///< feeds through a top where the flow is given: none else passes a lid
  bool lid_ = false;
  double above_ = 0;  ///< uniform part at the top, over the mean of the bottom; 0: not given there
};

}  // namespace polybed::fluid
