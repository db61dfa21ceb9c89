#include "dem/effects/brownian.hpp"

#include <cmath>

#include "closures/gas_slip.hpp"
#include "core/numerics/random.hpp"
#include "dem/effects/maker.hpp"
#include "relevance/effects/brownian.hpp"

namespace polybed::dem {

namespace {

constexpr std::uint64_t own_sequence = 0x6272'6f77'6e69'616eULL;  ///< apart from what else is drawn from a case's seed

}  // namespace

void Brownian::begin(const SideView& view, SideRows& rows) {
  for (std::size_t i = 0; i < view.loads.size(); ++i) rows.of(i)[place_] = 0;
}

/// No time has passed: the force that is found next is the one drawn before, with the drag of now.
void Brownian::end_interval(const SideView& view, SideRows& rows) {
  for (std::size_t i = 0; i < view.loads.size(); ++i) rows.of(i)[place_] -= 1;
}

void Brownian::add(const SideView& view, SideRows& rows) {
  for (std::size_t i = 0; i < view.loads.size(); ++i) {
    double* row = rows.of(i);
    const auto count = std::uint64_t(row[place_] += 1);
    const double deviation = std::sqrt(2 * closures::boltzmann * temperature_ * view.loads[i].drag / dt_);
    for (std::size_t k = 0; k < 3; ++k)
      row[k] += deviation * core::normal(seed_ ^ own_sequence, std::uint64_t(view.particles.id[i]), 3 * count + k);
  }
}

namespace makers {

extern const Maker brownian;
const Maker brownian{
    &relevance::effects::brownian, "Force", MakeForce([](const ForceMaking& m) -> std::unique_ptr<SideForce> {
      return std::make_unique<Brownian>(m.scene.fluid.temperature.value(), m.scene.bed.seed, m.dt, m.place);
    })};

}  // namespace makers

}  // namespace polybed::dem
