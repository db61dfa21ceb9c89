#include "dem/trouble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace polybed::dem {

namespace {

/// The stiffness at which the contact would have stopped the particles: one contact absorbs its stored energy at the
/// present overlap and the remaining energy of approach, with the lighter particle supported by its neighbours.
std::string remedy_of_pair(const Model& model, const core::Scene& scene, const Contacts::Pair& pair,
                           const PairTrouble& trouble) {
  if (model.steps() == 0 || std::isinf(trouble.excess)) return "look at the start";
  const auto i = std::size_t(pair.first), j = std::size_t(pair.second);
  const Particles& particles = model.particles();
  const Materials& materials = model.materials();
  const NormalLaw& normal = *model.laws().normal;
  const auto& species = materials.species();
  const std::int32_t a = particles.species[i], b = trouble.wall ? -1 : particles.species[j];
  const double allowed = 2 * scene.dem.max_overlap * materials.kinds()[std::size_t(pair.kind)].least_radius;
  const double overlap = allowed + trouble.excess, stored = normal.energy(pair.kind, overlap);
  double mass = species[std::size_t(a)].mass, square = 0;
  if (!trouble.wall) mass = std::max(mass, species[std::size_t(b)].mass);
  for (std::size_t k = 0; k < 3; ++k) {
    const double v = particles.motion[i].v[k] - (trouble.wall ? 0 : particles.motion[j].v[k]);
    square += v * v;
  }
  // Energy scales with stiffness: with this factor the present energy fits into the allowed overlap.
  double factor = stiffening(normal, pair.kind, overlap, allowed) * (1 + 0.5 * mass * square / stored);
  const OverlapForecast& expected = model.overlap_expected();
  if (!expected.warning.empty()) factor = std::max(factor, expected.stiffening);  // other pairs would be next
  constexpr double least_allowed = 1e-4;  // over a diameter: less would need particles stiffer than any
  if (scene.dem.max_overlap < least_allowed)
    return fmt::format("dem.max_overlap = {:g} of the diameter is too little: leave it out", scene.dem.max_overlap);
  const std::string use =
      stiffer(scene, species[std::size_t(a)].name, trouble.wall ? "wall" : species[std::size_t(b)].name, factor);
  if (use.empty())
    return "no stiffness that a case accepts would have kept them within it: look at the start, and at what makes them "
           "so fast";
  return use + " would have kept them within it; or look at the start";
}

}  // namespace

std::string trouble_of_pair(const Model& model, const core::Scene& scene) {
  const PairTrouble& t = model.pair_forces().trouble();
  const Contacts::Pair pair = (t.wall ? model.walls() : model.pairs()).pairs[std::size_t(t.pair)];
  const Particles& particles = model.particles();
  const Place& at = particles.place[std::size_t(pair.first)];
  const int plate = t.wall ? model.box().walls[std::size_t(pair.second)].plate : -1;
  const bool inside = plate >= 0 && std::size_t(plate) < scene.walls.size();  // the case's walls come first
  const bool side = plate >= 0 && model.box().plates[std::size_t(plate)].along_y != 0;
  const std::string other = inside   ? fmt::format("[[wall]] number {}", plate + 1)
                            : side   ? "the side of the column"
                            : t.wall ? fmt::format("wall {}", pair.second)
                                     : fmt::format("particle {}", particles.id[std::size_t(pair.second)]);
  return fmt::format(
      "t = {:.6g} s: particle {} and {} overlap by {:.3g} m more than dem.max_overlap allows, near ({:.6g}, {:.6g}, "
      "{:.6g}) m; {}",
      model.time(), particles.id[std::size_t(pair.first)], other, t.excess, at.x[0], at.x[1], at.x[2],
      remedy_of_pair(model, scene, pair, t));
}

std::string trouble_of_haste(const Model& model, const core::Scene& scene, std::int64_t id) {
  const Particles& particles = model.particles();
  const auto found = std::find(particles.id.begin(), particles.id.end(), id);
  const auto i = std::size_t(found - particles.id.begin());
  const Vector &x = particles.place[i].x, &v = particles.motion[i].v;
  return fmt::format(
      "t = {:.6g} s: particle {} moves by more than a tenth of its diameter in one step of {:.3g} s, at {:.4g} m/s, "
      "near ({:.6g}, {:.6g}, {:.6g}) m; state a {}, or look at the start",
      model.time(), id, model.limits().dt, std::hypot(v[0], v[1], v[2]), x[0], x[1], x[2],
      scene.dem.fixed_step ? "shorter dem.fixed_step" : "higher dem.greatest_speed");
}

std::string trouble_of_speed(const Model& model, double met, double expected) {
  return fmt::format(
      "t = {:.6g} s: a particle moves at {:.3g} m/s, where {:.3g} m/s at most were expected: too fast for the units "
      "that "
      "energies are counted in; state a higher dem.greatest_speed, or look at the start",
      model.time(), met, expected);
}

}  // namespace polybed::dem
