#include "fluid/fluid_mass.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/density.hpp"

namespace polybed::fluid {

using core::Index;

MassFlow mass_flow(const core::Grid& grid, const Boundaries& boundaries, const FluidState& fluid,
                   const core::FaceField& own_flux) {
  if (boundaries.closed()) return {};
  const LocalDensity density{fluid.compression.density.data()};
  const auto through = [&](core::ColumnFace at, auto&& part) {
    const int axis = axis_of(at);
    const auto a = std::size_t(axis);
    const Index s = grid.stride(axis);
    const double area = a == 1 ? grid.spacing[0] * grid.spacing[2] : grid.cell_volume() / grid.spacing[a];
    double sum = 0;
    core::with_metric(grid, [&](const auto& metric) {
      for_each_boundary_row(grid, axis, side_of(at), [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c)
          sum += metric.open(a, c) * density.on_face(c, s) * part(own_flux[a][std::size_t(c)]);
      });
    });
    return core::sum_of_ranks(grid, sum) * area;
  };
  const auto all = [](double q) { return q; };
  MassFlow flow{through(core::ColumnFace::bottom, all), through(core::ColumnFace::top, all)};
  for (const core::ColumnFace at : boundaries.crossed()) {
    const double inward = side_of(at) == 0 ? 1 : -1;
    flow.in += through(at, [=](double q) { return std::max(inward * q, 0.0); });
    flow.out += through(at, [=](double q) { return std::max(-inward * q, 0.0); });
  }
  return flow;
}

double fluid_mass(const core::Grid& grid, const FluidState& fluid) {
  double sum = 0, lost = 0;
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      const double open = grid.metric ? grid.metric->volume[c] : 1.0;
      const double term = open * fluid.voidage[c] * fluid.compression.density[c] - lost, next = sum + term;
      lost = (next - sum) - term;
      sum = next;
    }
  });
  return core::sum_of_ranks(grid, sum) * grid.cell_volume();
}

double MassAccount::error(double stored) const {
  return std::abs(start + in - out - stored) / std::max(std::abs(start), std::abs(in));
}

void FluidLedger::begin(double t, const MassAccount& account, const MassFlow& flow) {
  before_ = now_ = t;
  flow_before_ = flow_now_ = flow;
  account_before_ = account_now_ = account;
}

void FluidLedger::advance(double t, const MassFlow& flow) {
  before_ = now_;
  flow_before_ = flow_now_;
  account_before_ = account_now_;
  now_ = t;
  flow_now_ = flow;
  account_now_ = at(t);
}

MassAccount FluidLedger::at(double t) const {
  if (now_ <= before_) return account_now_;
  const double time = t - before_, share = time / (now_ - before_);
  const auto passed = [&](double first, double last) { return time * (first + 0.5 * share * (last - first)); };
  return {account_before_.start, account_before_.in + passed(flow_before_.in, flow_now_.in),
          account_before_.out + passed(flow_before_.out, flow_now_.out)};
}

}  // namespace polybed::fluid
