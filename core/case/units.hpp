// Values with units: "0.807 mm" to SI, with a check of the dimension.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polybed::core {

/// Powers of metre, kilogram, second, kelvin.
struct Dimension {
  int length = 0, mass = 0, time = 0, temperature = 0;
  bool operator==(const Dimension&) const = default;
};

namespace dimension {
constexpr Dimension none{}, length{1, 0, 0, 0}, time{0, 0, 1, 0}, temperature{0, 0, 0, 1}, velocity{1, 0, -1, 0},
    acceleration{1, 0, -2, 0}, density{-3, 1, 0, 0}, viscosity{-1, 1, -1, 0}, pressure{-1, 1, -2, 0},
    per_pressure{-2, 0, 1, 0}, rate{0, 0, -1, 0}, speed_squared{2, 0, -2, 0}, stiffness{0, 1, -2, 0},
    surface_energy = stiffness, energy{2, 1, -2, 0}, volume_rate{3, 0, -1, 0}, pressure_gradient{-2, 1, -2, 0};
}  // namespace dimension

/// A number read from text, in SI.
struct Quantity {
  double value = 0;
  Dimension dimension;
  bool has_unit = false;
};

/// Reads "number unit", e.g. "0.807 mm", "15 degC", "1395 kg/m3", "1.14e-3 Pa s", "12". Units are joined by spaces, '*'
/// or '/'; a digit after a unit is its power. Only degC and degF alone are shifted to K. "µ" is read as "u", "°" as
/// "deg". Empty if the text is not a quantity.
[[nodiscard]] std::optional<Quantity> parse_quantity(std::string_view text);

/// All units that a quantity can have.
[[nodiscard]] std::vector<std::string> unit_names();

/// The SI unit of a dimension as text, e.g. "kg/m3"; "1" for none.
[[nodiscard]] std::string unit_name(const Dimension& dimension);

}  // namespace polybed::core
