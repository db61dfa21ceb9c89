#include "core/case/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace polybed::core {

namespace {

double disc(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

bool is_narrower(const std::pair<double, double>& one, const std::pair<double, double>& other) {
  return one.second < other.second;
}

/// Volume of a frustum from the first row of a part of a profile up to a share of the part, m3.
double frustum(const std::pair<double, double>& low, const std::pair<double, double>& high, double share) {
  const double end = low.second + share * (high.second - low.second);
  return share * (high.first - low.first) * (disc(low.second) + disc(end) + disc(0.5 * (low.second + end)) * 4) / 6;
}

}  // namespace

double Column::cross_section(ColumnFace end) const {
  if (is_tapered()) return disc(diameter_at(end));
  const double square = size[0] * size[2];
  return is_round() ? std::numbers::pi / 4 * square : square;
}

double Column::even_height(double height) const {
  if (!is_tapered()) return height;
  double volume = std::max(height - profile.back().first, 0.0) * disc(profile.back().second);
  for (std::size_t n = 1; n < profile.size(); ++n) {
    const auto &low = profile[n - 1], &high = profile[n];
    if (!(low.first < high.first) || height <= low.first) continue;
    volume += frustum(low, high, std::min((height - low.first) / (high.first - low.first), 1.0));
  }
  return volume / cross_section();
}

double Column::diameter_at(double height) const {
  double least = height < profile.front().first ? profile.front().second : std::numeric_limits<double>::infinity();
  for (std::size_t n = 1; n < profile.size(); ++n) {
    const auto& [low, below] = profile[n - 1];
    const auto& [high, above] = profile[n];
    if (low < high && height >= low && height <= high)
      least = std::min(least, below + (above - below) * (height - low) / (high - low));
  }
  return std::isfinite(least) ? least : profile.back().second;
}

double Column::narrowest() const { return std::min_element(profile.begin(), profile.end(), is_narrower)->second; }

double Column::widest() const { return std::max_element(profile.begin(), profile.end(), is_narrower)->second; }

double Column::contraction() const { return is_tapered() ? cross_section() / disc(narrowest()) : 1; }

double Column::diameter_at(ColumnFace end) const {
  if (!is_tapered()) return size[0];
  return (end == ColumnFace::top ? profile.back() : profile.front()).second;
}

double Column::area_between(double low, double high) const {
  if (!is_tapered()) return cross_section();
  return cross_section() * (even_height(high) - even_height(low)) / (high - low);
}

double Column::filled_height(double even) const {
  if (!is_tapered()) return even;
  double below = 0, above = even * contraction();
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (below + above);
    (even_height(middle) < even ? below : above) = middle;
  }
  return above;
}

std::vector<InnerWall> walls_of_taper(const Column& column) {
  std::vector<InnerWall> walls;
  for (std::size_t n = 1; n < column.profile.size(); ++n) {
    const auto& [low, below] = column.profile[n - 1];
    const auto& [high, above] = column.profile[n];
    const bool widest = std::min(below, above) >= column.size[0] * (1 - 1e-9);
    if (!widest && column.profile[n - 1] != column.profile[n])
      walls.push_back({{below, low}, {above, high}, WallShape::cone});
  }
  return walls;
}

Substance Fluid::substance() const {
  if (name == "none") return Substance::none;
  if (name == "water") return Substance::water;
  return name == "air" ? Substance::air : Substance::other;
}

std::string text_of(const Start& start) {
  const std::string_view word = name_of(start.kind);
  return std::string(word.substr(0, word.find("FILE"))) + start.file;
}

bool is_off(const std::string& law) { return law == "none"; }

bool Scene::flows_around() const {
  return column.ends == Boundary::periodic && column.shear_rate == 0 && fluid.present();
}

ChosenLaw Scene::law(const std::string& role) const {
  const auto found = effects.find(role);
  return found == effects.end() ? ChosenLaw() : ChosenLaw{found->second, true};
}

bool all_spheres(const Scene& scene) {
  return std::all_of(scene.species.begin(), scene.species.end(), [](const Species& s) { return s.sphericity == 1; });
}

void set_friction(Scene& scene, double friction) {
  scene.material.friction = friction;
  for (Species& species : scene.species) species.friction = friction;
}

void set_restitution(Scene& scene, double restitution) {
  scene.material.restitution = restitution;
  for (Species& species : scene.species) species.restitution = restitution;
}

void resolve_materials(Scene& scene) {
  for (Species& species : scene.species) {
    species.friction = species.given_friction.value_or(scene.material.friction);
    species.restitution = species.given_restitution.value_or(scene.material.restitution);
  }
}

Scene::Scene() = default;
Scene::Scene(const Scene& other) = default;
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(const Scene& other) = default;
Scene& Scene::operator=(Scene&& other) noexcept = default;
Scene::~Scene() = default;

}  // namespace polybed::core
