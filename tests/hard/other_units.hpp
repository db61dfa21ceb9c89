// A scene told in other units: what V12 holds a run against. The numbers of the program are then those of millimetres
// or grams, as if they were metres and kilograms; physics does not know, a constant with a hidden unit does.
#pragma once

#include <string>

#include "core/case/scene.hpp"
#include "core/case/units.hpp"

namespace polybed::hard {

/// How many of the units make a metre, a kilogram, a second.
struct UnitSystem {
  std::string name;
  double length = 1, mass = 1, time = 1;
};

/// The number that a quantity of 1 in SI has in other units.
[[nodiscard]] double number_of_one(const core::Dimension& dimension, const UnitSystem& units);

/// The scene with every number that has a dimension in other units, those of [[species]], [[jet]] and [[feed]] and the
/// defaults included; a fluid known by its name gets its density and viscosity as numbers. Temperatures stay.
[[nodiscard]] core::Scene in_units(core::Scene scene, const UnitSystem& units);

}  // namespace polybed::hard
