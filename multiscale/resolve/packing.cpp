#include "multiscale/resolve/packing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "closures/sphere.hpp"
#include "dem/packing.hpp"
#include "dem/scene.hpp"

namespace polybed::multiscale {

std::vector<std::int64_t> sphere_numbers(const core::Scene& scene) {
  std::vector<double> one;
  double sum = 0;
  for (std::size_t j = 0; j < scene.species.size(); ++j) {
    one.push_back(scene.bed.volume_share[j] / closures::sphere_volume(0.5 * scene.species[j].diameter));
    sum += one.back();
  }
  std::vector<std::int64_t> numbers;
  for (const double of_species : one) numbers.push_back(std::llround(scene.resolve.spheres * of_species / sum));
  return numbers;
}

std::vector<double> shares_of(const core::Scene& scene, const std::vector<std::int64_t>& numbers) {
  std::vector<double> share;
  double sum = 0;
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    share.push_back(double(numbers[j]) * closures::sphere_volume(0.5 * scene.species[j].diameter));
    sum += share.back();
  }
  for (double& x : share) x /= sum;
  return share;
}

double box_length(const core::Scene& scene, double voidage) {
  const std::vector<std::int64_t> numbers = sphere_numbers(scene);
  double solids = 0;
  for (std::size_t j = 0; j < numbers.size(); ++j)
    solids += double(numbers[j]) * closures::sphere_volume(0.5 * scene.species[j].diameter);
  return std::cbrt(solids / (1 - voidage));
}

std::vector<std::string> packing_notes(const core::Scene& scene) {
  std::vector<std::string> notes;
  const std::vector<std::int64_t> numbers = sphere_numbers(scene);
  const std::vector<double> made = shares_of(scene, numbers), &given = scene.bed.volume_share;
  const double sum = std::accumulate(given.begin(), given.end(), 0.0);
  std::vector<std::string> made_texts, given_texts;
  bool missed = false;
  double largest = 0;
  for (std::size_t j = 0; j < made.size(); ++j) {
    missed = missed || std::abs(made[j] - given[j] / sum) > 0.01 * given[j] / sum;
    made_texts.push_back(fmt::format("{:.3g}", made[j]));
    given_texts.push_back(fmt::format("{:.3g}", given[j] / sum));
    if (numbers[j] > 0) largest = std::max(largest, scene.species[j].diameter);
  }
  if (missed)
    notes.push_back(fmt::format("{} spheres have the volume shares {}, the case {}: more resolve.spheres come closer",
                                fmt::join(numbers, " + "), fmt::join(made_texts, ", "), fmt::join(given_texts, ", ")));
  const core::Resolve& plan = scene.resolve;
  const double voidage = *std::min_element(plan.voidage.begin(), plan.voidage.end()),
               width = box_length(scene, voidage) / largest;
  if (plan.motion == core::SphereMotion::held && width < 2)
    notes.push_back(
        fmt::format("the box at voidage {:g} is {:.2g} of the largest diameters wide, less than 2: spheres are next to "
                    "their own images; use more resolve.spheres",
                    voidage, width));
  return notes;
}

SpherePacking sphere_packing(const core::Scene& scene, double voidage, std::uint64_t seed) {
  core::Scene box;
  box.fluid.name = "none";
  box.species = scene.species;
  box.bed.particles = sphere_numbers(scene);
  SpherePacking packing;
  packing.length = box_length(scene, voidage);
  box.column.dimensions = 3;
  box.column.size = {packing.length, packing.length, packing.length};
  box.column.gravity = 0;
  box.column.sides = box.column.ends = core::Boundary::periodic;
  box.bed.start = {core::StartKind::random};
  box.bed.start_solids_fraction = 1 - voidage;
  box.bed.seed = seed;
  const dem::Materials materials(box);
  for (const dem::Particle& p : dem::start_particles(box, materials, dem::box_of(box))) {
    packing.centre.push_back(p.place.x);
    packing.species.push_back(std::size_t(p.species));
  }
  packing.scene = std::move(box);
  return packing;
}

}  // namespace polybed::multiscale
