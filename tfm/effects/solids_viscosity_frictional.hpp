// Slot Stress: shear viscosity of packed solids from their frictional pressure, by Schaeffer or by mu(I).
#pragma once

#include "closures/frictional_viscosity.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// mu_s from p_f of the cell, the mean diameter and density of its solids, and |gamma|^2 = sum_j x_j 2 D'_j:D'_j.
class FrictionalViscosity : public SolidsViscosity {
 public:
  FrictionalViscosity(const core::Scene& scene, const Constants& constants, const std::string& law, Fields& fields);
  void add(Fields& fields) override;

 private:
  const Constants& constants_;
  bool inertial_;  ///< mu(I), else Schaeffer
  closures::InertialFriction friction_;
  double sine_, cap_, least_rate_;
};

}  // namespace polybed::tfm
