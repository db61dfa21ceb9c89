// The course of a sweep: lines, reference, front, attribution, within a budget.
#pragma once

#include "multiscale/cost/sweep.hpp"

namespace polybed::multiscale {

class Sweeper {
 public:
  Sweeper(const core::Scene& scene, SweepOptions options, Runner& runner);
  Sweep make() &&;

 private:
  /// Runs what is not among the rows yet; returns its place. \param most  share of the budget that it may be expected to take
  std::size_t run(Row row, double most = 1);
  [[nodiscard]] RunOrder order_of(const Settings& settings) const;
  [[nodiscard]] double expected_wall(const Settings& settings) const;
  [[nodiscard]] double grid_ratio(const Axis& grid, std::size_t level) const;
  [[nodiscard]] double left() const;
  [[nodiscard]] std::optional<std::size_t> find(const RunOrder& order, RowKind kind) const;
  [[nodiscard]] const Axis* axis(const std::string& name) const;
  [[nodiscard]] Settings centre_with(const std::string& axis, std::size_t level) const;
  void take_force_balance(Row& row) const;

  bool find_regime();
  void run_lines(AxisKind kind);
  void find_reference();
  void exact_reference();
  void statistical_reference();
  void additive_reference();
  void add_space(const Axis& grid);
  void refuse(const std::string& reason);
  /// Two levels beyond the finest on each numerical axis but the grid, with more settings on top.
  [[nodiscard]] RunOrder tight(const std::vector<std::string>& more) const;
  [[nodiscard]] std::vector<std::string> other_family(const Row& row) const;

  void fit_laws();
  [[nodiscard]] double line_error(const std::string& axis, std::size_t level) const;
  [[nodiscard]] double line_cost(const std::string& axis, std::size_t level) const;
  void run_front();
  void compare_predictions();
  void repeat_for_time();
  void run_solver();
  void run_inputs();
  void attribute();
  void attribute_axis(const std::string& name, const std::vector<std::string>& axes);
  /// A row that nothing has measured, with those of some axes that would.
  [[nodiscard]] Share not_run(const std::string& row, const std::vector<std::string>& axes) const;
  void tell(const std::string& text) const;

  const core::Scene& scene_;
  Runner& runner_;
  Sweep sweep_;
  Settings centre_;
  std::size_t centre_row_ = 0;
};

}  // namespace polybed::multiscale
