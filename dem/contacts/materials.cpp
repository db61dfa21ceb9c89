#include "dem/contacts/materials.hpp"

#include <algorithm>
#include <limits>

#include "closures/contact_pair.hpp"
#include "closures/rolling_friction.hpp"
#include "closures/sphere.hpp"
#include "core/case/contact_properties.hpp"
#include "dem/scene.hpp"

namespace polybed::dem {

Materials::Materials(const core::Scene& scene) {
  const std::vector<double> curvatures = box_of(scene).curvatures;
  stride_ = std::int32_t(scene.species.size() + 1 + curvatures.size());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const core::Species& s : scene.species) {
    const double mass = closures::sphere_volume(0.5 * s.diameter) * s.density;
    species_.push_back(
        {s.name, 0.5 * s.diameter, mass, closures::moment_of_inertia(mass, 0.5 * s.diameter), s.density});
  }
  for (const Species& a : species_) {
    for (std::size_t b = 0; b <= species_.size(); ++b) {
      const bool wall = b == species_.size();
      const core::ContactProperties given = core::contact_properties(scene, a.name, wall ? "wall" : species_[b].name);
      const closures::Elastic one{given.first.youngs_modulus, given.first.poisson_ratio};
      const closures::Elastic other{given.second.youngs_modulus, given.second.poisson_ratio};
      const double radius = wall ? infinity : species_[b].radius, mass = wall ? infinity : species_[b].mass;
      const double inertia = wall ? infinity : species_[b].inertia;
      kinds_.push_back({closures::reduced_radius(a.radius, radius), closures::reduced_mass(a.mass, mass),
                        closures::reduced_youngs_modulus(one, other), closures::reduced_shear_modulus(one, other),
                        given.restitution, given.friction, std::min(a.radius, radius),
                        closures::rolling_inertia(a.inertia, a.mass, a.radius, inertia, mass, radius)});
    }
    const PairMaterial flat = kinds_.back();
    for (const double curvature : curvatures) {
      kinds_.push_back(flat);
      kinds_.back().radius = closures::reduced_radius_at_wall(a.radius, curvature);
    }
  }
}

std::int32_t Materials::stiffest_wall_kind(std::int32_t a) const {
  std::int32_t stiffest = wall_kind(a);
  each_wall_kind(a, [&](std::int32_t kind) {
    if (kinds_[std::size_t(kind)].radius > kinds_[std::size_t(stiffest)].radius) stiffest = kind;
  });
  return stiffest;
}

double Materials::least_diameter() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Species& s : species_) least = std::min(least, 2 * s.radius);
  return least;
}

double Materials::greatest_diameter() const {
  double most = 0;
  for (const Species& s : species_) most = std::max(most, 2 * s.radius);
  return most;
}

}  // namespace polybed::dem
