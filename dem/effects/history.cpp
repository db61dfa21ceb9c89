// History force on spheres, closures/history_basset.hpp: Basset's kernel, creeping flow.
#include <vector>

#include "closures/history_basset.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/side_forces.hpp"
#include "dem/effects/side_vectors.hpp"
#include "relevance/effects/history.hpp"

namespace polybed::dem {

namespace {

using closures::Vec3;

/// Evaluated once per fluid step: g is the change of slip over it, so that a collision enters by its impulse however
/// short it is. For constant g in each step the weights give the mean of the force over a step exactly, 4/3 sqrt(h)
/// [(n+1)^1.5 - 2 n^1.5 + (n-1)^1.5]: momentum is exact, and a start from rest is a past of zeros. The newest g
/// contains the particle's own acceleration: its coefficient is an inertia, added to the added mass and with the same
/// acceleration of the fluid, DU_f/Dt; older terms use the slip along the particle's path. Initial slip counts as old:
/// its vorticity has spread.
///
/// Window of 4 steps: the error of the exponentials is 0.126 % for any window, up to 1e5 windows; its length only
/// limits how long a run remembers its start, 4e5 steps of the fluid.
class History final : public SideForce {
 public:
  /// \param density, viscosity  of the fluid, kg/m3, Pa s  \param interval  step of the fluid, s
  /// \param place  index of its memory in a row  \param beside  the loads contain other inertia: added mass
  History(const Materials& materials, double density, double viscosity, double interval, std::size_t place, bool beside)
      : weights_(closures::basset_weights<window>(closures::basset_tail_fitted, interval)),
        place_(place),
        interval_(interval),
        others_(beside ? 1 : 0) {
    for (const Species& s : materials.species())
      prefactor_.push_back(closures::basset_prefactor(2 * s.radius, density, viscosity));
  }

  [[nodiscard]] bool has_inertia() const override { return true; }
  [[nodiscard]] std::size_t memory_size() const override { return memory; }
  void begin(const SideView& view, SideRows& rows) override {
    for (std::size_t i = 0; i < view.loads.size(); ++i) put(rows.of(i) + place_ + slip, slip_of(view, i));
  }
  void end_interval(const SideView& view, SideRows& rows) override {
    closures::BassetHistory<window> history;
    for (std::size_t i = 0; i < view.loads.size(); ++i) {
      double* row = rows.of(i) + place_;
      history.known = window;  // zeros, at the start
      for (std::size_t n = 0; n < window; ++n) history.past[n] = to_vec3(row + past + 3 * n);
      for (std::size_t n = 0; n < closures::BassetTail::terms; ++n) history.tail[n] = to_vec3(row + tail + 3 * n);
      const Vec3 now = slip_of(view, i), change = now - to_vec3(row + slip);
      history = closures::basset_step(weights_, history, (1 / interval_) * change);
      put(row + slip, now);
      put(row + sum, closures::basset_past(weights_, history));
      for (std::size_t n = 0; n < window; ++n) put(row + past + 3 * n, history.past[n]);
      for (std::size_t n = 0; n < closures::BassetTail::terms; ++n) put(row + tail + 3 * n, history.tail[n]);
    }
  }

  void add(const SideView& view, SideRows& rows) override {
    for (std::size_t i = 0; i < view.loads.size(); ++i) {
      const double prefactor = prefactor_[std::size_t(view.particles.species[i])];
      add_to(rows.of(i), prefactor * to_vec3(rows.of(i) + place_ + sum));
      view.loads[i].added = others_ * view.loads[i].added + prefactor * weights_.newer[0];
    }
  }

 private:
  static constexpr std::size_t window = 4;
  /// In a row: the slip at the start of the fluid step, the sum of the past, g in the window, sums of the tail.
  static constexpr std::size_t slip = 0, sum = 3, past = 6, tail = past + 3 * window,
                               memory = tail + 3 * closures::BassetTail::terms;

  closures::BassetWeights<window> weights_;
  std::vector<double> prefactor_;  ///< B for each species, kg/s^(1/2)
  std::size_t place_;
  double interval_, others_;  ///< s; share of other inertia: 1, or 0 without any
};

}  // namespace

namespace makers {

extern const Maker history;
const Maker history{
    &relevance::effects::history, "Force", MakeForce([](const ForceMaking& m) -> std::unique_ptr<SideForce> {
      return std::make_unique<History>(m.materials, m.density, m.viscosity, m.interval, m.place, m.other_inertia);
    })};

}  // namespace makers

}  // namespace polybed::dem
