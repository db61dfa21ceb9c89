#include "dem/continuum_scene.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace polybed::dem {

std::vector<std::string> only_for_continuum(const core::Scene& scene) {
  std::vector<std::string> found;
  const auto add = [&](bool set, const char* what, const char* remedy) {
    if (set) found.push_back(fmt::format("{} is for the TFM only: {}", what, remedy));
  };
  add(scene.column.outlet == core::Outlet::open, "column.outlet = \"open\"",
      "particles leave through dem.opening, where there is no fluid; use \"screen\", which holds them");
  add(!scene.feeds.empty(), "[[feed]]", "particles cannot enter the column yet; give them all in [bed]");
  return found;
}

void refuse_continuum_scene(const core::Scene& scene) {
  const std::vector<std::string> found = only_for_continuum(scene);
  if (!found.empty()) throw core::CaseError(fmt::format("{}", fmt::join(found, "\n")));
}

}  // namespace polybed::dem
