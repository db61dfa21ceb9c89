// Runs of the particle model as a trial sees them: number, finiteness and the account of energy at every look.
#pragma once

#include <cstdint>
#include <optional>

#include "dem/measures.hpp"
#include "dem/model.hpp"
#include "hard/hard_case.hpp"

namespace polybed::hard {

/// Beside the number of particles, V1, finiteness, V3, and the ledger, V5: closed within 1e-3 of the greatest energy
/// met.
struct GrainWatch {
  double cpu = 1e300;  ///< s of computing, after which a run ends where it is; below it also where it fails
};

/// Keeps the figures of a model in a trial.
class Grains {
 public:
  Grains(Trial& trial, dem::Model& model, GrainWatch watch = {});

  /// Steps as many times, with a look at every `every`-th state and at the last; false if computing took too long.
  bool steps(std::int64_t number, std::int64_t every = 64);
  /// To the step nearest to a time, s.
  bool until(double time, std::int64_t every = 64);
  /// A look at the present state.
  void see();
  /// Whether a run that began at `begin`, s of computing, is to end here: it has failed or had its time.
  [[nodiscard]] bool over(double begin) const;

 private:
  Trial& trial_;
  dem::Model& model_;
  GrainWatch watch_;
  std::int64_t count_ = 0;
  std::optional<double> initial_energy_;
  double greatest_energy_ = 0;  ///< J
};

}  // namespace polybed::hard
