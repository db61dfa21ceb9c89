#include "tfm/effects/solids_stress_table.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::tfm {

using core::Index;

closures::MonotoneCurve read_bed_pressure(const std::string& file) {
  if (const core::BoxRegime regime = regime_of_table(file); regime != core::BoxRegime::bed)
    throw core::StartError(file + ": a table of regime \"" + std::string(core::name_of(regime)) +
                           "\", not of a fluidised bed");
  return bed_curve(read_bed_table(file), file);
}

closures::MonotoneCurve bed_curve(const BedPressure& bed, const std::string& file) {
  std::vector<double> phi = bed.phi, pressure = bed.pressure;
  if (!phi.empty() && phi.front() > 0) {
    phi.insert(phi.begin(), 0.0);
    pressure.insert(pressure.begin(), 0.0);
  }
  try {
    closures::MonotoneCurve curve(std::move(phi), std::move(pressure));
    if (!curve.increases()) throw core::StartError(file + ": p_bed must rise with phi, or the bed is ill-posed");
    return curve;
  } catch (const std::invalid_argument& problem) {
    throw core::StartError(file + ": " + problem.what());
  }
}

TableStress::TableStress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                         closures::MonotoneCurve pressure, const std::string& file, Fields& fields)
    : constants_(constants),
      boundaries_(boundaries),
      frictional_(scene, constants, boundaries, fields, false),
      bed_pressure_(std::move(pressure)),
      use_{"solids stress " + file} {
  for (std::size_t j = 0; j < constants.species(); ++j) {
    unit_.push_back(std::abs(constants.density[j] - constants.fluid.density) * constants.gravity *
                    constants.diameter[j]);
    bed_unit_ += constants.bed_share[j] * unit_[j];
  }
}

void TableStress::evaluate(Fields& fields) {
  frictional_.evaluate(fields);
  core::for_each_row(constants_.grid, boundaries_.solids_cells(), [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      double unit = 0;
      for (std::size_t j = 0; j < unit_.size(); ++j) unit += fields.share[j][c] * unit_[j];
      const double phi = fields.solids_fraction[c];
      const closures::StressValue bed = bed_pressure_(phi);
      fields.stress.pressure[c] += unit * bed.pressure;
      fields.stress.slope[c] += unit * bed.slope;
      if (phi > bed_pressure_.last()) ++use_.guarded;
    }
    use_.evaluations += std::uint64_t(end - begin);
  });
  boundaries_.fill_cells(fields.stress.pressure);
}

double TableStress::pressure_at(double solids_fraction) const {
  return frictional_.pressure_at(solids_fraction) + bed_unit_ * bed_pressure_(solids_fraction).pressure;
}

double TableStress::solids_fraction_at(double pressure) const {
  double low = 0, high = frictional_.solids_fraction_at(pressure);  // there friction alone carries it
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (pressure_at(middle) < pressure ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace polybed::tfm
