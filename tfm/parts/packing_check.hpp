// A bed that is denser than its solids' stress allows ends the run.
#pragma once

#include "tfm/packing_limit.hpp"
#include "tfm/step_part.hpp"

namespace polybed::tfm {

class PackingCheck : public StepPart {
 public:
  PackingCheck(const Constants& constants, const StateLayout& layout, const StressEffect& stress)
      : constants_(constants), layout_(layout), stress_(stress) {}
  void accept(double time, std::span<const double> y) override {
    if (!permissive_) require_packing(constants_, layout_, y, time, stress_);
  }
  /// Whether steps that leave solids far above their packing are taken.
  void go_on_above_packing(bool go_on) { permissive_ = go_on; }

 private:
  const Constants& constants_;
  const StateLayout& layout_;
  const StressEffect& stress_;
  bool permissive_ = false;
};

}  // namespace polybed::tfm
