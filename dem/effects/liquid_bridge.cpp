// Capillary force by liquid bridges between wet particles in a gas, closures/liquid_bridge_willett.hpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "closures/liquid_bridge_willett.hpp"
#include "closures/sphere.hpp"
#include "core/vectors.hpp"
#include "dem/effects.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/rows.hpp"
#include "relevance/effects/liquid_bridge.hpp"

namespace polybed::dem {

namespace {

using Row = ContactBatch::Row;

/// For a pair of materials.
struct BridgeConstants {
  double pull = 0;     ///< greatest force, N
  double stretch = 0;  ///< sqrt(R/V), 1/m
  double rupture = 1;  ///< gap, m
};

struct BridgeRows {
  alignas(64) Row pull = {}, stretch = {}, rupture;
  BridgeRows() { std::fill_n(rupture, ContactBatch::width, 1.0); }
};

void pull_together(ContactBatch& b, int place, const BridgeRows& bridge, double dt) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double memory = neck_memory(b.memory[place][c], b.overlap[c], bridge.rupture[c], b.speed[c] * dt);
    b.memory[place][c] = memory;
    b.normal[c] +=
        neck_weight(memory) * closures::liquid_bridge_force(bridge.pull[c], bridge.stretch[c], -b.overlap[c]);
  }
}

/// A bridge forms at first contact and exists until the gap exceeds the rupture distance: the memory is whether it
/// exists. Every bridge of a pair of materials has the same volume; a ruptured bridge's liquid returns to its surfaces.
/// The energy that a forming bridge releases is lost, and counted then.
class WillettBridge final : public CohesionLaw {
 public:
  /// \param place  index of its memory in a batch
  WillettBridge(const Materials& materials, const core::Material& liquid, double step, int place)
      : step_(step), place_(place), constants_(materials.kinds().size()) {
    const double angle = liquid.contact_angle * std::numbers::pi / 180;
    const auto& species = materials.species();
    const auto film = [&](const Species& s, double partner) {
      return liquid.liquid_fraction * closures::sphere_volume(s.radius) * closures::covered_share(s.radius, partner);
    };
    const auto set = [&](std::int32_t kind, double volume) {
      const double radius = 2 * materials.kinds()[std::size_t(kind)].radius;
      constants_[std::size_t(kind)] = {closures::liquid_bridge_pull(radius, *liquid.surface_tension, angle),
                                       std::sqrt(radius / volume), closures::liquid_bridge_rupture(volume, angle)};
    };
    for (std::int32_t a = 0; a < std::int32_t(species.size()); ++a) {
      const Species& s = species[std::size_t(a)];
      materials.each_wall_kind(a,
                               [&](std::int32_t kind) { set(kind, film(s, std::numeric_limits<double>::infinity())); });
      for (std::int32_t b = 0; b < std::int32_t(species.size()); ++b) {
        const Species& other = species[std::size_t(b)];
        set(materials.kind(a, b), film(s, other.radius) + film(other, s.radius));
      }
    }
  }

  void act(ContactBatch& batch, double dt) const override {
    BridgeRows rows;
    for (int c = 0; c < batch.count; ++c) {
      const BridgeConstants& k = constants_[std::size_t(batch.kind[c])];
      rows.pull[c] = k.pull;
      rows.stretch[c] = k.stretch;
      rows.rupture[c] = k.rupture;
    }
    core::in_vectors<pull_together>(batch, place_, rows, dt);
  }

  [[nodiscard]] int memory_size() const override { return 1; }
  void add_energy(const ContactBatch& batch, Row& stored, double dt) const override {
    for (int c = 0; c < batch.count; ++c) {
      const BridgeConstants& k = constants_[std::size_t(batch.kind[c])];
      const double memory = batch.memory[place_][c], gap = -batch.overlap[c];
      if (memory > 0) stored[c] += closures::liquid_bridge_energy(k.pull, k.stretch, k.rupture, gap);
      stored[c] -= closures::liquid_bridge_force(k.pull, k.stretch, gap) * neck_owed(memory, batch.speed[c] * dt);
    }
  }
  void add_loss(const ContactBatch& batch, Row& lost) const override {
    for (int c = 0; c < batch.count; ++c) {
      const BridgeConstants& k = constants_[std::size_t(batch.kind[c])];
      if (batch.overlap[c] >= 0 && !(batch.memory[place_][c] > 0))
        lost[c] -= closures::liquid_bridge_energy(k.pull, k.stretch, k.rupture, 0);
    }
  }
  [[nodiscard]] double reach() const override {
    double most = 0;
    for (const BridgeConstants& k : constants_) most = std::max(most, k.rupture);
    return most + step_;
  }
  [[nodiscard]] double pull_off(int kind) const override { return constants_[std::size_t(kind)].pull; }

 private:
  double step_;
  int place_;
  std::vector<BridgeConstants> constants_;
};

}  // namespace

namespace makers {

extern const Maker liquid_bridge;
const Maker liquid_bridge{&relevance::effects::liquid_bridge, "Pair", MakePair([](const PairMaking& m) {
                            m.laws.bridge = std::make_unique<WillettBridge>(m.materials, m.scene.material,
                                                                            longest_step(m.scene, m.materials),
                                                                            m.laws.memory_size());
                          })};

}  // namespace makers

}  // namespace polybed::dem
