// What the keys of a case say of each other, and the case written out whole.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <string_view>

#include "core/case_file.hpp"
#include "core/keys.hpp"

namespace polybed::core {

namespace {

using Problems = std::vector<CaseProblem>;

/// True if a name may stand in the header of a CSV file, in the path of a dataset and in XML.
bool can_name_files(const std::string& name) {
  return !name.empty() && std::none_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x20 || c == 0x7f || std::string_view(",/<>&\"\\").find(char(c)) != std::string_view::npos;
  });
}

/// Collects problems that have no line of their own.
class Checker {
 public:
  Checker(Scene& scene, std::string name) : scene_(scene), name_(std::move(name)) {}
  void column();
  void species();
  void bed(bool by_particles);
  void jets();
  void fluid();
  void numerics();
  [[nodiscard]] Problems problems() && { return std::move(problems_); }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> text, Args&&... args) {
    problems_.push_back({name_, 0, 0, fmt::format(text, std::forward<Args>(args)...)});
  }
  Scene& scene_;
  std::string name_;
  Problems problems_;
};

void Checker::column() {
  Column& c = scene_.column;
  const std::size_t n = c.given_size.size();
  if (n != 2 && n != 3)
    return add("column.size has {} numbers: two (width, height) or three (width, depth, height)", n);
  if (c.given_cells.size() != n) return add("column.cells has {} numbers, column.size {}", c.given_cells.size(), n);
  double smallest = 1, largest = 0;
  for (const Species& s : scene_.species) {
    smallest = std::min(smallest, s.diameter);
    largest = std::max(largest, s.diameter);
  }
  c.dimensions = int(n);
  // Axes are x (width), y (height), z (depth): the height comes last in the case and second in the grid.
  const auto cells = [&](std::size_t k) { return int(c.given_cells[k]); };
  if (n == 3) {
    if (c.depth) add("column.depth is the depth of a two-dimensional column; column.size has three numbers");
    c.size = {c.given_size[0], c.given_size[2], c.given_size[1]};
    c.cells = {cells(0), cells(2), cells(1)};
  } else {
    c.size = {c.given_size[0], c.given_size[1], c.depth.value_or(2 * largest + 0.2 * smallest)};
    c.cells = {cells(0), cells(1), 1};
  }
  constexpr double most_cells = 2e7;
  const double all = double(c.cells[0]) * c.cells[1] * c.cells[2];
  if (all > most_cells)
    add("column.cells: {:.3g} cells would need about {:.3g} GB of memory; at most {:.0e} here", all, all * 1e-6,
        most_cells);
}

void Checker::species() {
  std::set<std::string> names{"wall", "fluid"};  // of contact pairs and of the dataset u_fluid
  if (scene_.species.empty()) add("[[species]] is missing: at least one");
  if (scene_.species.size() > 15) add("[[species]]: {} species, at most 15", scene_.species.size());
  for (const Species& s : scene_.species) {
    if (!names.insert(s.name).second) add("species.name = \"{}\" stands twice, or is \"wall\" or \"fluid\"", s.name);
    if (!can_name_files(s.name))
      add("species.name = \"{}\" names columns and datasets: not empty, without , / < > & \" \\ and line "
          "ends",
          s.name);
  }
  for (const ContactPair& pair : scene_.contact_pairs) {
    if (pair.between.size() != 2) add("contact_pair.between takes two names");
    for (const std::string& name : pair.between)
      if (!names.contains(name)) add("contact_pair.between: no species '{}'", name);
  }
}

