// Contact: springs and dashpots along the normal, with friction.
#include "relevance/effects/contact.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "closures/contact_linear.hpp"
#include "closures/restitution.hpp"
#include "core/vectors.hpp"
#include "dem/effects.hpp"
#include "dem/effects/contact_hertz.hpp"
#include "dem/effects/friction.hpp"
#include "dem/effects/friction_partial_slip.hpp"
#include "dem/effects/maker.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::dem {

namespace {

void linear(ContactBatch& b, double stiffness, const ContactBatch::Row& dashpot, double least_force) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double overlap = b.overlap[c] > 0 ? b.overlap[c] : 0;
    const double damping = b.overlap[c] > 0 ? dashpot[c] : 0, elastic = stiffness * overlap;
    const double force = elastic - damping * b.speed[c];
    b.elastic[c] = elastic;
    b.dashpot[c] = damping;
    b.normal[c] = force > least_force ? force : least_force;
  }
}

/// A linear spring and dashpot.
class LinearContact final : public NormalLaw {
 public:
  /// \param stiffness  N/m  \param tail  as in HertzContact
  LinearContact(const Materials& materials, double stiffness, core::Tail tail)
      : stiffness_(stiffness), least_force_(tail == core::Tail::clip ? 0 : -std::numeric_limits<double>::infinity()) {
    for (const PairMaterial& m : materials.kinds()) {
      const double beta = tail == core::Tail::clip ? closures::damping_ratio_clipped(m.restitution)
                                                   : closures::damping_ratio_kept(m.restitution);
      constants_.push_back({m.mass, closures::linear_damping(beta, stiffness, m.mass), beta});
    }
  }

  void act(ContactBatch& batch) const override {
    alignas(64) ContactBatch::Row dashpot = {};
    for (int c = 0; c < batch.count; ++c) dashpot[c] = constants_[std::size_t(batch.kind[c])].dashpot;
    core::in_vectors<linear>(batch, stiffness_, dashpot, least_force_);
  }
  [[nodiscard]] double energy(int, double overlap) const override {
    return closures::linear_stored_energy(stiffness_, overlap);
  }
  [[nodiscard]] double force_at(int, double overlap) const override { return stiffness_ * overlap; }
  [[nodiscard]] double contact_time(int kind, double) const override {
    const Constants& k = constants_[std::size_t(kind)];
    return closures::linear_contact_time(stiffness_, k.mass, 0);
  }
  [[nodiscard]] double overlap_of_impact(int kind, double speed) const override {
    return speed * std::sqrt(constants_[std::size_t(kind)].mass / stiffness_);
  }
  [[nodiscard]] double stiffness_at(int, double) const override { return stiffness_; }
  [[nodiscard]] double damping_ratio(int kind) const override { return constants_[std::size_t(kind)].damping; }

 private:
  struct Constants {
    double mass, dashpot, damping;  ///< m*, c, beta
  };
  std::vector<Constants> constants_;
  double stiffness_, least_force_;  ///< N/m; N: 0, or no limit
};

}  // namespace

namespace makers {

namespace {

bool contact_has(const PairMaking& m, const relevance::Trait& trait) {
  return relevance::effects::contact.law_has(m.law, trait);
}

constexpr double tangential_ratio = 2.0 / 7;  ///< k_t/k_n for linear springs: equal periods for a solid sphere

std::unique_ptr<TangentialLaw> make_tangential(const PairMaking& m, int place) {
  const core::Dem& dem = m.scene.dem;
  if (contact_has(m, relevance::effects::frictionless)) return nullptr;
  if (contact_has(m, relevance::effects::linear_springs))
    return std::make_unique<SpringFriction>(m.materials, dem.normal_stiffness.value(), tangential_ratio, place);
  if (dem.tangential == core::Tangential::mindlin) return std::make_unique<MindlinFriction>(m.materials, place);
  if (dem.tangential == core::Tangential::mindlin_deresiewicz)
    return std::make_unique<PartialSlipFriction>(m.materials, place);
  return std::make_unique<SpringFriction>(m.materials, place);
}

void make_contact(const PairMaking& m) {
  const MakeNormal make = [&](const Materials& materials, core::Tail tail) -> std::unique_ptr<NormalLaw> {
    if (!contact_has(m, relevance::effects::linear_springs)) return std::make_unique<HertzContact>(materials, tail);
    return std::make_unique<LinearContact>(materials, m.scene.dem.normal_stiffness.value(), tail);
  };
  m.laws.normal = m.around_normal ? m.around_normal(make) : make(m.materials, m.scene.dem.tail);
  m.laws.tangential = make_tangential(m, m.laws.normal->memory_size());
}

core::Rule linear_has_no_radius(core::Tangential tangential) {
  return {{"dem.tangential", "effects.contact"},
          "dem.tangential = \"" + std::string(core::name_of(tangential)) +
              "\" needs the radius of a contact, which effects.contact = \"linear\" has not: use hertz_mindlin, or "
              "dem.tangential = \"linear\"",
          [tangential](const core::Scene& scene) {
            return core::broken_if(relevance::effects::contact.has(scene, relevance::effects::linear_springs) &&
                                   scene.dem.tangential == tangential);
          }};
}

std::vector<core::Rule> contact_rules() {
  return {relevance::rule_of_law("contact", "linear", {"dem.normal_stiffness"},
                                 "dem.normal_stiffness: effects.contact = \"linear\" needs it, as in \"1000 N/m\"",
                                 [](const core::Scene& scene) { return !scene.dem.normal_stiffness; }),
          linear_has_no_radius(core::Tangential::mindlin),
          linear_has_no_radius(core::Tangential::mindlin_deresiewicz),
          {{"dem.tangential", "effects.contact"},
           "dem.tangential = \"linear\" is a share of dem.normal_stiffness: it goes with effects.contact = "
           "\"linear\"",
           [](const core::Scene& scene) {
             using namespace relevance::effects;
             return core::broken_if(contact.has(scene, elastic_spheres) && !contact.has(scene, frictionless) &&
                                    scene.dem.tangential == core::Tangential::linear);
           }}};
}

}  // namespace

extern const Maker contact;
const Maker contact{&relevance::effects::contact, "Pair", MakePair(make_contact), contact_rules()};

}  // namespace makers

}  // namespace polybed::dem
