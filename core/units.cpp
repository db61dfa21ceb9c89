#include "core/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace polybed::core {

namespace {

struct Unit {
  std::string_view name;
  double factor;
  Dimension dimension;
};

constexpr std::array units{
    Unit{"m", 1, {1, 0, 0, 0}},        Unit{"cm", 1e-2, {1, 0, 0, 0}},   Unit{"mm", 1e-3, {1, 0, 0, 0}},
    Unit{"um", 1e-6, {1, 0, 0, 0}},    Unit{"nm", 1e-9, {1, 0, 0, 0}},   Unit{"kg", 1, {0, 1, 0, 0}},
    Unit{"g", 1e-3, {0, 1, 0, 0}},     Unit{"mg", 1e-6, {0, 1, 0, 0}},   Unit{"s", 1, {0, 0, 1, 0}},
    Unit{"ms", 1e-3, {0, 0, 1, 0}},    Unit{"us", 1e-6, {0, 0, 1, 0}},   Unit{"min", 60, {0, 0, 1, 0}},
    Unit{"h", 3600, {0, 0, 1, 0}},     Unit{"K", 1, {0, 0, 0, 1}},       Unit{"Pa", 1, {-1, 1, -2, 0}},
    Unit{"kPa", 1e3, {-1, 1, -2, 0}},  Unit{"MPa", 1e6, {-1, 1, -2, 0}}, Unit{"GPa", 1e9, {-1, 1, -2, 0}},
    Unit{"mPa", 1e-3, {-1, 1, -2, 0}}, Unit{"bar", 1e5, {-1, 1, -2, 0}}, Unit{"N", 1, {1, 1, -2, 0}},
    Unit{"J", 1, {2, 1, -2, 0}},       Unit{"l", 1e-3, {3, 0, 0, 0}},    Unit{"%", 1e-2, {0, 0, 0, 0}},
};

const Unit* find_unit(std::string_view name) {
  for (const Unit& unit : units)
    if (unit.name == name) return &unit;
  return nullptr;
}

/// Multiplies one "m3" or "s-1" into the quantity; false if it is no unit.
bool apply_unit(std::string_view token, int sign, Quantity& q) {
  std::size_t letters = 0;
  while (letters < token.size() &&
         (std::isalpha(static_cast<unsigned char>(token[letters])) || token[letters] == '%'))
    ++letters;
  const Unit* unit = find_unit(token.substr(0, letters));
  if (unit == nullptr) return false;
  std::string_view rest = token.substr(letters);
  if (!rest.empty() && rest.front() == '^') rest.remove_prefix(1);
  int power = 1;
  if (!rest.empty()) {
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), power);
    if (error != std::errc() || end != rest.data() + rest.size() || std::abs(power) > 9) return false;
  }
  power *= sign;
  // A power of ten below one divides: 0.807 mm is then the double nearest to 0.000807.
  const double inverse = std::round(1 / unit->factor);
  for (int n = 0; n < std::abs(power); ++n) {
    const bool divide = (power > 0) == (unit->factor < 1);
    q.value = divide ? q.value / (unit->factor < 1 ? inverse : unit->factor)
                     : q.value * (unit->factor < 1 ? inverse : unit->factor);
  }
  q.dimension.length += power * unit->dimension.length;
  q.dimension.mass += power * unit->dimension.mass;
  q.dimension.time += power * unit->dimension.time;
  q.dimension.temperature += power * unit->dimension.temperature;
  q.has_unit = true;
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Quantity q;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), q.value);
  if (error != std::errc() || !std::isfinite(q.value)) return std::nullopt;
  std::string_view rest = trimmed(text.substr(std::size_t(end - text.data())));
  if (rest == "degC" || rest == "C") {
    return Quantity{q.value + 273.15, dimension::temperature, true};
  }
  int sign = 1;
  while (!rest.empty()) {
    const std::size_t length = std::min(rest.find_first_of(" */"), rest.size());
    if (length > 0 && !apply_unit(rest.substr(0, length), sign, q)) return std::nullopt;
    rest.remove_prefix(length);
    bool divided = false;
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == '*' || rest.front() == '/')) {
      if (rest.front() == '/') {
        if (divided) return std::nullopt;
        divided = true;
      }
      rest.remove_prefix(1);
    }
    if (divided && rest.empty()) return std::nullopt;
    sign = divided ? -1 : 1;
  }
  if (!std::isfinite(q.value)) return std::nullopt;
  return q;
}

std::string unit_name(const Dimension& d) {
  constexpr std::array<std::pair<Dimension, std::string_view>, 4> named{{{dimension::pressure, "Pa"},
                                                                         {dimension::viscosity, "Pa s"},
                                                                         {dimension::none, "1"},
                                                                         {dimension::density, "kg/m3"}}};
  for (const auto& [dim, name] : named)
    if (dim == d) return std::string(name);
  std::string above, below;
  const std::array<std::pair<int, const char*>, 4> parts{
      {{d.mass, "kg"}, {d.length, "m"}, {d.time, "s"}, {d.temperature, "K"}}};
  for (const auto& [power, name] : parts) {
    if (power == 0) continue;
    std::string& side = power > 0 ? above : below;
    side += (side.empty() ? "" : " ") + std::string(name);
    if (std::abs(power) > 1) side += std::to_string(std::abs(power));
  }
  return (above.empty() ? "1" : above) + (below.empty() ? "" : "/" + below);
}

}  // namespace polybed::core
