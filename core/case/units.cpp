#include "core/case/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace polybed::core {

namespace {

/// 10^decade * factor SI units.
struct Unit {
  std::string_view name;
  int decade;
  double factor;
  Dimension dimension;
};

constexpr std::array known_units{
    Unit{"m", 0, 1, {1, 0, 0, 0}},
    Unit{"cm", -2, 1, {1, 0, 0, 0}},
    Unit{"mm", -3, 1, {1, 0, 0, 0}},
    Unit{"um", -6, 1, {1, 0, 0, 0}},
    Unit{"nm", -9, 1, {1, 0, 0, 0}},
    Unit{"kg", 0, 1, {0, 1, 0, 0}},
    Unit{"g", -3, 1, {0, 1, 0, 0}},
    Unit{"mg", -6, 1, {0, 1, 0, 0}},
    Unit{"s", 0, 1, {0, 0, 1, 0}},
    Unit{"ms", -3, 1, {0, 0, 1, 0}},
    Unit{"us", -6, 1, {0, 0, 1, 0}},
    Unit{"min", 0, 60, {0, 0, 1, 0}},
    Unit{"h", 0, 3600, {0, 0, 1, 0}},
    Unit{"d", 0, 86400, {0, 0, 1, 0}},
    Unit{"K", 0, 1, {0, 0, 0, 1}},
    Unit{"Pa", 0, 1, {-1, 1, -2, 0}},
    Unit{"kPa", 3, 1, {-1, 1, -2, 0}},
    Unit{"MPa", 6, 1, {-1, 1, -2, 0}},
    Unit{"GPa", 9, 1, {-1, 1, -2, 0}},
    Unit{"mPa", -3, 1, {-1, 1, -2, 0}},
    Unit{"bar", 5, 1, {-1, 1, -2, 0}},
    Unit{"mbar", 2, 1, {-1, 1, -2, 0}},
    Unit{"cP", -3, 1, {-1, 1, -1, 0}},
    Unit{"N", 0, 1, {1, 1, -2, 0}},
    Unit{"J", 0, 1, {2, 1, -2, 0}},
    Unit{"mJ", -3, 1, {2, 1, -2, 0}},
    Unit{"mN", -3, 1, {1, 1, -2, 0}},
    Unit{"l", -3, 1, {3, 0, 0, 0}},
    Unit{"L", -3, 1, {3, 0, 0, 0}},
    Unit{"ml", -6, 1, {3, 0, 0, 0}},
    Unit{"%", -2, 1, {0, 0, 0, 0}},
    // Conversion factors from NIST Special Publication 811, appendix B.
    Unit{"micron", -6, 1, {1, 0, 0, 0}},
    Unit{"in", 0, 0.0254, {1, 0, 0, 0}},
    Unit{"ft", 0, 0.3048, {1, 0, 0, 0}},
    Unit{"lb", 0, 0.45359237, {0, 1, 0, 0}},
    Unit{"gal", 0, 3.785411784e-3, {3, 0, 0, 0}},
    Unit{"gpm", 0, 3.785411784e-3 / 60, {3, 0, -1, 0}},
    Unit{"psi", 0, 6894.757293168361, {-1, 1, -2, 0}},
};

const Unit* find_unit(std::string_view name) {
  for (const Unit& unit : known_units)
    if (unit.name == name) return &unit;
  return nullptr;
}

/// The product of several units.
struct Units {
  int decade = 0;
  double factor = 1;
  Dimension dimension;
  bool any = false;
};

/// Multiplies one "m3" or "s-1" into the units; false if it is not a unit.
bool apply_unit(std::string_view token, int sign, Units& all) {
  std::size_t letters = 0;
  while (letters < token.size() && (std::isalpha(static_cast<unsigned char>(token[letters])) || token[letters] == '%'))
    ++letters;
  const Unit* unit = find_unit(token.substr(0, letters));
  if (unit == nullptr) return false;
  std::string_view rest = token.substr(letters);
  int power = 1;
  if (!rest.empty()) {
    if (rest.front() == '^') rest.remove_prefix(1);
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), power);
    if (error != std::errc() || end != rest.data() + rest.size() || std::abs(power) > 9) return false;
  }
  power *= sign;
  all.decade += power * unit->decade;
  all.factor *= std::pow(unit->factor, power);
  all.dimension.length += power * unit->dimension.length;
  all.dimension.mass += power * unit->dimension.mass;
  all.dimension.time += power * unit->dimension.time;
  all.dimension.temperature += power * unit->dimension.temperature;
  all.any = true;
  return true;
}

/// The number in a text times a power of ten, rounded once: 0.807 and -3 give the double nearest to 0.000807.
std::optional<double> scaled_number(std::string_view number, int decade) {
  const std::size_t e = number.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) {
    const std::size_t digits = e + 1 + (number[e + 1] == '+' ? 1 : 0);
    std::from_chars(number.data() + digits, number.data() + number.size(), exponent);
  }
  const std::string text = std::string(number.substr(0, e)) + "e" + std::to_string(exponent + decade);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Replaces the micro sign and the Greek letter by "u", the degree sign by "deg".
std::string in_ascii(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> signs{
      {{"\u00b5", "u"}, {"\u03bc", "u"}, {"\u00b0", "deg"}}};
  std::string plain(text);
  for (const auto& [sign, ascii] : signs)
    for (std::size_t at = plain.find(sign); at != std::string::npos; at = plain.find(sign, at))
      plain.replace(at, sign.size(), ascii);
  return plain;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view given) {
  const std::string plain_text = in_ascii(given);
  std::string_view text = trimmed(plain_text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double plain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), plain);
  if (error != std::errc() || !std::isfinite(plain)) return std::nullopt;
  const std::string_view number = text.substr(0, std::size_t(end - text.data()));
  std::string_view rest = trimmed(text.substr(number.size()));
  if (rest == "degC" || rest == "C") return Quantity{plain + 273.15, dimension::temperature, true};
  if (rest == "degF") return Quantity{(plain + 459.67) / 1.8, dimension::temperature, true};
  if (rest.starts_with("1/")) rest.remove_prefix(1);  // "3 1/s", as unit_name() writes it
  Units units;
  int sign = 1;
  while (!rest.empty()) {
    const std::size_t length = std::min(rest.find_first_of(" */"), rest.size());
    if (length > 0 && !apply_unit(rest.substr(0, length), sign, units)) return std::nullopt;
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
  const auto value = scaled_number(number, units.decade);
  if (!value || !std::isfinite(*value * units.factor)) return std::nullopt;
  return Quantity{*value * units.factor, units.dimension, units.any};
}

std::vector<std::string> unit_names() {
  std::vector<std::string> names;
  for (const Unit& unit : known_units) names.emplace_back(unit.name);
  names.insert(names.end(), {"degC", "degF"});
  return names;
}

std::string unit_name(const Dimension& d) {
  constexpr std::array<std::pair<Dimension, std::string_view>, 7> named{{{dimension::pressure, "Pa"},
                                                                         {dimension::pressure_gradient, "Pa/m"},
                                                                         {dimension::stiffness, "N/m"},
                                                                         {dimension::energy, "J"},
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
