// Attractions of two surfaces along n, cohesion_*.hpp.
#pragma once

#include <optional>
#include <vector>

#include "closures/cohesion_jkr.hpp"
#include "dem/effects.hpp"

namespace polybed::dem {

/// A constant pull 2 pi W R* while the bodies touch.
class DmtCohesion final : public CohesionLaw {
 public:
  /// \param work_of_adhesion  W, J/m2
  DmtCohesion(const Materials& materials, double work_of_adhesion);
  void act(ContactBatch& batch) const override;
  [[nodiscard]] int memory_size() const override { return 0; }
  void add_energy(const ContactBatch& batch, ContactBatch::Row& stored) const override;
  void add_loss(const ContactBatch&, ContactBatch::Row&) const override {}
  [[nodiscard]] double reach() const override { return 0; }
  [[nodiscard]] double pull_off() const override;

 private:
  std::vector<double> pull_;
};

/// JKR's force in place of Hertz'. Surfaces jump together when they touch and part when the neck breaks, a gap delta_s
/// later: the memory is whether they hold. The energy of that way is lost, and counted where they jump together.
/// Dashpot, friction and rolling act while the bodies overlap, as with Hertz' force, not on the neck.
class JkrCohesion final : public CohesionLaw {
 public:
  /// \param place  of its memory in a batch
  JkrCohesion(const Materials& materials, double work_of_adhesion, int place);
  void act(ContactBatch& batch) const override;
  [[nodiscard]] int memory_size() const override { return 1; }
  void add_energy(const ContactBatch& batch, ContactBatch::Row& stored) const override;
  void add_loss(const ContactBatch& batch, ContactBatch::Row& lost) const override;
  [[nodiscard]] double reach() const override;
  [[nodiscard]] double pull_off() const override;

 private:
  struct Constants {
    closures::JkrScales scales;
    double loss;         ///< of a jump into contact, J
    double coefficient;  ///< K of Hertz' force, whose energy it replaces
  };
  std::vector<Constants> constants_;
  int place_;
};

/// A R*/(6 z^2), z the gap but at least z_0; cut where it is a millionth of the pull at z_0, at 1000 z_0, where a
/// thousandth of the energy is left. A step that is to resolve the approach must move less than z_0.
class VanDerWaalsCohesion final : public CohesionLaw {
 public:
  /// \param hamaker  A, J  \param least_gap  z_0, m  \param asperity_radius  R* of rough surfaces, m; empty: of the
  /// spheres
  VanDerWaalsCohesion(const Materials& materials, double hamaker, double least_gap,
                      std::optional<double> asperity_radius = {});
  void act(ContactBatch& batch) const override;
  [[nodiscard]] int memory_size() const override { return 0; }
  void add_energy(const ContactBatch& batch, ContactBatch::Row& stored) const override;
  void add_loss(const ContactBatch&, ContactBatch::Row&) const override {}
  [[nodiscard]] double reach() const override { return reach_; }
  [[nodiscard]] double pull_off() const override;

 private:
  std::vector<double> radius_;  ///< R*
  double hamaker_, least_gap_, reach_;
};

}  // namespace polybed::dem
