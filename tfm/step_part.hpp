// What takes part in the steps of a model where a scene has it: a compressible fluid, a jump of the inlet, solids that
// fill only part of the column.
#pragma once

#include <cstdint>
#include <span>

namespace polybed::core {
struct Checkpoint;
}

namespace polybed::tfm {

/// What a run has done so far. Repeats exactly from run to run.
struct Work {
  std::uint64_t steps = 0, rejected_steps = 0, right_hand_sides = 0, pressure_solves = 0, pressure_iterations = 0,
                newton_iterations = 0, krylov_iterations = 0, first_order_cells = 0;
};

/// The model holds a list of those that its scene has, and calls each of them once at every point of a step: what a
/// scene has not costs nothing. Times in s; `y` is the state of this rank. All hooks are collective.
class StepPart {
 public:
  virtual ~StepPart() = default;

  // Where a run begins, begins from the state of another, or goes on behind a breakpoint.
  virtual void start(double /*time*/, std::span<double> /*y*/) {}
  virtual void begin_from_other(double /*time*/, std::span<const double> /*y*/) {}
  virtual void restart(double /*time*/, std::span<double> /*y*/) {}

  // In the order of a step.
  /// Before the first evaluation of an integration or of a step.
  virtual void prepare(std::span<const double> /*y*/) {}
  /// Once an integration has its rates, which stand in the fields.
  virtual void begin(double /*time*/) {}
  /// Throws core::NumericsError where a run cannot go on from the state that a step leaves; the model then goes back
  /// to the state before it.
  virtual void accept(double /*time*/, std::span<const double> /*y*/) {}
  /// After a step that all have accepted.
  virtual void end_step(std::span<const double> /*y*/) {}

  /// Adds what it has counted.
  virtual void count(Work&) const {}

  virtual void write(core::Checkpoint&, double /*time*/) const {}
  /// Texts and numbers of the checkpoint are the first rank's, arrays those of this rank.
  virtual void read(const core::Checkpoint&, double /*time*/) {}
};

}  // namespace polybed::tfm
