// Moments that resist rolling, rolling_friction.hpp, from the part of w_i - w_j in the plane of contact: twisting about
// n is free.
#include <vector>

#include "closures/contact_tangential.hpp"
#include "closures/rolling_friction.hpp"
#include "core/vectors.hpp"
#include "dem/effects.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/rows.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/effects/rolling.hpp"

namespace polybed::dem {

namespace {

using closures::Vec3;
using Row = ContactBatch::Row;

/// w_i - w_j without its part along n.
Vec3 rolling_of(const ContactBatch& b, int c) {
  const Vec3 n = at(b.distance, c), spin = at(b.spin_i, c) - at(b.spin_j, c);
  return spin - closures::dot(spin, n) * n;
}

/// k_n = F_n/delta of the elastic force; 0 across a gap.
double secant_stiffness(const ContactBatch& b, int c) {
  return b.overlap[c] > 0 ? b.elastic[c] / (b.overlap[c] > 0 ? b.overlap[c] : 1.0) : 0;
}

void roll_constant(ContactBatch& b, const Row& arm) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double limit = closures::rolling_limit(1, arm[c], b.normal[c]);
    put(b.moment, c, closures::rolling_cdt(limit, rolling_of(b, c)));
  }
}

void roll_spring(ContactBatch& b, int place, const Row& arm, const Row& inertia, double damping, double dt) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double stiffness = closures::rolling_stiffness(secant_stiffness(b, c), 1, arm[c]);
    const double dashpot = closures::rolling_damping(damping, inertia[c], stiffness);
    const Vec3 before = closures::transported(at(b.memory + place, c), at(b.distance, c));
    const double limit = closures::rolling_limit(1, arm[c], b.normal[c]);
    const closures::RollingMoment m =
        closures::rolling_epsd(before, rolling_of(b, c), stiffness, dashpot, limit, time_of_contact(b, c, dt));
    put(b.memory + place, c, m.spring);
    put(b.moment, c, m.moment);
  }
}

/// A constant moment mu_r R* F_n against the rolling. No memory; at rest it oscillates with the sign of the spin.
class ConstantRolling final : public RollingLaw {
 public:
  ConstantRolling(const Materials& materials, double rolling_friction) {
    for (const PairMaterial& m : materials.kinds()) arm_.push_back(rolling_friction * m.radius);
  }
  void act(ContactBatch& batch, double) const override {
    alignas(64) Row arm = {};
    for (int c = 0; c < batch.count; ++c) arm[c] = arm_[std::size_t(batch.kind[c])];
    core::in_vectors<roll_constant>(batch, arm);
  }
  [[nodiscard]] int memory_size() const override { return 0; }
  void add_energy(const ContactBatch&, ContactBatch::Row&) const override {}
  [[nodiscard]] double stiffness(int, double) const override { return 0; }

 private:
  std::vector<double> arm_;  ///< mu_r R*, m
};

/// A rotational spring k_r = 2.25 k_n mu_r^2 R*^2 with a dashpot, limited to mu_r R* F_n; k_n is the elastic force over
/// the overlap. The memory is the spring's moment, which rotates with the pair.
class SpringRolling final : public RollingLaw {
 public:
  /// \param damping  share of the critical damping  \param place  index of its memory in a batch
  SpringRolling(const Materials& materials, double rolling_friction, double damping, int place)
      : damping_(damping), place_(place) {
    for (const PairMaterial& m : materials.kinds())
      constants_.push_back({rolling_friction * m.radius, m.rolling_inertia});
  }
  void act(ContactBatch& batch, double dt) const override {
    alignas(64) Row arm = {}, inertia = {};
    for (int c = 0; c < batch.count; ++c) {
      const Constants& k = constants_[std::size_t(batch.kind[c])];
      arm[c] = k.arm;
      inertia[c] = k.inertia;
    }
    core::in_vectors<roll_spring>(batch, place_, arm, inertia, damping_, dt);
  }

  [[nodiscard]] int memory_size() const override { return 3; }
  void add_energy(const ContactBatch& batch, Row& stored) const override {
    for (int c = 0; c < batch.count; ++c) {
      const Vec3 kept = at(batch.memory + place_, c);
      const double k = stiffness(batch.kind[c], secant_stiffness(batch, c));
      stored[c] += 0.5 * closures::dot(kept, kept) / (k > tiny ? k : tiny);
    }
  }

  [[nodiscard]] double stiffness(int kind, double normal_stiffness) const override {
    return closures::rolling_stiffness(normal_stiffness, 1, constants_[std::size_t(kind)].arm);
  }

 private:
  struct Constants {
    double arm, inertia;  ///< mu_r R*, m; I_r, kg m2
  };
  std::vector<Constants> constants_;
  double damping_;
  int place_;
};

}  // namespace

namespace makers {

namespace {

std::vector<core::Rule> rolling_rules() {
  return {relevance::rule_of("rolling", {"dem.rolling_friction"},
                             "dem.rolling_friction: effects.rolling = \"{}\" needs it, above 0",
                             [](const core::Scene& scene) { return !(scene.dem.rolling_friction > 0); }),
          {{"dem.rolling_damping", "effects.rolling"},
           "dem.rolling_damping: effects.rolling = \"cdt\" has no spring to damp; use epsd",
           [](const core::Scene& scene) {
             return core::broken_if(relevance::effects::rolling.has(scene, relevance::effects::without_spring) &&
                                    scene.dem.rolling_damping > 0);
           }}};
}

const PairMakers resistances{{"cdt",
                              [](const PairMaking& m) {
                                m.laws.rolling =
                                    std::make_unique<ConstantRolling>(m.materials, m.scene.dem.rolling_friction);
                              }},
                             {"epsd", [](const PairMaking& m) {
                                const core::Dem& dem = m.scene.dem;
                                m.laws.rolling = std::make_unique<SpringRolling>(
                                    m.materials, dem.rolling_friction, dem.rolling_damping, m.laws.contact_memory());
                              }}};

}  // namespace

extern const Maker rolling;
const Maker rolling{&relevance::effects::rolling, "Pair",
                    MakePair([](const PairMaking& m) { resistances.at(m.law)(m); }), rolling_rules()};

}  // namespace makers

}  // namespace polybed::dem
