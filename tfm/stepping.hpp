// Time stepping of a model: the integrator for a scene, and the form of its equations.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/numerics/integrator.hpp"
#include "core/timers.hpp"
#include "tfm/right_hand_side.hpp"
#include "tfm/step_limits.hpp"
#include "tfm/step_part.hpp"
#include "tfm/tolerances.hpp"

namespace polybed::tfm {

struct IntegratorChoice {
  core::TfmIntegrator kind{};  ///< never automatic
  std::string reason;
};

/// The rule uses measured costs, docs/record/cost.md. A liquid bed is cheaper with steps that take only the drag
/// implicitly, unless one fully implicit step replaces more than 1.5 of them because the solids' pressure limits them.
/// A bed that settles or is fluidised by a gas is cheaper with fully implicit steps. Throws core::StartError if the
/// integrator cannot run the scene.
/// \param greatest_inflow  superficial velocity of the inlet, m/s
[[nodiscard]] IntegratorChoice choose_integrator(const core::Scene& scene, const Constants& constants,
                                                 const Effects& effects, double greatest_inflow);

class Stepping {
 public:
  Stepping(RightHandSide& equations, const StateLayout& layout) : equations_(equations), layout_(layout) {}
  Stepping(const Stepping&) = delete;
  Stepping& operator=(const Stepping&) = delete;
  virtual ~Stepping() = default;

  /// Called at the start of an integration at (t, y): completes y, and computes its rates if the integrator needs them.
  virtual void find_rates(double t, std::span<double> y, std::span<double> dydt) = 0;
  /// The length of the first step, s, after find_rates(); 0: the integrator chooses. Collective.
  [[nodiscard]] virtual double first_step(std::span<const double> /*y*/, std::span<const double> /*dydt*/) const {
    return 0;
  }
  /// Called before an integration begins and before each step, with the expected length, s.
  virtual void begin_step(double /*length*/) {}
  /// Time scales of the processes that can limit a step, from the fields of a finished evaluation.
  [[nodiscard]] virtual std::vector<TimeScale> time_scales() const;
  /// Adds the counts of the integrator and its problem.
  virtual void count(Work& work) const;

  [[nodiscard]] core::Integrator& integrator() const { return *integrator_; }

 protected:
  /// Sets the pressure to 0 in a state or its rates.
  void clear_pressure(std::span<double> of) const;

  RightHandSide& equations_;
  const StateLayout& layout_;
  std::unique_ptr<core::Integrator> integrator_;
  bool split_ = false;  ///< the drag is implicit
};

/// Depends on the integrator, never automatic, and on whether the fluid is compressible.
/// \param equations, layout  must outlive the result
[[nodiscard]] std::unique_ptr<Stepping> make_stepping(core::TfmIntegrator kind, RightHandSide& equations,
                                                      const StateLayout& layout, const core::Tfm& options,
                                                      Tolerances tolerances, core::Timers& timers);

}  // namespace polybed::tfm
