// Makers of the effects in the continuum model, and their list. Effects that a scene does not need are not created.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "fluid/boundaries.hpp"
#include "relevance/effect.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// Input of a maker. It puts its effect into `effects`, and the fields that this owns into `fields`.
struct Making {
  const core::Scene& scene;
  const Constants& constants;
  const fluid::Boundaries& boundaries;
  const std::string& law;
  Fields& fields;
  Effects& effects;  ///< earlier ones in the list already exist
};

/// An effect of this model. Without a maker another effect includes it.
struct Maker {
  const relevance::Effect* effect;
  std::string slot;
  void (*make)(const Making&) = nullptr;
};

}  // namespace polybed::tfm
