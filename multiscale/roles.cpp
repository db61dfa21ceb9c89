#include "multiscale/roles.hpp"

#include <cmath>

#include "closures/size_classes.hpp"
#include "dem/effects.hpp"
#include "tfm/effects.hpp"

namespace polybed::multiscale {

std::vector<core::Role> all_roles() {
  std::vector<core::Role> roles = tfm::roles();
  // One case file describes a scene for both models, so a case may say how its particles touch.
  for (core::Role& role : dem::roles()) roles.push_back(std::move(role));
  return roles;
}

std::vector<std::pair<double, double>> size_classes(const core::SizeDistribution& given) {
  std::vector<closures::SizeClass> classes;
  if (given.kind == core::SizeLaw::sieves) {
    std::vector<double> opening, share;
    for (const auto& [d, x] : given.sieves) {
      opening.push_back(d);
      share.push_back(x);
    }
    classes = closures::sieve_classes(opening, share, given.classes);
  } else {
    const double s = given.deviation.value();
    classes = closures::lognormal_classes(given.median ? *given.median : given.mean.value() * std::exp(-0.5 * s * s), s,
                                          given.classes);
  }
  std::vector<std::pair<double, double>> result;
  for (const closures::SizeClass& c : classes) result.emplace_back(c.diameter, c.share);
  return result;
}

}  // namespace polybed::multiscale
