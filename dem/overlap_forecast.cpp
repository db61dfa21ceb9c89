#include "dem/overlap_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/contact_pair.hpp"
#include "core/case/contact_properties.hpp"
#include "relevance/effects/contact.hpp"

namespace polybed::dem {

namespace {

std::string pressure_text(double pascals) {
  const auto [unit, name] = pascals < 1e6   ? std::pair(1e3, "kPa")
                            : pascals < 1e9 ? std::pair(1e6, "MPa")
                                            : std::pair(1e9, "GPa");
  return fmt::format("{:.3g} {}", pascals / unit, name);
}

/// The key that gives the modulus of a species or "wall" in contact with another.
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

std::string stiffer(const core::Scene& scene, const std::string& a, const std::string& b, double factor) {
  if (relevance::effects::contact.has(scene, relevance::effects::linear_springs))
    return fmt::format("dem.normal_stiffness = \"{:g} N/m\"", rounded_up(factor * scene.dem.normal_stiffness.value()));
  const core::ContactProperties given = core::contact_properties(scene, a, b);
  const auto text = [&](const std::string& key, double modulus) {
    return fmt::format("{} = \"{}\"", key, pressure_text(rounded_up(factor * modulus)));
  };
  const std::string first = key_of_modulus(scene, a, b), second = key_of_modulus(scene, b, a);
  const std::string one = text(first, given.first.youngs_modulus);
  return second == first || a == b ? one : one + " and " + text(second, given.second.youngs_modulus);
}

double stiffening(const NormalLaw& law, int kind, double overlap, double allowed) {
  const double power = law.force_at(kind, overlap) * overlap / law.energy(kind, overlap);
  return std::pow(overlap / allowed, power);
}

OverlapForecast overlap_forecast(const core::Scene& scene, const Materials& materials, const NormalLaw& law,
                                 double speed, Met met) {
  constexpr double used = 0.8;  // of what is allowed
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
      // The same energy as an impact of the reduced mass.
      const double overlap = law.overlap_of_impact(kind, speed * std::sqrt(mass / pair.mass));
      const double share = overlap / (2 * pair.least_radius);
      if (!(share > worst.share)) continue;
      const double allowed = 2 * pair.least_radius * scene.dem.max_overlap;
      const std::string partner = wall ? "wall" : species[b].name;
      worst = {fmt::format("{} and {}", species[a].name, partner), overlap, share,
               dem::stiffening(law, kind, overlap, used * allowed), ""};
      if (overlap > allowed)
        worst.warning = fmt::format(
            "contacts of {} are too soft: at {:.3g} m/s they overlap by up to {:.2g} of the smaller diameter, and the "
            "run stops above dem.max_overlap = {:g}; use {}, or state dem.greatest_speed if particles are slower",
            worst.pair, speed, share, scene.dem.max_overlap,
            stiffer(scene, species[a].name, partner, worst.stiffening));
    }
  return worst;
}

}  // namespace polybed::dem
