#include "hard/other_units.hpp"

#include <cmath>

#include "core/case/keys.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::hard {

namespace {

/// How often a table stands in a scene.
std::size_t count_of(const core::Scene& scene, std::string_view table) {
  if (table == "species") return scene.species.size();
  if (table == "jet") return scene.jets.size();
  if (table == "feed") return scene.feeds.size();
  if (table == "contact_pair") return scene.contact_pairs.size();
  return 1;
}

/// Multiplies what a key holds.
struct Scale {
  core::Scene& scene;
  std::size_t index;
  double factor, time;
  bool by_size;

  void operator()(core::Place<double> place) const { place(scene, index) *= factor; }
  void operator()(core::Place<std::optional<double>> place) const {
    if (auto& value = place(scene, index)) *value *= factor;
  }
  void operator()(core::Place<std::vector<double>> place) const {
    for (double& value : place(scene, index)) value *= factor;
  }
  void operator()(core::Place<core::Points> place) const {
    for (auto& [at, value] : place(scene, index)) {
      if (!by_size) at *= time;
      value *= factor;
    }
  }
  template <class Other>
  void operator()(core::Place<Other>) const {}
};

}  // namespace

double number_of_one(const core::Dimension& dimension, const UnitSystem& units) {
  return std::pow(units.length, dimension.length) * std::pow(units.mass, dimension.mass) *
         std::pow(units.time, dimension.time);
}

core::Scene in_units(core::Scene scene, const UnitSystem& units) {
  if (scene.fluid.name != "none") {
    const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
    scene.fluid.name = "test fluid";
    scene.fluid.density = fluid.density;
    scene.fluid.viscosity = fluid.viscosity;
  }
  for (const core::Key& key : core::keys()) {
    const double factor = number_of_one(key.dimension, units);
    for (std::size_t n = 0; n < count_of(scene, key.table); ++n)
      std::visit(Scale{scene, n, factor, units.time, key.by_size}, key.place);
  }
  for (double& side : scene.column.size)
    side *= units.length;  // follows from given_size, which the scene need not have
  return scene;
}

}  // namespace polybed::hard
