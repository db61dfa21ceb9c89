// Brownian motion of small spheres, Langevin 1908.
#include <cmath>
#include <cstdint>

#include "closures/gas_slip.hpp"
#include "core/numerics/random.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/side_forces.hpp"
#include "relevance/effects/brownian.hpp"

namespace polybed::dem {

namespace {

constexpr std::uint64_t own_sequence = 0x6272'6f77'6e69'616eULL;  ///< distinct from other draws with a case's seed

/// A random force on each particle, drawn in the middle of every step and constant until the next draw, with mean 0 and
/// variance 2 k_B T k/dt along each axis, k the drag over the slip. Under exact drag a sphere then diffuses with D =
/// k_B T/k for any step. At the ends of steps, in the middle of a constant force, its speed has the variance (k_B
/// T/M)(2/x)(a (1 - a)/(1 + a) + (1 - sqrt(a))^2), x = k dt/M, a = exp(-x): equipartition minus a share of x/2. The
/// fluid receives the opposite momentum; its own fluctuations are neglected. Draws depend on a particle and its count
/// of steps: they are the same on any number of ranks.
class Brownian final : public SideForce {
 public:
  /// \param temperature  K  \param dt  of the particles, s  \param place  index of the count of draws in a row
  Brownian(double temperature, std::uint64_t seed, double dt, std::size_t place)
      : temperature_(temperature), seed_(seed), dt_(dt), place_(place) {}
  [[nodiscard]] std::size_t memory_size() const override { return 1; }
  void begin(const SideView& view, SideRows& rows) override {
    for (std::size_t i = 0; i < view.loads.size(); ++i) rows.of(i)[place_] = 0;
  }
  /// No time passes: the next force is the last draw again, with the present drag.
  void end_interval(const SideView& view, SideRows& rows) override {
    for (std::size_t i = 0; i < view.loads.size(); ++i) rows.of(i)[place_] -= 1;
  }
  void add(const SideView& view, SideRows& rows) override {
    for (std::size_t i = 0; i < view.loads.size(); ++i) {
      double* row = rows.of(i);
      const auto count = std::uint64_t(row[place_] += 1);
      const double deviation = std::sqrt(2 * closures::boltzmann * temperature_ * view.loads[i].drag / dt_);
      for (std::size_t k = 0; k < 3; ++k)
        row[k] += deviation * core::normal(seed_ ^ own_sequence, std::uint64_t(view.particles.id[i]), 3 * count + k);
    }
  }

 private:
  double temperature_;
  std::uint64_t seed_;
  double dt_;
  std::size_t place_;
};

}  // namespace

namespace makers {

extern const Maker brownian;
const Maker brownian{
    &relevance::effects::brownian, "Force", MakeForce([](const ForceMaking& m) -> std::unique_ptr<SideForce> {
      return std::make_unique<Brownian>(m.scene.fluid.temperature.value(), m.scene.bed.seed, m.dt, m.place);
    })};

}  // namespace makers

}  // namespace polybed::dem
