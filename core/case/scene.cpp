#include "core/case/scene.hpp"

#include <numbers>

namespace polybed::core {

double Column::cross_section() const {
  const double square = size[0] * size[2];
  return is_round() ? std::numbers::pi / 4 * square : square;
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

bool is_law(const std::string& law) { return !is_off(law) && law != automatic; }

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
