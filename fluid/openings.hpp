// Solids crossing the ends and sides of the column: feeds, and outflow through an open top or a discharge.
//
// The volume per area that has crossed each face since the start, m, along the axis, is an unknown with the continuity
// flux as its rate, integrated with the fractions and by the same sums. A species' mass in the column, minus inflow,
// plus outflow, thus stays constant to round-off, whatever the steps.
#pragma once

#include <vector>

#include "core/case/scene.hpp"
#include "fluid/inlet.hpp"
#include "fluid/interphase.hpp"
#include "fluid/open_face.hpp"

namespace polybed::fluid {

/// Volume of a species that has entered and left since the start, m3.
struct Passed {
  double in = 0, out = 0;
};

class Openings {
 public:
  /// A species and an end or side that it crosses, with the unknowns on its faces.
  struct Passage {
    std::size_t species;
    core::ColumnFace at;
  };

  Openings() = default;
  Openings(const core::Grid& grid, const core::Scene& scene);

  /// False if all ends and sides are screens and nothing is fed; other members need not be called then.
  [[nodiscard]] bool present() const { return !passages_.empty(); }
  [[nodiscard]] const std::vector<Passage>& passages() const { return passages_; }
  /// The greatest speed of any feed, m/s.
  [[nodiscard]] double greatest() const { return greatest_; }
  /// Times at which a feed's rate jumps.
  [[nodiscard]] std::vector<double> breakpoints() const;

  /// Whether solids cross a side.
  [[nodiscard]] bool in_sides() const;
  /// A field of zeros on the faces of the axes with passages; empty on others.
  [[nodiscard]] core::FaceField make_passed() const;
  /// Sets velocities on fed faces to the feed's, and on faces of a discharge to the outgoing mixture's.
  void set_velocities(double t, Interphase& solids) const;
  /// Sets velocities on the open faces of the sides, where solids move as the mixture.
  /// \param flux  J, m/s
  void follow(const core::FaceField& flux, Interphase& solids) const;
  /// Sets ghost fractions beyond fed faces so that the mean on the face is the feed's, F_j/U_j; in sides also the
  /// ghosts of the velocities.
  void set_ghosts(double t, Interphase& solids) const;
  /// Fluxes of species j through the ends and sides: the feed, the discharge from adjacent cells, and the outflow
  /// through an open top or side, phi_j max(U_j, 0), never inward. Fills solids.passed_rate.
  void cross(double t, std::size_t j, Interphase& solids, core::FaceField& flux) const;
  /// Sets ghosts of the rate of species j's fraction beyond fed faces: the mean on the face is the rate of F_j/U_j.
  void set_rate_ghosts(double t, std::size_t j, Interphase& solids) const;
  /// On fed faces of an open outlet: solids that are fed neither accelerate nor respond to the pressure.
  void hold(std::vector<core::FaceField>& acceleration) const;
  void hold(const Interphase& solids, core::FaceField& mobility) const;
  /// True if the velocity of species j on a face of an axis is prescribed by a feed.
  [[nodiscard]] bool holds(std::size_t j, int axis, core::Index face) const;

  /// Volume of each species that has passed since the start. Collective.
  [[nodiscard]] std::vector<Passed> passed(const Interphase& solids) const;

 private:
  struct Part {
    Ramp ramp;                  ///< along the axis, m/s
    std::vector<double> share;  ///< share of each face
  };
  /// Faces of one end or side that feed one species, or through which the mixture leaves.
  struct Gate {
    std::size_t species;
    core::ColumnFace at;
    std::vector<core::Index> face;
    std::vector<double> velocity;  ///< for a feed, along the axis, m/s, on each face
    std::vector<Part> parts;
    [[nodiscard]] double flux(std::size_t n, double t) const;
    [[nodiscard]] double flux_rate(std::size_t n, double t) const;
    [[nodiscard]] std::size_t axis() const { return std::size_t(axis_of(at)); }
  };
  void add_gate(const core::Scene& scene, std::size_t species, core::ColumnFace at);
  void add_discharge(const core::Discharge& discharge);
  template <class Covered>
  void cover(Gate& gate, Covered&& covered) const;
  /// Calls body(gate, n, face, inside, beyond): cells on either side of the n-th face of each of the gates.
  template <class Body>
  void for_each_face(const std::vector<Gate>& gates, Body&& body) const;

  core::Grid grid_;
  bool open_ = false;
  double greatest_ = 0;
  std::vector<Gate> gates_;       ///< feeds
  std::vector<Gate> discharges_;  ///< discharges of all species with a given flow
  std::vector<OpenFace> open_faces_;
  std::vector<Passage> passages_;
};

}  // namespace polybed::fluid