void Checker::jets() {
  const Column& c = scene_.column;
  const std::size_t n = c.dimensions == 3 ? 2 : 1;
  const std::array<double, 2> size{c.size[0], c.size[2]};
  if (!scene_.jets.empty() && c.closed) add("[[jet]] cannot act: column.closed = true");
  for (const Jet& jet : scene_.jets) {
    if (jet.from.size() != n || jet.to.size() != n) {
      add("jet.from and jet.to have {} and {} numbers: {} here", jet.from.size(), jet.to.size(), n);
      continue;
    }
    for (std::size_t d = 0; d < n; ++d)
      if (!(jet.from[d] < jet.to[d] && jet.to[d] <= size[d] * (1 + 1e-12)))
        add("a jet from {:.4g} to {:.4g} m does not lie on the bottom, 0 to {:.4g} m", jet.from[d], jet.to[d], size[d]);
  }
  const auto apart = [&](const Jet& a, const Jet& b) {
    for (std::size_t d = 0; d < n; ++d)
      if (a.to[d] <= b.from[d] || b.to[d] <= a.from[d]) return true;
    return false;
  };
  for (std::size_t a = 0; problems_.empty() && a < scene_.jets.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (!apart(scene_.jets[a], scene_.jets[b])) add("two jets overlap: [[jet]] number {} and {}", b + 1, a + 1);
}

void Checker::bed(bool by_particles) {
  Bed& bed = scene_.bed;
  const std::size_t species = scene_.species.size();
  const double area = scene_.column.size[0] * scene_.column.size[2];
  if (by_particles) {
    if (bed.particles.size() != species)
      return add("bed.particles has {} numbers, there are {} species", bed.particles.size(), species);
    double total = 0;
    bed.volume_share.assign(species, 0.0);
    for (std::size_t j = 0; j < species; ++j) {
      bed.volume_share[j] = double(bed.particles[j]) * std::numbers::pi / 6 * std::pow(scene_.species[j].diameter, 3);
      total += bed.volume_share[j];
    }
    if (!(total > 0)) return add("bed.particles: no particles at all");
    for (double& x : bed.volume_share) x /= total;
    bed.static_height = total / (area * bed.solids_fraction);
  }
  if (bed.volume_share.size() != species)
    return add("bed.volume_share has {} numbers, there are {} species", bed.volume_share.size(), species);
  const double sum = std::accumulate(bed.volume_share.begin(), bed.volume_share.end(), 0.0);
  if (std::abs(sum - 1) > 1e-9) add("bed.volume_share sums to {:.9g}, not to 1", sum);
  bed.start_solids_fraction = bed.start_fraction.value_or(bed.solids_fraction);
  if (bed.start_solids_fraction > bed.solids_fraction)
    add("bed.start_solids_fraction = {} is denser than the settled bed, {}", bed.start_solids_fraction,
        bed.solids_fraction);
  const double height = bed.static_height * bed.solids_fraction / bed.start_solids_fraction;
  if (height > scene_.column.size[1])
    add("the bed at its start is {:.4g} m high, the column {:.4g} m: enlarge column.size", height,
        scene_.column.size[1]);
}

void Checker::fluid() {
  const Fluid& fluid = scene_.fluid;
  const std::string& law = fluid.equation_of_state;
  if (fluid.name == "none") add("fluid.name = \"none\" is a scene for the DEM, which is not in this version");
  if (law == "ideal_gas" && fluid.name == "water")
    add("fluid.equation_of_state = \"ideal_gas\": water is a liquid; \"tait\" is the law of a compressible liquid");
  if (law == "tait" && fluid.name == "air")
    add("fluid.equation_of_state = \"tait\": air is a gas; \"ideal_gas\" is its law");
}

void Checker::numerics() {
  const Tfm& tfm = scene_.tfm;
  if (tfm.fixed_step && tfm.integrator == "implicit") add("tfm.fixed_step works with the explicit integrator only");
  if (tfm.integrator == "implicit" && tfm.rtol > 2e-3)
    add("tfm.rtol = {} with the implicit integrator: at most 0.002, beyond which its predictor jumps past "
        "packing",
        tfm.rtol);
  if (scene_.effects.contains("solids_stress") && tfm.max_packing == "auto" &&
      scene_.bed.solids_fraction <= tfm.frictional_onset)
    add("bed.solids_fraction = {} must lie above tfm.frictional_onset = {} for tfm.max_packing = \"auto\"",
        scene_.bed.solids_fraction, tfm.frictional_onset);
  const double until = scene_.run.until;
  scene_.output.every = scene_.output.every.value_or(until / 20);
  scene_.output.history_every = scene_.output.history_every.value_or(until / 400);
  scene_.output.checkpoint_every = scene_.output.checkpoint_every.value_or(until / 10);
}

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
    if (key.table != table) continue;
    const bool by_particles = !scene.bed.particles.empty();
    if (by_particles && table == "bed" && (key.name == "volume_share" || key.name == "static_height")) continue;
    std::string value = std::visit(AsToml{scene, index}, key.place);
    if (key.or_number && value.find_first_of("0123456789") == 1) value = value.substr(1, value.size() - 2);
    if (!value.empty()) out += fmt::format("{} = {}\n", key.name, value);
  }
}

}  // namespace

std::vector<CaseProblem> resolve(Scene& scene, const std::string& name, bool by_particles) {
  Checker checker(scene, name);
  checker.column();
  checker.jets();
  checker.species();
  checker.bed(by_particles);
  checker.fluid();
  checker.numerics();
  return std::move(checker).problems();
}

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
  out += "\n[effects]\n";
  for (const auto& [role, law] : scene.effects) out += fmt::format("{} = \"{}\"\n", role, law);
  for (const char* table : {"run", "output", "tfm", "dem"}) {
    out += fmt::format("\n[{}]\n", table);
    write_table(scene, table, 0, out);
  }
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
