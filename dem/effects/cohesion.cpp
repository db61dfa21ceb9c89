// Attractions of two surfaces along n, cohesion_*.hpp.
#include <algorithm>
#include <optional>
#include <vector>

#include "closures/cohesion_dmt.hpp"
#include "closures/cohesion_jkr.hpp"
#include "closures/cohesion_van_der_waals.hpp"
#include "closures/contact_hertz.hpp"
#include "core/vectors.hpp"
#include "dem/effects.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/rows.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/effects/cohesion.hpp"

namespace polybed::dem {

namespace {

using Row = ContactBatch::Row;

void dmt(ContactBatch& b, int place, const Row& pull, double dt) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double memory = neck_memory(b.memory[place][c], b.overlap[c], 0, b.speed[c] * dt);
    b.memory[place][c] = memory;
    b.normal[c] += neck_weight(memory) * closures::dmt_force(pull[c], 0);
  }
}

void jkr(ContactBatch& b, int place, const Row& force, const Row& gap, double dt) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double memory = neck_memory(b.memory[place][c], b.overlap[c], gap[c], b.speed[c] * dt);
    const double whole = closures::jkr_force({force[c], 0, gap[c]}, b.overlap[c]);
    b.memory[place][c] = memory;
    b.normal[c] += neck_weight(memory) * (whole - b.elastic[c]);
  }
}

void van_der_waals(ContactBatch& b, const Row& radius, double hamaker, double least_gap) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c)
    b.normal[c] += closures::van_der_waals_force(hamaker, radius[c], least_gap, -b.overlap[c]);
}

/// Share of the greatest attraction at which the van der Waals force is cut off.
constexpr double pull_at_reach = 1e-6;

/// A constant attraction 2 pi W R* during contact: the memory acts as for a neck that breaks at once.
class DmtCohesion final : public CohesionLaw {
 public:
  /// \param work_of_adhesion  W, J/m2   \param place  index of its memory in a batch
  DmtCohesion(const Materials& materials, double work_of_adhesion, double step, int place)
      : reach_(step), place_(place) {
    for (const PairMaterial& m : materials.kinds()) pull_.push_back(closures::dmt_pull_off(work_of_adhesion, m.radius));
  }
  void act(ContactBatch& batch, double dt) const override {
    alignas(64) Row pull = {};
    for (int c = 0; c < batch.count; ++c) pull[c] = pull_[std::size_t(batch.kind[c])];
    core::in_vectors<dmt>(batch, place_, pull, dt);
  }
  [[nodiscard]] int memory_size() const override { return 1; }
  void add_energy(const ContactBatch& batch, Row& stored, double dt) const override {
    for (int c = 0; c < batch.count; ++c) {
      const double pull = pull_[std::size_t(batch.kind[c])];
      stored[c] +=
          closures::dmt_energy(pull, batch.overlap[c]) + pull * neck_owed(batch.memory[place_][c], batch.speed[c] * dt);
    }
  }
  void add_loss(const ContactBatch&, ContactBatch::Row&) const override {}
  [[nodiscard]] double reach() const override { return reach_; }
  [[nodiscard]] double pull_off(int kind) const override { return pull_[std::size_t(kind)]; }

 private:
  std::vector<double> pull_;
  double reach_;
  int place_;
};

/// JKR's force instead of Hertz'. Surfaces jump together at first contact and separate when the neck breaks, a gap
/// delta_s later: the memory is whether they adhere. The energy of this hysteresis is lost, and counted when they jump
/// together. Dashpot, friction and rolling act during overlap, as with Hertz' force, not on the neck.
class JkrCohesion final : public CohesionLaw {
 public:
  /// \param place  index of its memory in a batch
  JkrCohesion(const Materials& materials, double work_of_adhesion, double step, int place)
      : step_(step), place_(place) {
    for (const PairMaterial& m : materials.kinds()) {
      const closures::JkrScales scales = closures::jkr_scales(work_of_adhesion, m.youngs_modulus, m.radius);
      constants_.push_back(
          {scales, -closures::jkr_energy(scales, 0), closures::hertz_coefficient(m.youngs_modulus, m.radius)});
    }
  }

  void act(ContactBatch& batch, double dt) const override {
    alignas(64) Row force = {}, gap;
    std::fill_n(gap, ContactBatch::width, 1.0);
    for (int c = 0; c < batch.count; ++c) {
      const closures::JkrScales& s = constants_[std::size_t(batch.kind[c])].scales;
      force[c] = s.force;
      gap[c] = s.gap;
    }
    core::in_vectors<jkr>(batch, place_, force, gap, dt);
  }

  [[nodiscard]] int memory_size() const override { return 1; }
  void add_energy(const ContactBatch& batch, Row& stored, double dt) const override {
    for (int c = 0; c < batch.count; ++c) {
      const Constants& k = constants_[std::size_t(batch.kind[c])];
      const double memory = batch.memory[place_][c], overlap = batch.overlap[c];
      const double hertz = closures::hertz_stored_energy(k.coefficient, std::max(overlap, 0.0));
      if (memory > 0) stored[c] += closures::jkr_energy(k.scales, overlap) - hertz;
      stored[c] += (batch.elastic[c] - closures::jkr_force(k.scales, overlap)) * neck_owed(memory, batch.speed[c] * dt);
    }
  }

