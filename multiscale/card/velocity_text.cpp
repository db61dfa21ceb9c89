#include "multiscale/card/velocity_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "measures/bed_table.hpp"
#include "multiscale/card/card.hpp"

namespace polybed::multiscale {

namespace {

/// Factor and prefix for a quantity.
std::pair<double, const char*> prefix_of(double value) {
  const double size = std::abs(value);
  if (size >= 1 || size == 0) return {1, ""};
  return size >= 1e-3 ? std::pair(1e3, "m") : std::pair(1e6, "µ");
}

constexpr std::size_t most_listed = 4;  // species by name

std::string of_species(const BedOfCase& bed, std::optional<double> SpeciesInFluid::*velocity) {
  std::vector<SpeciesInFluid> known;
  std::copy_if(bed.species.begin(), bed.species.end(), std::back_inserter(known),
               [&](const SpeciesInFluid& species) { return (species.*velocity).has_value(); });
  const bool range = known.size() > most_listed;
  if (range) {
    const auto [least, greatest] = std::minmax_element(
        known.begin(), known.end(), [&](const auto& a, const auto& b) { return *(a.*velocity) < *(b.*velocity); });
    known = {*least, *greatest};
  }
  std::vector<std::string> parts;
  for (const SpeciesInFluid& species : known)
    parts.push_back(species.name + " " + with_prefix(*(species.*velocity), "m/s"));
  return range ? parts.front() + " to " + parts.back() : each(parts);
}

/// Two digits; more if two would show no difference or end before the point.
std::string times_text(double ratio) {
  if (ratio >= 100) return fmt::format("{:.0f}", ratio);
  return std::abs(ratio - 1) < 0.05 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.2g}", ratio);
}

/// Where the fluidisation of several species begins and ends, and what the packing makes of it; empty if neither is
/// known.
std::string spread_text(const BedOfCase& bed) {
  std::vector<std::string> parts;
  if (bed.first && bed.last)
    parts.push_back(fmt::format("between {} ({} alone) and {} ({} alone)",
                                velocity_text(*bed.first->minimum_fluidisation, bed.area), bed.first->name,
                                velocity_text(*bed.last->minimum_fluidisation, bed.area), bed.last->name));
  std::vector<std::string> packings;
  for (const auto& [solids, velocity] : bed.by_packing)
    packings.push_back(fmt::format("{} if settled to {:.3g} of solids", velocity_text(velocity, bed.area), solids));
  if (!packings.empty()) parts.push_back(each(packings));
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// The predictions by the formulas of the shape that the case does not use.
std::string shapes_text(const ByLaw& shape, double area) {
  std::vector<std::string> parts;
  if (shape.minimum_fluidisation) parts.push_back("fluidises at " + velocity_text(*shape.minimum_fluidisation, area));
  if (shape.height) parts.push_back(with_prefix(*shape.height, "m") + " high");
  return fmt::format("{} by shape = \"{}\"", each(parts), shape.law);
}

/// Where the classes of a bed bubble (Geldart, Powder Technology 7 (1973) 285); empty for cohesive powders.
std::string bubbling_text(const BedOfCase& bed) {
  const auto has = [&](const char* letter) {
    return std::any_of(bed.species.begin(), bed.species.end(), [&](const auto& one) { return one.geldart == letter; });
  };
  std::vector<std::string> parts;
  if (has("A")) parts.emplace_back("A bubbles above u_mb, which exceeds u_mf");
  if (has("B") || has("D"))
    parts.push_back(fmt::format("{}{}{} bubble{} above u_mf", has("B") ? "B" : "", has("B") && has("D") ? " and " : "",
                                has("D") ? "D" : "", has("B") && has("D") ? "" : "s"));
  return parts.empty() ? "" : each(parts) + ": the height swings about its mean (Geldart 1973)";
}

}  // namespace

std::string plain(double value, int digits) {
  const bool fits = std::abs(value) < std::pow(10.0, digits) - 0.5;
  return fits ? fmt::format("{:.{}g}", value, digits) : fmt::format("{:.0f}", value);
}

std::string with_prefix(double value, const char* unit) {
  const auto [factor, prefix] = prefix_of(value);
  return fmt::format("{:.3g} {}{}", factor * value, prefix, unit);
}

std::string range_text(double low, double high, const char* unit) {
  const auto [factor, prefix] = prefix_of(high);
  const std::string least = fmt::format("{:.3g}", factor * low), greatest = fmt::format("{:.3g}", factor * high);
  return fmt::format("{}{} {}{}", least == greatest ? "" : least + " to ", greatest, prefix, unit);
}

std::string velocity_text(double velocity, double area) { return velocities_text(velocity, velocity, area); }

std::string velocities_text(double low, double high, double area) {
  std::string text = range_text(low, high, "m/s");
  if (!(area > 0)) return text;
  const std::string least = flow_text(low, area), most = flow_text(high, area);
  constexpr std::size_t begin = 2, end = 5;  // characters before and after the number
  return text + (least == most ? most : least.substr(0, least.size() - end) + " to " + most.substr(begin));
}

std::string flow_text(double velocity, double area) {
  constexpr double litres_per_hour = 3.6e6;  // of a m3/s
  const double flow = litres_per_hour * area * velocity;
  return area > 0 ? fmt::format(" ({} l/h)", plain(flow, 3)) : "";
}

std::string mass_text(double mass) { return mass < 1 ? with_prefix(1e3 * mass, "g") : fmt::format("{:.4g} kg", mass); }

std::string masses_text(const std::vector<std::pair<std::string, double>>& masses) {
  std::vector<std::string> parts;
  double all = 0;
  for (const auto& [name, mass] : masses) all += mass;
  for (const auto& [name, mass] : masses)
    parts.push_back(name + " " + mass_text(mass > measures::trace * all ? mass : 0));
  return each(parts);
}

std::string each(const std::vector<std::string>& parts) { return fmt::format("{}", fmt::join(parts, ", ")); }

std::string by_others(const BedOfCase& bed, std::optional<double> ByLaw::*number, std::optional<double> most) {
  std::vector<std::string> names;
  double low = HUGE_VAL, high = 0;
  for (const ByLaw& one : bed.others) {
    const std::optional<double> value = one.*number ? one.*number : most;
    if (!value) continue;
    names.push_back(one.law);
    low = std::min(low, *value);
    high = std::max(high, *value);
  }
  if (names.empty()) return "";
  const std::string least = plain(1e3 * low, 3), greatest = plain(1e3 * high, 3);  // heights, mm
  std::string range =
      most ? (least == greatest ? least : least + " to " + greatest) + " mm" : velocities_text(low, high, bed.area);
  if (most && high >= *most) range = (low < *most ? least + " mm " : std::string()) + "up to the top of the column";
  return fmt::format("{} by laws of such beds: {}", range, each(names));
}

void add_velocities(const BedOfCase& bed, bool in_full, std::vector<std::string>& lines) {
  if (bed.species.empty()) return;
  if (bed.own.minimum_fluidisation) {
    std::string text =
        bed.species.size() > 1 ? of_species(bed, &SpeciesInFluid::minimum_fluidisation) + ", mixture " : std::string();
    text += velocity_text(*bed.own.minimum_fluidisation, bed.area) + " by " +
            (bed.own.law.empty() ? "Wen and Yu's correlation" : bed.own.law);
    if (const auto ratio = bed.velocity_ratio()) {
      text += fmt::format("; u = {} is {} times that", velocity_text(*bed.velocity, bed.area), times_text(*ratio));
      if (bed.inlet)
        text +=
            fmt::format(" with the jets averaged over the bottom; the inlet alone, {}, is {} times that",
                        velocity_text(*bed.inlet, bed.area), times_text(*bed.inlet / *bed.own.minimum_fluidisation));
    }
    lines.push_back(card_line("fluidises at", text));
    std::vector<std::string> more;
    if (in_full) more = {spread_text(bed), by_others(bed, &ByLaw::minimum_fluidisation, {})};
    for (std::size_t n = 0; in_full && n < bed.shapes.size(); ++n) more.push_back(shapes_text(bed.shapes[n], bed.area));
    for (const std::string& one : more)
      if (!one.empty()) lines.push_back(card_line("", one));
  }
  for (const auto& [heading, velocity] :
       {std::pair{"falls at", &SpeciesInFluid::terminal}, std::pair{"rises at", &SpeciesInFluid::rising}})
    if (const std::string text = of_species(bed, velocity); !text.empty()) lines.push_back(card_line(heading, text));
  std::vector<std::string> classes;
  for (const SpeciesInFluid& species : bed.species)
    if (!species.geldart.empty())
      classes.push_back(bed.species.size() > 1 ? species.name + " " + species.geldart : species.geldart);
  if (classes.empty()) return;
  lines.push_back(card_line("Geldart class", each(classes)));
  if (const std::string text = bubbling_text(bed); in_full && !text.empty()) lines.push_back(card_line("", text));
}

}  // namespace polybed::multiscale
