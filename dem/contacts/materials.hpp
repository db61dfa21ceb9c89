// Materials of particles and walls, and the contact constants of each pair.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::dem {

struct Species {
  std::string name;
  double radius = 0, mass = 0, inertia = 0;  ///< m, kg, kg m2
  double density = 0;                        ///< kg/m3
};

/// A pair of materials in contact.
struct PairMaterial {
  double radius = 0, mass = 0;                   ///< reduced: R*, m*
  double youngs_modulus = 0, shear_modulus = 0;  ///< reduced: E*, G*, Pa
  double restitution = 0, friction = 0;
  double least_radius = 0;     ///< of the two, m
  double rolling_inertia = 0;  ///< of rolling about the contact, kg m2
};

class Materials {
 public:
  explicit Materials(const core::Scene& scene);

  [[nodiscard]] const std::vector<Species>& species() const { return species_; }
  [[nodiscard]] const std::vector<PairMaterial>& kinds() const { return kinds_; }
  /// Index in kinds() of two species, in either order.
  [[nodiscard]] std::int32_t kind(std::int32_t a, std::int32_t b) const { return a * stride_ + b; }
  /// Likewise for a species and the walls. \param curve  for a round wall, from Plate::curve_at()
  [[nodiscard]] std::int32_t wall_kind(std::int32_t a, std::int32_t curve = 0) const {
    return a * stride_ + std::int32_t(species_.size()) + curve;
  }
  /// Calls act(kind) for each kind of a species and the walls.
  template <class Act>
  void each_wall_kind(std::int32_t a, Act&& act) const {
    for (std::int32_t kind = wall_kind(a); kind < (a + 1) * stride_; ++kind) act(kind);
  }
  /// The kind with the greatest reduced radius.
  [[nodiscard]] std::int32_t stiffest_wall_kind(std::int32_t a) const;
  /// The same with one restitution for all pairs.
  [[nodiscard]] Materials with_restitution(double restitution) const {
    Materials changed = *this;
    for (PairMaterial& pair : changed.kinds_) pair.restitution = restitution;
    return changed;
  }
  [[nodiscard]] double least_diameter() const;
  [[nodiscard]] double greatest_diameter() const;

 private:
  std::int32_t stride_;
  std::vector<Species> species_;
  std::vector<PairMaterial> kinds_;  ///< [species][species, then a flat wall, then the curvatures of round walls]
};

}  // namespace polybed::dem
