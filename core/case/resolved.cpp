// The resolved case, in SI: every key with its value, given or not.
#include <fmt/format.h>

#include <string>
#include <string_view>

#include "core/case/file.hpp"
#include "core/case/keys.hpp"

namespace polybed::core {

namespace {

/// A value as TOML in SI; empty if it is not set.
struct AsToml {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double v) const {
    const std::string text = fmt::format("{}", v);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  std::string operator()(std::int64_t v) const { return std::to_string(v); }
  std::string operator()(bool v) const { return v ? "true" : "false"; }
  std::string operator()(const std::string& text) const {
    std::string out = "\"";
    for (char c : text) {
      if (c == '"' || c == '\\') out += '\\';
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
        out += fmt::format("\\u{:04X}", int(c));
      else
        out += c;
    }
    return out + "\"";
  }
  std::string operator()(const std::pair<double, double>& point) const {
    return fmt::format("[{}, {}]", (*this)(point.first), (*this)(point.second));
  }
  template <class T>
  std::string operator()(const std::vector<T>& values) const {
    std::string text;
    for (const T& v : values) text += (text.empty() ? "" : ", ") + (*this)(v);
    return values.empty() ? "" : "[" + text + "]";
  }
};

/// Whether a key of [bed] has no meaning: it follows from counted or listed particles, or was not given.
bool idle(const Scene& scene, std::string_view name) {
  const bool follows = !scene.bed.particles.empty() || scene.bed.start.kind == StartKind::list;
  if (name == "volume_share" || name == "static_height") return follows;
  return name == "solids_fraction" && !(scene.bed.solids_fraction > 0);
}

std::string entries(const Scene& scene, const Table& table, std::size_t index) {
  std::string out;
  for (const Key& key : table.keys) {
    if (key.replaced || (table.name == "bed" && idle(scene, key.name))) continue;
    const Value value = key.get(scene, index);
    const double* number = key.kind == Kind::word_or_number ? std::get_if<double>(&value) : nullptr;
    const std::string text = number != nullptr ? fmt::format("{}", *number) : std::visit(AsToml{}, value);
    if (!text.empty()) out += fmt::format("{} = {}\n", key.name, text);
  }
  return out;
}

}  // namespace

std::string resolved_case(const Scene& scene) {
  const Scene untouched;
  std::string out;
  for (std::string_view name : {"",       "column", "fluid",     "species",   "bed",       "layer",   "inlet",
                                "jet",    "feed",   "discharge", "wall",      "effects",   "chooser", "run",
                                "output", "tfm",    "dem",       "inversion", "calibrate", "resolve", "contact_pair"}) {
    if (name == "effects") {
      out += "\n[effects]\n";
      out += fmt::format("{} = \"none\"\n", other_roles);
      for (const auto& [role, law] : scene.effects) out += fmt::format("{} = {}\n", role, AsToml{}(law));
      continue;
    }
    const Table& table = *find_table(name);
    // These have no line when they are at their defaults.
    const bool may_be_absent = name == "chooser" || name == "inversion" || name == "calibrate" || name == "resolve";
    for (std::size_t n = 0; n < table.count(scene); ++n) {
      const std::string text = entries(scene, table, n);
      if (may_be_absent && text == entries(untouched, table, n)) continue;
      if (!name.empty()) out += fmt::format("\n{}\n", header(table));
      out += text;
    }
  }
  return out;
}

std::string text_hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (unsigned char c : text) hash = (hash ^ c) * 0x100000001b3ULL;
  return fmt::format("{:016x}", hash);
}

std::string case_hash(const Scene& scene) { return text_hash(resolved_case(scene) + scene.drag_record); }

}  // namespace polybed::core
