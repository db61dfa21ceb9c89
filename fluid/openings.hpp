// Where solids cross the ends and sides of the column: they are fed, and leave through an open top or a discharge.
//
// What has crossed each face since the start, m (volume per area, along the axis), is an unknown with the flux of
// continuity as its rate, integrated with the fractions and by the same sums: the mass of a species in the column, less
// what came in, plus what left, stays what it was to round-off, whatever the steps.
#pragma once

#include <vector>

#include "core/case/scene.hpp"
#include "fluid/inlet.hpp"
#include "fluid/interphase.hpp"

namespace polybed::fluid {

/// Volume of a species that has come in and gone out since the start, m3.
struct Passed {
  double in = 0, out = 0;
};

class Openings {
 public:
  /// A species and an end or side that it crosses: the unknowns of its faces.
  struct Passage {
    std::size_t species;
    core::ColumnFace at;
  };

  Openings() = default;
  Openings(const core::Grid& grid, const core::Scene& scene);

  /// False where all ends and sides are screens and nothing is fed: then no other member need be called.
  [[nodiscard]] bool present() const { return !passages_.empty(); }
  [[nodiscard]] const std::vector<Passage>& passages() const { return passages_; }
  /// The greatest speed at which anything is fed, m/s.
  [[nodiscard]] double greatest() const { return greatest_; }
  /// Times at which a feed's rate jumps.
  [[nodiscard]] std::vector<double> breakpoints() const;

  /// Whether solids cross a side.
  [[nodiscard]] bool in_sides() const;
  /// A field on the faces of the axes that passages lie across, 0 all over; empty on others.
  [[nodiscard]] core::FaceField make_passed() const;
  /// Velocities on fed faces: those of the feed; on faces of a discharge those of the mixture that leaves.
  void set_velocities(double t, Interphase& solids) const;
  /// Ghost fractions beyond fed faces, so that the mean on the face is that of the feed, F_j/U_j; in sides ghosts of
  /// the velocities, too.
  void set_ghosts(double t, Interphase& solids) const;
  /// Fluxes of species j through the ends and sides: what is fed, what a discharge takes from the cells next to it, and
  /// out of an open top what the velocity there takes along, phi_j max(U_j, 0): never in. Fills solids.passed_rate.
  void cross(double t, std::size_t j, Interphase& solids, core::FaceField& flux) const;
  /// Ghosts of the rate of species j's fraction beyond fed faces, so that the mean on the face is that of F_j/U_j.
  void set_rate_ghosts(double t, std::size_t j, Interphase& solids) const;
  /// On fed faces of an open outlet: solids that are fed do not accelerate, and do not yield to the pressure.
  void hold(std::vector<core::FaceField>& acceleration) const;
  void hold(const Interphase& solids, core::FaceField& mobility) const;
  /// True if the velocity of species j on a face of an axis is that of a feed.
  [[nodiscard]] bool holds(std::size_t j, int axis, core::Index face) const;

  /// What each species has passed since the start. Collective.
  [[nodiscard]] std::vector<Passed> passed(const Interphase& solids) const;

 private:
  struct Part {
    Ramp ramp;                  ///< along the axis, m/s
    std::vector<double> share;  ///< of each face
  };
  /// Faces of one end or side through which one species is fed, or the mixture leaves.
  struct Gate {
    std::size_t species;
    core::ColumnFace at;
    std::vector<core::Index> face;
    std::vector<double> velocity;  ///< of a feed, along the axis, m/s, of each face
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
  std::vector<Gate> gates_;       ///< of feeds
  std::vector<Gate> discharges_;  ///< of all species
  std::vector<Passage> passages_;
};

}  // namespace polybed::fluid
