// Slot Stress: the pressure of a fluidised bed from a table, added to the frictional pressure of a packed one.
#pragma once

#include <string>

#include "closures/stress_table.hpp"
#include "tfm/effects/solids_stress_frictional.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::tfm {

/// p_s = p_f(phi) + p_bed(phi) sum_j x_j |rho_j - rho_f| g D_j, p_bed from a file of regime "bed". Beyond the last knot
/// p_bed is constant, which is counted.
class TableStress : public StressEffect {
 public:
  /// \param pressure  p_bed  \param name  of its file
  TableStress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
              closures::MonotoneCurve pressure, const std::string& name, Fields& fields);
  void evaluate(Fields& fields) override;
  [[nodiscard]] double max_packing() const override { return frictional_.max_packing(); }
  [[nodiscard]] double packing_of(std::span<const double> share) const override {
    return frictional_.packing_of(share);
  }
  [[nodiscard]] double packing_above(const Fields& fields) const override { return frictional_.packing_above(fields); }
  [[nodiscard]] double pressure_at(double solids_fraction) const override;
  [[nodiscard]] double solids_fraction_at(double pressure) const override;
  [[nodiscard]] std::optional<ClosureUse> use() const override { return use_; }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  FrictionalStress frictional_;
  closures::MonotoneCurve bed_pressure_;
  std::vector<double> unit_;  ///< |rho_j - rho_f| g D_j, Pa
  double bed_unit_ = 0;       ///< for the whole bed's composition
  ClosureUse use_;
};

/// p_bed(phi) as a curve. An empty bed has no pressure: a curve that begins above phi = 0 gets that knot. Throws
/// core::CaseError if it does not increase. \param name  of its file
[[nodiscard]] closures::MonotoneCurve bed_curve(const BedPressure& bed, const std::string& file);

/// Reads p_bed(phi) from a file of type "polybed solids table", version 1, attribute regime = "bed", datasets `phi` and
/// `p_bed` (in units of (rho_p - rho_f) g D). An empty bed has no pressure: a table that begins above phi = 0 gets that
/// knot. Throws core::FileError for another type of file, core::CaseError if p_bed does not increase with phi.
[[nodiscard]] closures::MonotoneCurve read_bed_pressure(const std::string& file);

}  // namespace polybed::tfm
