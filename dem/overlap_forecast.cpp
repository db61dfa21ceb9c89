#include "dem/overlap_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/contact_pair.hpp"
#include "core/case/contact_properties.hpp"
#include "core/case/keys.hpp"
#include "relevance/effects/contact.hpp"

namespace polybed::dem {

namespace {

std::string pressure_text(double pascals) {
  const auto [unit, name] = pascals < 1e6   ? std::pair(1e3, "kPa")
                            : pascals < 1e9 ? std::pair(1e6, "MPa")
                                            : std::pair(1e9, "GPa");
  return fmt::format("{:.3g} {}", pascals / unit, name);
}

/// The key for the modulus of a species or "wall" in contact with another.
std::string key_of_modulus(const core::Scene& scene, const std::string& name, const std::string& partner) {
  const std::vector<std::string> two{name, partner};
  for (const core::ContactPair& pair : scene.contact_pairs)
    if (pair.youngs_modulus && std::is_permutation(two.begin(), two.end(), pair.between.begin(), pair.between.end()))
      return fmt::format("youngs_modulus of the [[contact_pair]] of {} and {}", name, partner);
  for (const core::Species& species : scene.species)
    if (species.name == name && species.youngs_modulus) return "youngs_modulus of " + name;
  return "dem.youngs_modulus";
}

}  // namespace

double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return std::ceil(value / unit * (1 - 1e-12)) * unit;
}

double stiffest(const core::Scene& scene) {
  const bool linear = relevance::effects::contact.has(scene, relevance::effects::linear_springs);
  const auto all = core::keys();
  return std::ranges::find(all, linear ? "dem.normal_stiffness" : "dem.youngs_modulus", &core::Key::path)->range.most;
}

std::string stiffer(const core::Scene& scene, const std::string& a, const std::string& b, double factor) {
  const double most = stiffest(scene);
  if (relevance::effects::contact.has(scene, relevance::effects::linear_springs)) {
    const double stiffness = rounded_up(factor * scene.dem.normal_stiffness.value());
    return stiffness <= most ? fmt::format("dem.normal_stiffness = \"{:g} N/m\"", stiffness) : "";
  }
  const core::ContactProperties given = core::contact_properties(scene, a, b);
  if (!(rounded_up(factor * std::max(given.first.youngs_modulus, given.second.youngs_modulus)) <= most)) return "";
  const auto text = [&](const std::string& key, double modulus) {
    return fmt::format("{} = \"{}\"", key, pressure_text(rounded_up(factor * modulus)));
  };
  const std::string first = key_of_modulus(scene, a, b), second = key_of_modulus(scene, b, a);
  const std::string one = text(first, given.first.youngs_modulus);
  return second == first || a == b ? one : one + " and " + text(second, given.second.youngs_modulus);
}

/// Overlap, m, at which the springs have absorbed an energy, J, and the work of an attraction, N, on the way. Bisection
/// between the overlap without the attraction and one at which the springs balance both.
double overlap_with_pull(const NormalLaw& law, int kind, double without, double pull) {
  const double energy = law.energy(kind, without);
  const auto left = [&](double overlap) { return energy + pull * overlap - law.energy(kind, overlap); };
  double low = without, high = std::max(without, 1e-12);
  while (left(high) > 0) high *= 2;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (left(middle) > 0 ? low : high) = middle;
  }
  return high;
}

double stiffening(const NormalLaw& law, int kind, double overlap, double allowed) {
  const double power = law.force_at(kind, overlap) * overlap / law.energy(kind, overlap);
  return std::pow(overlap / allowed, power);
}

OverlapForecast overlap_forecast(const core::Scene& scene, const Materials& materials, const PairLaws& laws,
                                 double speed, Met met) {
  constexpr double used = 0.8;  // share of the limit
  const NormalLaw& law = *laws.normal;
  OverlapForecast worst;
  const auto& species = materials.species();
  for (std::size_t a = 0; a < species.size(); ++a)
    for (std::size_t b = a; b <= species.size(); ++b) {
      const bool wall = b == species.size();
      const int kind = wall ? materials.wall_kind(int(a)) : materials.kind(int(a), int(b));
      const PairMaterial& pair = materials.kinds()[std::size_t(kind)];
      double mass = species[a].mass;
      if (!wall)
        mass = met == Met::single
                   ? std::max(mass, species[b].mass)
                   : closures::mass_on_a_contact(mass, species[a].radius, species[b].mass, species[b].radius);
      // The same energy as in an impact with the reduced mass.
      double pull = 0, overlap = law.overlap_of_impact(kind, speed * std::sqrt(mass / pair.mass));
      laws.each_attraction([&](const CohesionLaw& attraction) { pull += attraction.pull_off(kind); });
      const double allowed = 2 * pair.least_radius * scene.dem.max_overlap, aimed = used * allowed;
      const double stiffer_by = (law.energy(kind, overlap) + pull * aimed) / law.energy(kind, aimed);
      if (pull > 0) overlap = overlap_with_pull(law, kind, overlap, pull);
      const double share = overlap / (2 * pair.least_radius);
      if (!(share > worst.share)) continue;
      const std::string partner = wall ? "wall" : species[b].name;
      worst = {fmt::format("{} and {}", species[a].name, partner), overlap, share, stiffer_by, ""};
      if (!(overlap > allowed)) continue;
      const std::string use = stiffer(scene, species[a].name, partner, worst.stiffening);
      worst.warning = fmt::format(
          "contacts of {} are too soft: at {:.3g} m/s they overlap by up to {:.2g} of the smaller diameter, and the "
          "run stops above dem.max_overlap = {:g}; {}state dem.greatest_speed if particles are slower",
          worst.pair, speed, share, scene.dem.max_overlap,
          use.empty() ? "no stiffness that a case accepts is enough: " : fmt::format("use {}, or ", use));
    }
  return worst;
}

}  // namespace polybed::dem
