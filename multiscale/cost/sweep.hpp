// Error against time for one case: what was run, what it is measured against, and what follows.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "multiscale/cost/axes.hpp"
#include "multiscale/cost/fit.hpp"
#include "multiscale/cost/quantities.hpp"
#include "multiscale/cost/runner.hpp"

namespace polybed::multiscale {

struct SweepOptions {
  std::string model = "tfm";
  std::vector<std::string> quantities, axes;  ///< the first quantity ranks; empty: by default
  double target = 0.01;                       ///< error
  double budget = 1200;                       ///< wall time, s
  int repeat = 5;
  std::string clock = "work";      ///< work | cpu | wall
  std::string reference = "auto";  ///< auto | exact | a directory of a run
  std::uint64_t seed = 1;
  bool quiet = false;
};

/// A quantity of a run with its distance from the reference, both with the half-width of a 95 % interval.
struct RowQuantity {
  double value = 0, error = 0;
  std::optional<double> interval, error_interval;
};

/// What a row stands for.
enum class RowKind { candidate, model, machine, reference, twin, solver, input };

struct Row {
  RowKind kind = RowKind::candidate;
  Settings settings{};
  std::string note{};  ///< of what is not told by the settings: "temperature + 1 K"
  RunOrder order{};
  RunOutcome outcome{};
  RunQuantities measured{};
  std::map<std::string, RowQuantity> quantities{};
  double rate = 0;            ///< s for a simulated second, by the clock
  std::vector<double> cpu{};  ///< s, of the run and its repetitions
  std::optional<Priced> predicted{};
  std::string status{};  ///< pareto | dominated | hollow | model | predicted | failed | refused | not run
  [[nodiscard]] bool done() const { return outcome.done(); }
};

struct Reference {
  std::string kind;  ///< exact | self | extrapolated | statistical | directory; empty: none
  std::string note;
  std::map<std::string, double> value, floor, band;  ///< of errors: below the floor nothing is ranked
  measures::Profile profile;
};

struct Share {
  std::string row;
  std::optional<double> value;  ///< of the first quantity's error; empty: not run
  std::string note;
  std::vector<std::string> axes = {};  ///< that would measure it, of a row that no axis run has measured
};

struct Recommendation {
  double target = 0;
  std::size_t row = 0;
  bool confirmed = false;
};

struct Sweep {
  SweepOptions options;
  std::vector<Axis> axes;
  std::vector<QuantityInfo> quantities;
  MeasureOn on;
  std::vector<Row> rows;
  std::string outcome = "done", reason;  ///< done | refused | failed
  std::string regime = "steady";         ///< steady | chaotic
  Reference reference;
  std::optional<PowerLaw> error_of_rtol, error_of_grid, cost_of_rtol, cost_of_grid;
  std::optional<double> additive_off;
  std::vector<Share> attribution, inputs;
  std::optional<Recommendation> recommendation;
  std::vector<std::string> warnings;

  [[nodiscard]] const std::string& ranking() const { return options.quantities.front(); }
};

/// Runs the sweep; collective with nobody: one process that starts others.
[[nodiscard]] Sweep run_sweep(const core::Scene& scene, SweepOptions options, Runner& runner);

/// What every run of a sweep is given beside its settings, so that all store the same.
[[nodiscard]] std::vector<std::string> common_overrides(const core::Scene& scene);

}  // namespace polybed::multiscale
