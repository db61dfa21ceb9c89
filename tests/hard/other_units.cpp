#include "hard/other_units.hpp"

#include <cmath>

#include "core/case/keys.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::hard {

namespace {

/// Multiplies what a key holds.
struct Scale {
  double factor, time;

  void operator()(double& value) const { value *= factor; }
  void operator()(std::vector<double>& values) const {
    for (double& value : values) value *= factor;
  }
  void operator()(core::Points& points) const {
    for (auto& [at, value] : points) {
      at *= time;
      value *= factor;
    }
  }
  template <class Other>
  void operator()(Other&) const {}
};

}  // namespace

double number_of_one(const core::Dimension& dimension, const UnitSystem& units) {
  return std::pow(units.length, dimension.length) * std::pow(units.mass, dimension.mass) *
         std::pow(units.time, dimension.time);
}

core::Scene in_units(core::Scene scene, const UnitSystem& units) {
  if (scene.fluid.present()) {
    const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
    scene.fluid.name = "test fluid";
    scene.fluid.density = fluid.density;
    scene.fluid.viscosity = fluid.viscosity;
  }
  for (const core::Table& table : core::tables())
    for (const core::Key& key : table.keys)
      for (std::size_t n = 0; n < table.count(scene); ++n) {
        core::Value value = key.get(scene, n);
        const bool by_size = key.kind == core::Kind::sieves, by_height = key.kind == core::Kind::heights;
        std::visit(Scale{number_of_one(key.dimension, units), by_height ? units.length
                                                              : by_size ? 1.0
                                                                        : units.time},
                   value);
        if (!std::holds_alternative<std::monostate>(value)) key.set(scene, n, value);
      }
  for (double& side : scene.column.size)
    side *= units.length;  // follows from given_size, which the scene need not have
  return scene;
}

}  // namespace polybed::hard
