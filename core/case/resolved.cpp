// The case written out whole, in SI: every key with its value, given or not.
#include <fmt/format.h>

#include <string>
#include <string_view>

#include "core/case/file.hpp"
#include "core/case/keys.hpp"
#include "core/case/resolve_particles.hpp"

namespace polybed::core {

namespace {

/// One value as TOML in SI; empty if it is not set.
struct AsToml {
  Scene& scene;
  std::size_t index;
  static std::string quoted(const std::string& text) {
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
  static std::string literal(double v) {
    const std::string text = fmt::format("{}", v);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  static std::string literal(std::int64_t v) { return std::to_string(v); }
  static std::string literal(const std::string& v) { return quoted(v); }
  template <class T>
  static std::string literal(const std::vector<T>& values) {
    std::string text;
    for (const T& v : values) text += (text.empty() ? "" : ", ") + literal(v);
    return values.empty() ? "" : "[" + text + "]";
  }
  std::string operator()(Place<double> p) const { return literal(p(scene, index)); }
  std::string operator()(Place<std::optional<double>> p) const {
    return p(scene, index) ? literal(*p(scene, index)) : std::string();
  }
  std::string operator()(Place<int> p) const { return std::to_string(p(scene, index)); }
  std::string operator()(Place<std::uint64_t> p) const { return std::to_string(p(scene, index)); }
  std::string operator()(Place<bool> p) const { return p(scene, index) ? "true" : "false"; }
  std::string operator()(Place<std::string> p) const { return quoted(p(scene, index)); }
  std::string operator()(Place<std::vector<double>> p) const { return literal(p(scene, index)); }
  std::string operator()(Place<std::vector<std::int64_t>> p) const { return literal(p(scene, index)); }
  std::string operator()(Place<std::vector<std::string>> p) const { return literal(p(scene, index)); }
  std::string operator()(Place<Points> p) const {
    std::string text;
    for (const auto& [t, v] : p(scene, index))
      text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", literal(t), literal(v));
    return p(scene, index).empty() ? "" : "[" + text + "]";
  }
};

void write_table(Scene& scene, std::string_view table, std::size_t index, std::string& out) {
  for (const Key& key : keys()) {
    if (key.table != table || key.replaced) continue;
    const bool follows = !scene.bed.particles.empty() || is_list(scene.bed);
    if (follows && table == "bed" && (key.name == "volume_share" || key.name == "static_height")) continue;
    if (key.path() == "bed.solids_fraction" && !(scene.bed.solids_fraction > 0)) continue;  // of a list: not given
    std::string value = std::visit(AsToml{scene, index}, key.place);
    if (key.or_number && value.find_first_of("0123456789") == 1) value = value.substr(1, value.size() - 2);
    if (!value.empty()) out += fmt::format("{} = {}\n", key.name, value);
  }
}

}  // namespace

std::string resolved_case(const Scene& given) {
  Scene scene = given;
  std::string out;
  write_table(scene, "", 0, out);
  for (const char* table : {"column", "fluid"}) {
    out += fmt::format("\n[{}]\n", table);
    write_table(scene, table, 0, out);
  }
  for (std::size_t n = 0; n < scene.species.size(); ++n) {
    out += "\n[[species]]\n";
    write_table(scene, "species", n, out);
  }
  for (const char* table : {"bed", "inlet"}) {
    out += fmt::format("\n[{}]\n", table);
    write_table(scene, table, 0, out);
  }
  for (std::size_t n = 0; n < scene.jets.size(); ++n) {
    out += "\n[[jet]]\n";
    write_table(scene, "jet", n, out);
  }
  for (std::size_t n = 0; n < scene.feeds.size(); ++n) {
    out += "\n[[feed]]\n";
    write_table(scene, "feed", n, out);
  }
  out += "\n[effects]\n";
  for (const auto& [role, law] : scene.effects) out += fmt::format("{} = \"{}\"\n", role, law);
  // What is chosen by hand has no line of the chooser.
  Scene untouched;
  std::string chooser, standard;
  write_table(scene, "chooser", 0, chooser);
  write_table(untouched, "chooser", 0, standard);
  if (chooser != standard) out += "\n[chooser]\n" + chooser;
  for (const char* table : {"run", "output", "tfm", "dem"}) {
    out += fmt::format("\n[{}]\n", table);
    write_table(scene, table, 0, out);
  }
  std::string boxes, usual;
  Scene bare;
  write_table(scene, "calibrate", 0, boxes);
  write_table(bare, "calibrate", 0, usual);
  if (boxes != usual) out += "\n[calibrate]\n" + boxes;
  for (std::size_t n = 0; n < scene.contact_pairs.size(); ++n) {
    out += "\n[[contact_pair]]\n";
    write_table(scene, "contact_pair", n, out);
  }
  return out;
}

std::string text_hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (unsigned char c : text) hash = (hash ^ c) * 0x100000001b3ULL;
  return fmt::format("{:016x}", hash);
}

}  // namespace polybed::core
