#include "hard/grains.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace polybed::hard {

namespace {

/// Whether places, velocities and spins of all particles are finite.
bool all_finite(const dem::Particles& particles) {
  double sum = 0;
  for (std::size_t i = 0; i < particles.owned; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sum += particles.place[i].x[k] + particles.motion[i].v[k] + particles.motion[i].w[k];
  return std::isfinite(sum);
}

/// How many of the particles 0 ... count - 1 are not there, or there twice.
std::int64_t missing(const dem::Particles& particles, std::int64_t count) {
  const std::set<std::int64_t> ids(particles.id.begin(), particles.id.begin() + std::ptrdiff_t(particles.owned));
  return std::abs(count - std::int64_t(ids.size())) + std::int64_t(particles.owned - ids.size());
}

}  // namespace

Grains::Grains(Trial& trial, dem::Model& model, GrainWatch watch)
    : trial_(trial), model_(model), watch_(watch), count_(model.particle_count()) {
  see();
}

void Grains::see() {
  const dem::Totals totals = dem::totals_of(model_);
  trial_.measure("V1 particles missing", double(missing(model_.particles(), count_)), 0);
  trial_.measure("V3 finite", all_finite(model_.particles()) ? 0 : 1, 0);
  if (!initial_energy_) initial_energy_ = totals.sum();
  greatest_energy_ = std::max(
      {greatest_energy_, totals.kinetic + totals.rotational, totals.dissipated, totals.elastic, std::abs(totals.work)});
  if (greatest_energy_ > 0)
    trial_.measure("V5 energy", dem::ledger_miss(totals, *initial_energy_, greatest_energy_), 1e-3);
}

bool Grains::over(double begin) const {
  return watch_.cpu < 1e300 && (core::cpu_seconds() - begin > watch_.cpu || trial_.has_failed());
}

bool Grains::steps(std::int64_t number, std::int64_t every) {
  const double begin = core::cpu_seconds();
  const std::int64_t before = model_.steps();
  for (std::int64_t n = 1; n <= number; ++n) {
    model_.step(1e300);
    if (n % every != 0) continue;
    see();
    if (over(begin)) break;
  }
  see();
  trial_.keep_work(std::uint64_t(model_.steps() - before), model_.limits().dt);
  return model_.steps() - before == number;
}

bool Grains::until(double time, std::int64_t every) {
  constexpr double most = 1e15;  // beyond it a number of steps is no number that ends
  const double number = std::min(time / model_.limits().dt, most);
  return steps(std::llround(number) - model_.steps(), every);
}

}  // namespace polybed::hard