  void add_loss(const ContactBatch& batch, Row& lost) const override {
    for (int c = 0; c < batch.count; ++c) {
      const Constants& k = constants_[std::size_t(batch.kind[c])];
      if (batch.overlap[c] >= 0 && !(batch.memory[place_][c] > 0)) lost[c] += k.loss;
    }
  }

  [[nodiscard]] double reach() const override {
    double reach = 0;
    for (const Constants& k : constants_) reach = std::max(reach, k.scales.gap);
    return reach + step_;
  }
  [[nodiscard]] double pull_off(int kind) const override { return 1.5 * constants_[std::size_t(kind)].scales.force; }

 private:
  struct Constants {
    closures::JkrScales scales;
    double loss;         ///< in a jump into contact, J
    double coefficient;  ///< K in Hertz' force, whose energy it replaces
  };
  std::vector<Constants> constants_;
  double step_;
  int place_;
};

/// A R*/(6 z^2), z the gap but at least z_0; cut off at a millionth of the force at z_0, at 1000 z_0, where a
/// thousandth of the energy is left. A step must move less than z_0 to resolve the approach.
class VanDerWaalsCohesion final : public CohesionLaw {
 public:
  /// \param hamaker  A, J  \param least_gap  z_0, m  \param asperity_radius  R* of rough surfaces, m; empty: of the
  /// spheres
  VanDerWaalsCohesion(const Materials& materials, double hamaker, double least_gap,
                      std::optional<double> asperity_radius = {})
      : hamaker_(hamaker), least_gap_(least_gap) {
    for (const PairMaterial& m : materials.kinds()) radius_.push_back(asperity_radius.value_or(m.radius));
    const double greatest = *std::max_element(radius_.begin(), radius_.end());
    reach_ = closures::van_der_waals_reach(
        hamaker, greatest, pull_at_reach * closures::van_der_waals_pull_off(hamaker, greatest, least_gap));
  }

  void act(ContactBatch& batch, double) const override {
    alignas(64) Row radius = {};
    for (int c = 0; c < batch.count; ++c) radius[c] = radius_[std::size_t(batch.kind[c])];
    core::in_vectors<van_der_waals>(batch, radius, hamaker_, least_gap_);
  }
  [[nodiscard]] int memory_size() const override { return 0; }
  void add_energy(const ContactBatch& batch, Row& stored, double) const override {
    for (int c = 0; c < batch.count; ++c) {
      const double radius = radius_[std::size_t(batch.kind[c])], gap = -batch.overlap[c];
      // Relative to the distance at which the force is cut off.
      stored[c] += closures::van_der_waals_energy(hamaker_, radius, least_gap_, gap) -
                   closures::van_der_waals_energy(hamaker_, radius, least_gap_, reach_);
    }
  }

  void add_loss(const ContactBatch&, ContactBatch::Row&) const override {}
  [[nodiscard]] double reach() const override { return reach_; }
  [[nodiscard]] double pull_off(int kind) const override {
    return closures::van_der_waals_pull_off(hamaker_, radius_[std::size_t(kind)], least_gap_);
  }

 private:
  std::vector<double> radius_;  ///< R*
  double hamaker_, least_gap_, reach_;
};

}  // namespace

namespace makers {

namespace {

core::Rule cohesion_needs_energy(const std::string& law) {
  return relevance::rule_of_law("cohesion", law, {"dem.cohesion_energy"},
                                "dem.cohesion_energy: effects.cohesion = \"" + law + "\" needs it, as in \"50 mJ/m2\"",
                                [](const core::Scene& scene) { return !(scene.dem.cohesion_energy > 0); });
}

const PairMakers cohesions{
    {"van_der_waals",
     [](const PairMaking& m) {
       m.laws.cohesion = std::make_unique<VanDerWaalsCohesion>(m.materials, m.scene.material.hamaker_constant,
                                                               m.scene.dem.cohesion_gap, m.scene.dem.asperity_radius);
     }},
    {"dmt",
     [](const PairMaking& m) {
       m.laws.cohesion = std::make_unique<DmtCohesion>(m.materials, m.scene.dem.cohesion_energy,
                                                       longest_step(m.scene, m.materials), m.laws.contact_memory());
     }},
    {"jkr", [](const PairMaking& m) {
       m.laws.cohesion = std::make_unique<JkrCohesion>(m.materials, m.scene.dem.cohesion_energy,
                                                       longest_step(m.scene, m.materials), m.laws.contact_memory());
     }}};

}  // namespace

extern const Maker cohesion;
const Maker cohesion{&relevance::effects::cohesion,
                     "Pair",
                     MakePair([](const PairMaking& m) { cohesions.at(m.law)(m); }),
                     {cohesion_needs_energy("dmt"), cohesion_needs_energy("jkr")}};

}  // namespace makers

}  // namespace polybed::dem
