#include "dem/effects/history.hpp"

#include "dem/effects/maker.hpp"
#include "dem/effects/side_vectors.hpp"
#include "relevance/effects/history.hpp"

namespace polybed::dem {

using closures::Vec3;

History::History(const Materials& materials, double density, double viscosity, double interval, std::size_t place,
                 bool beside)
    : weights_(closures::basset_weights<window>(closures::basset_tail_fitted, interval)),
      place_(place),
      interval_(interval),
      others_(beside ? 1 : 0) {
  for (const Species& s : materials.species())
    prefactor_.push_back(closures::basset_prefactor(2 * s.radius, density, viscosity));
}

void History::begin(const SideView& view, SideRows& rows) {
  for (std::size_t i = 0; i < view.loads.size(); ++i) put(rows.of(i) + place_ + slip, slip_of(view, i));
}

void History::end_interval(const SideView& view, SideRows& rows) {
  closures::BassetHistory<window> history;
  for (std::size_t i = 0; i < view.loads.size(); ++i) {
    double* row = rows.of(i) + place_;
    history.known = window;  // of zeros, at the start
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

void History::add(const SideView& view, SideRows& rows) {
  for (std::size_t i = 0; i < view.loads.size(); ++i) {
    const double prefactor = prefactor_[std::size_t(view.particles.species[i])];
    add_to(rows.of(i), prefactor * to_vec3(rows.of(i) + place_ + sum));
    view.loads[i].added = others_ * view.loads[i].added + prefactor * weights_.newer[0];
  }
}

namespace makers {

extern const Maker history;
const Maker history{&relevance::effects::history,
                    "Force",
                    MakeForce([](const ForceMaking& m) -> std::unique_ptr<SideForce> {
                      return std::make_unique<History>(m.materials, m.density, m.viscosity, m.interval, m.place,
                                                       m.other_inertia);
                    }),
                    {"basset"}};

}  // namespace makers

}  // namespace polybed::dem
