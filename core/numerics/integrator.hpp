// Time integration with error control, by SUNDIALS: explicit Runge-Kutta (ARKODE) and implicit BDF (IDA).
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/numerics/ranks.hpp"

namespace polybed::core {

/// Sets the absolute tolerances, entry by entry; they can depend on the state. A step's errors are weighed by them and
/// a relative tolerance. Collective. \param y  this rank's state  \param dydt  its rates with the implicit integrator,
/// else empty
using TolerancesAt =
    std::function<void(std::span<const double> y, std::span<const double> dydt, std::span<double> atol)>;

/// Sets weight_i = 1/(rtol |y_i| + atol_i) with the tolerances at y. \param weight  work space until then
inline void weigh_errors(double rtol, const TolerancesAt& atol, std::span<const double> y, std::span<const double> dydt,
                         std::span<double> weight) {
  atol(y, dydt, weight);
  for (std::size_t n = 0; n < y.size(); ++n) weight[n] = 1 / (rtol * std::abs(y[n]) + weight[n]);
}

/// Result of an evaluation: success, or retry with a smaller step. Integrator::step passes on exceptions from a
/// problem.
enum class Rate { ok, recoverable };

/// dy/dt = f(t, y).
class OdeProblem {
 public:
  virtual ~OdeProblem() = default;
  virtual Rate rates(double t, std::span<const double> y, std::span<double> dydt) = 0;
};

/// dy/dt = f(t, y) with a linear part A y that is too fast for explicit steps; A is constant during a step.
class SplitProblem : public OdeProblem {
 public:
  /// Takes the coefficients of A from the state of the last call to rates().
  virtual void hold() = 0;
  /// Adds `factor` times A y to `rates`.
  virtual void add_fast(double factor, std::span<const double> y, std::span<double> rates) = 0;
  /// The longest step, s, that the rest of f allows at that state; very large without a limit.
  [[nodiscard]] virtual double longest_step() const = 0;
  /// Solves x - gamma A x = r in place; x contains r at first.
  virtual void solve_fast(double gamma, std::span<double> x) = 0;
};

/// 0 = F(t, y, dy/dt), with an approximate inverse of dF/dy + cj dF/d(dy/dt).
class DaeProblem {
 public:
  virtual ~DaeProblem() = default;
  virtual Rate residual(double t, std::span<const double> y, std::span<const double> dydt, std::span<double> r) = 0;
  virtual Rate setup(double t, std::span<const double> y, std::span<const double> dydt, std::span<const double> r,
                     double cj) = 0;
  virtual Rate precondition(double t, std::span<const double> r, std::span<double> z, double cj, double delta) = 0;
};

/// One accepted step.
struct StepReport {
  double time = 0, step = 0, next_step = 0;  ///< s
  double error_norm = 0;                     ///< weighted root mean square of the local error; accepted below 1
  std::size_t worst_entry = 0;               ///< where this rank's weighted local error is largest
  double worst_error = 0;                    ///< that error over its weight
  int order = 0;
};

/// Counts since the integrator was made; they repeat exactly.
struct IntegratorStatistics {
  std::uint64_t steps = 0, error_failures = 0, recoverable_failures = 0, newton_iterations = 0, newton_failures = 0,
                linear_iterations = 0, preconditioner_setups = 0;
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Takes one accepted step from the present time, at most to t_stop, which it reaches exactly. Throws NumericsError
  /// with the library's reason if no step succeeds.
  virtual StepReport step(double t_stop) = 0;
  /// The solution at a time inside the last step.
  virtual void interpolate(double t, std::span<double> y) const = 0;
  [[nodiscard]] virtual std::span<const double> state() const = 0;
  [[nodiscard]] virtual std::span<const double> derivative() const = 0;  ///< implicit only; else empty
  /// Starts anew from (t, y). The further solution depends on the arguments alone, to the bit.
  /// \param dydt  consistent rates (implicit only)  \param h0  first step, s; 0: the integrator chooses
  virtual void restart(double t, std::span<const double> y, std::span<const double> dydt, double h0) = 0;
  [[nodiscard]] virtual IntegratorStatistics statistics() const = 0;
  /// Memory of its vectors, bytes, without the linear solver's.
  [[nodiscard]] virtual std::size_t workspace() const = 0;
};

struct ExplicitOptions {
  double rtol = 1e-4;
  std::vector<double> atol;                      ///< per entry
  double fixed_step = 0;                         ///< s; > 0: steps of one length, no error control
  std::shared_ptr<const Ranks> ranks = nullptr;  ///< ranks with parts of the state; null: it is all here
  TolerancesAt atol_at = {};                     ///< in place of atol, which then gives only the size; empty: atol
};

struct ImplicitOptions {
  double rtol = 1e-4;
  std::vector<double> atol;                      ///< per entry
  std::vector<double> id;                        ///< 1: differential, 0: algebraic (left out of the error test)
  std::shared_ptr<const Ranks> ranks = nullptr;  ///< ranks with parts of the state; null: it is all here
  int max_order = 2;
  double linear_tolerance = 0.05;  ///< of the linear solve, relative to Newton's; IDA's default
  int krylov_vectors = 30;
  TolerancesAt atol_at = {};  ///< in place of atol, which then gives only the size; empty: atol
};

/// Bogacki and Shampine's method of order 3 with its embedded error estimate (ARKODE).
std::unique_ptr<Integrator> make_explicit(OdeProblem& problem, ExplicitOptions options);

/// Kennedy and Carpenter's additive pair ARK3(2)4L[2]SA of order 3 (ARKODE): A y by its implicit method, which is
/// L-stable, the rest by its explicit one.
std::unique_ptr<Integrator> make_split(SplitProblem& problem, ExplicitOptions options);

/// Backward differences of variable order with Newton and preconditioned GMRES (IDA).
std::unique_ptr<Integrator> make_implicit(DaeProblem& problem, ImplicitOptions options);

}  // namespace polybed::core
