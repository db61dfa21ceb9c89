// Who makes the effects of the continuum model, and the list of them. What a scene does not call for is not made.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "fluid/boundaries.hpp"
#include "relevance/effect.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// What a maker has at hand. It puts what it makes into `effects`, and what that owns into `fields`.
struct Making {
  const core::Scene& scene;
  const Constants& constants;
  const fluid::Boundaries& boundaries;
  const std::string& law;
  Fields& fields;
  Effects& effects;  ///< those before it in the list are made
};

/// An effect of this model. Without a maker it acts within another's.
struct Maker {
  const relevance::Effect* effect;
  std::string slot;
  void (*make)(const Making&) = nullptr;
};

}  // namespace polybed::tfm
