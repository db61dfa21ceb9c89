#include "fluid/compressible.hpp"

#include <cmath>
#include <limits>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/density.hpp"
#include "fluid/pressure.hpp"

namespace polybed::fluid {

using core::Box;
using core::Field;
using core::Index;

EquationOfState equation_of_state(const core::Fluid& fluid, double density) {
  if (fluid.equation_of_state == core::Compressibility::tait)
    return closures::TaitLiquid{density, fluid.outlet_pressure, fluid.tait_stiffness};
  // Only the product R T = P_out/rho_0 matters.
  const double temperature = fluid.temperature.value_or(1.0);
  return closures::IdealGas{fluid.outlet_pressure / (density * temperature), temperature};
}

double speed_of_sound(const EquationOfState& law, double pressure) {
  return std::visit([&](const auto& l) { return closures::sound_speed(l, pressure); }, law);
}

Compressible::Compressible(const core::Grid& grid, const Boundaries& boundaries, EquationOfState law,
                           double outlet_pressure, double density, double gravity)
    : grid_(grid),
      boundaries_(boundaries),
      law_(law),
      outlet_pressure_(outlet_pressure),
      density_(density),
      gravity_(gravity) {}

void Compressible::make_fields(FluidState& fluid) const {
  fluid.compression.density = core::make_field(grid_, density_);
  fluid.compression.kappa = core::make_field(grid_);
  fluid.compression.pressure_rate = core::make_field(grid_);
  fluid.compression.flux = core::make_face_field(grid_);
}

double Compressible::total_pressure(double p, int j) const {
  const double below_top = grid_.column_height() - grid_.centre(1, j);
  return outlet_pressure_ + p + density_ * gravity_ * below_top;
}

Field Compressible::total_pressure(const FluidState& fluid) const {
  Field total = core::make_field(grid_);
  for (int j = 0; j < grid_.cells[1]; ++j)
    core::for_each_row(grid_, {0, j, 0}, {grid_.cells[0], j + 1, grid_.cells[2]}, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) total[c] = total_pressure(fluid.pressure[c], j);
    });
  return total;
}

bool Compressible::set_density(FluidState& fluid) const {
  set_outlet_pressure(grid_, boundaries_, fluid.pressure);
  bool known = true;
  std::visit(
      [&](const auto& law) {
        for (int j = -grid_.ghosts(1); j < grid_.cells[1] + grid_.ghosts(1); ++j) {
          const double at_rest = total_pressure(0, j);
          const Box row{{-grid_.ghosts(0), j, -grid_.ghosts(2)},
                        {grid_.cells[0] + grid_.ghosts(0), j + 1, grid_.cells[2] + grid_.ghosts(2)}};
          core::for_each_row(grid_, row, [&](Index begin, Index end) {
            for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
              const double pressure = at_rest + fluid.pressure[c], stiffness = 1 / law.compressibility(pressure);
              known = known && stiffness > 0;
              fluid.compression.kappa[c] = fluid.voidage[c] / stiffness;
              fluid.compression.density[c] = law.density(pressure);
            }
          });
        }
      },
      law_);
  return core::on_all_ranks(grid_, known);
}

void Compressible::add_gravity(const FluidState& fluid, core::FaceField& acceleration) const {
  const LocalDensity density{fluid.compression.density.data()};
  const Index s = grid_.stride(1);
  double* rate = acceleration[1].data();
  core::for_each_row(grid_, boundaries_.moving_faces(1, true), [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) rate[c] -= (1 - density_ / density.on_face(c, s)) * gravity_;
  });
}

void Compressible::set_pressure_rate(const Interphase& solids, FluidState& fluid) const {
  Compression& own = fluid.compression;
  const LocalDensity density{own.density.data()};
  const double* rho = own.density.data();
  Field& rate = own.pressure_rate;
  core::with_metric(grid_, [&](const auto& metric) {
    core::for_each_row(grid_, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) {
        double inflow = 0;  // -div(rho_f Q)/rho_f
        for (int axis = 0; axis < grid_.dimensions; ++axis) {
          const auto a = std::size_t(axis);
          const Index s = grid_.stride(axis);
          const double* q = own.flux[a].data();
          inflow += (metric.open(a, c) * density.on_face(c, s) * q[c] -
                     metric.open(a, c + s) * density.on_face(c + s, s) * q[c + s]) *
                    metric.per_volume(c) / (grid_.spacing[a] * rho[c]);
        }
        for (const Field& phi_rate : solids.fraction_rate) inflow += phi_rate[std::size_t(c)];  // - d(eps)/dt
        rate[std::size_t(c)] = inflow / own.kappa[std::size_t(c)];
      }
    });
  });
}

std::pair<double, Index> Compressible::sound_time(const FluidState& fluid) const {
  const double h = grid_.smallest_spacing();
  std::pair<double, Index> shortest{std::numeric_limits<double>::infinity(), 0};
  core::for_each_row(grid_, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      const auto at = std::size_t(c);
      const double time =
          h * std::sqrt(fluid.compression.kappa[at] * fluid.compression.density[at] / fluid.voidage[at]);
      if (time < shortest.first) shortest = {time, c};
    }
  });
  return shortest;
}

}  // namespace polybed::fluid
