// What polybed check notes on the drag of a case.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::app {

[[nodiscard]] std::vector<std::string> notes_on_drag(const core::Scene& scene, const relevance::FluidConstants& fluid);

}  // namespace polybed::app
