// Textbook changes of what is integrated, or of how an implicit step is solved, around a problem of the product.
#pragma once

#include "core/numerics/integrator.hpp"
#include "tfm/model.hpp"

namespace polybed::hard::naive {

/// Momentum per volume m = phi U as the unknown in the place of U: U = m/max(phi, floor), with the same floor for all,
/// in the product's implicit system.
class MomentumUnknowns : public core::DaeProblem {
 public:
  static constexpr double floor = 1e-10;
  MomentumUnknowns(core::DaeProblem& inner, const tfm::Model& model, const tfm::StateLayout& layout);

  core::Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) override;
  core::Rate setup(double t, std::span<const double> y, std::span<const double> dydt, std::span<const double> r,
                   double cj) override;
  core::Rate precondition(double t, std::span<const double> r, std::span<double> z, double cj, double delta) override;

  /// The state, or its rate, with velocities from one with momenta, and back.
  void to_velocity(std::span<const double> momenta, std::span<double> velocities);
  void to_momentum(std::span<const double> velocities, std::span<double> momenta);
  /// dm = phi dU + U dphi at the state last converted, and back.
  void change_to_momentum(std::span<const double> of_velocity, std::span<double> of_momentum);
  void change_to_velocity(std::span<const double> of_momentum, std::span<double> of_velocity);

 private:
  void load(std::span<const double> y, fluid::Interphase& solids);
  core::DaeProblem& inner_;
  const tfm::Model& model_;
  const tfm::StateLayout& layout_;
  fluid::Interphase solids_, change_;
  fluid::FluidState fluid_;
  std::vector<double> velocities_, zero_, rates_;
};

/// A fraction at or below 0 does not fall: its rate is clipped, and its residual says so.
class ClippedRates : public core::DaeProblem {
 public:
  ClippedRates(core::DaeProblem& inner, const tfm::StateLayout& layout) : inner_(inner), layout_(layout) {}
  core::Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) override;
  core::Rate setup(double t, std::span<const double> y, std::span<const double> dydt, std::span<const double> r,
                   double cj) override {
    return inner_.setup(t, y, dydt, r, cj);
  }
  core::Rate precondition(double t, std::span<const double> r, std::span<double> z, double cj, double delta) override {
    return inner_.precondition(t, r, z, cj, delta);
  }

 private:
  core::DaeProblem& inner_;
  const tfm::StateLayout& layout_;
};

/// Continuity rows are preconditioned by their diagonal, c + sum of what flows out of the cell, whose column sums are
/// not those of the equations; all other rows as in the product.
class JacobiContinuity : public core::DaeProblem {
 public:
  JacobiContinuity(core::DaeProblem& inner, const tfm::RightHandSide& equations, const tfm::StateLayout& layout)
      : inner_(inner), equations_(equations), layout_(layout), diagonal_(layout.size()) {}
  core::Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) override {
    return inner_.residual(t, y, dydt, r);
  }
  core::Rate setup(double t, std::span<const double> y, std::span<const double> dydt, std::span<const double> r,
                   double cj) override;
  core::Rate precondition(double t, std::span<const double> r, std::span<double> z, double cj, double delta) override;

 private:
  core::DaeProblem& inner_;
  const tfm::RightHandSide& equations_;
  const tfm::StateLayout& layout_;
  std::vector<double> diagonal_;
};

}  // namespace polybed::hard::naive
