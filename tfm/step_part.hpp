// Parts of a model's steps that only some scenes need: a compressible fluid, a jump of the inlet, solids that fill only
// part of the column.
#pragma once

#include <cstdint>
#include <span>

namespace polybed::core {
struct Checkpoint;
}

namespace polybed::tfm {

/// Work done by a run so far. Repeats exactly from run to run.
struct Work {
  std::uint64_t steps = 0, rejected_steps = 0, right_hand_sides = 0, pressure_solves = 0, pressure_iterations = 0,
                newton_iterations = 0, krylov_iterations = 0, first_order_cells = 0;
};

/// The model keeps a list of the parts that its scene needs, and calls each of them once at every point of a step.
/// Others cost nothing. Times in s; `y` is the state on this rank. All hooks are collective.
class StepPart {
 public:
  virtual ~StepPart() = default;

  // At the start of a run, from the state of another, or after a breakpoint.
  virtual void start(double /*time*/, std::span<double> /*y*/) {}
  virtual void begin_from_other(double /*time*/, std::span<const double> /*y*/) {}
  virtual void restart(double /*time*/, std::span<double> /*y*/) {}

  // In the order of a step.
  /// Before the first evaluation of an integration or of a step.
  virtual void prepare(std::span<const double> /*y*/) {}
  /// Once an integration has its rates, which are in the fields.
  virtual void begin(double /*time*/) {}
  /// Throws core::NumericsError if a run cannot continue from the state after a step; the model then restores the state
  /// before it.
  virtual void accept(double /*time*/, std::span<const double> /*y*/) {}
  /// After a step that all have accepted.
  virtual void end_step(std::span<const double> /*y*/) {}

  /// Adds its counts.
  virtual void count(Work&) const {}

  virtual void write(core::Checkpoint&, double /*time*/) const {}
  /// Texts and numbers come from the first rank's checkpoint, arrays from this rank's.
  virtual void read(const core::Checkpoint&, double /*time*/) {}
};

}  // namespace polybed::tfm
