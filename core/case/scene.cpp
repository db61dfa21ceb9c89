#include "core/case/scene.hpp"

namespace polybed::core {

Substance Fluid::substance() const {
  if (name == "none") return Substance::none;
  if (name == "water") return Substance::water;
  return name == "air" ? Substance::air : Substance::other;
}

std::string text_of(const Start& start) {
  const std::string_view word = name_of(start.kind);
  return std::string(word.substr(0, word.find("FILE"))) + start.file;
}

Scene::Scene() = default;
Scene::Scene(const Scene& other) = default;
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(const Scene& other) = default;
Scene& Scene::operator=(Scene&& other) noexcept = default;
Scene::~Scene() = default;

}  // namespace polybed::core
