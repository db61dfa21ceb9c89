// What the keys of a case say of each other, and what follows from them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <string_view>

#include "core/case/file.hpp"
#include "core/case/keys.hpp"
#include "core/case/resolve_particles.hpp"
#include "core/numerics/schedule.hpp"

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
  Checker(Scene& scene, std::string name, WrongKeys& wrong) : scene_(scene), name_(std::move(name)), wrong_(wrong) {}
  void all(bool by_particles);
  [[nodiscard]] Problems problems() && { return std::move(problems_); }

 private:
  void column();
  void room_for_particles(double largest);
  void species();
  void contact_pairs();
  void bed(bool by_particles);
  void jets();
  void fluid();
  void feeds();
  void chooser();
  void numerics();
  bool lies_on_end(const std::vector<double>& from, const std::vector<double>& to, const char* what);
  template <class... Args>
  void add(fmt::format_string<Args...> text, Args&&... args) {
    problems_.push_back({name_, 0, 0, fmt::format(text, std::forward<Args>(args)...)});
  }
  Scene& scene_;
  std::string name_;
  WrongKeys& wrong_;
  Problems problems_;
};

/// Every check whose keys are sound.
void Checker::all(bool by_particles) {
  if (wrong_.sound({"column.size", "column.cells"}))
    column();
  else
    wrong_.add("column.size");  // which fills in the axes that others read
  if (wrong_.sound({"column.size", "jet."})) jets();
  if (wrong_.sound({"column.size", "feed.", "species.name", "bed.solids_fraction"})) feeds();
  if (wrong_.sound({"species.name", "contact_pair."})) species();
  if (wrong_.sound({"column.size", "bed.start", "bed.particles", "bed.volume_share"}) &&
      wrong_.sound({"bed.static_height", "bed.solids_fraction", "bed.start_solids_fraction"}))
    bed(by_particles);
  fluid();
  chooser();
  numerics();
}

void Checker::column() {
  Column& c = scene_.column;
  const std::size_t n = c.given_size.size();
  const bool plain = n == 2 || n == 3;
  if (!plain || c.given_cells.size() != n) {
    wrong_.add("column.size");
    return plain ? add("column.cells has {} numbers, column.size {}", c.given_cells.size(), n)
                 : add("column.size has {} numbers: two (width, height) or three (width, depth, height)", n);
  }
  double smallest = 1, largest = 0;
  for (const Species& s : scene_.species) {
    smallest = std::min(smallest, s.diameter);
    largest = std::max(largest, s.diameter);
  }
  c.dimensions = int(n);
  const double skin = scene_.dem.skin.value_or(0.1 * smallest);
  // Axes are x (width), y (height), z (depth): the height comes last in the case and second in the grid.
  const auto cells = [&](std::size_t k) { return int(c.given_cells[k]); };
  if (n == 3) {
    if (c.depth) add("column.depth is the depth of a two-dimensional column; column.size has three numbers");
    c.size = {c.given_size[0], c.given_size[2], c.given_size[1]};
    c.cells = {cells(0), cells(2), cells(1)};
  } else {
    c.size = {c.given_size[0], c.given_size[1], c.depth.value_or(2 * largest + 2 * skin)};
    c.cells = {cells(0), cells(1), 1};
  }
  if (wrong_.sound("species.diameter")) room_for_particles(largest);
  constexpr double most_cells = 2147483647;  // hypre numbers them with 32 bits
  const double all = double(c.cells[0]) * c.cells[1] * c.cells[2];
  if (all > most_cells)
    add("column.cells: {:.3g} cells; at most {:.0f} can be numbered, however large the memory", all, most_cells);
}

/// A column that the largest particle does not fit into has no solids fraction that means anything.
void Checker::room_for_particles(double largest) {
  constexpr std::array<const char*, 3> sides{"width", "height", "depth"};
  for (std::size_t axis = 0; axis < sides.size(); ++axis)
    if (largest > scene_.column.size[axis])
      add("species.diameter: {:.4g} m is more than the {} of the column, {:.4g} m", largest, sides[axis],
          scene_.column.size[axis]);
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
      if (!names.contains(name) || name == "fluid") add("contact_pair.between: no species '{}'", name);
  }
  contact_pairs();
}

/// Each pair once, and no wall against a wall.
void Checker::contact_pairs() {
  std::set<std::pair<std::string, std::string>> seen;
  for (const ContactPair& pair : scene_.contact_pairs) {
    if (pair.between.size() != 2) continue;
    const auto [first, second] = std::minmax(pair.between[0], pair.between[1]);
    if (first == "wall" && second == "wall") add("contact_pair.between: a wall touches no wall; name a species");
    if (!seen.emplace(first, second).second) add("two [[contact_pair]] of {} and {}: write one", first, second);
  }
}

/// True if a part of the bottom or the top is one.
bool Checker::lies_on_end(const std::vector<double>& from, const std::vector<double>& to, const char* what) {
  const Column& c = scene_.column;
  const std::size_t n = c.dimensions == 3 ? 2 : 1;
  const std::array<double, 2> size{c.size[0], c.size[2]};
  if (from.size() != n || to.size() != n) {
    add("{0}.from and {0}.to have {1} and {2} numbers: {3} here", what, from.size(), to.size(), n);
    return false;
  }
  for (std::size_t d = 0; d < n; ++d)
    if (!(from[d] < to[d] && to[d] <= size[d] * (1 + 1e-12))) {
      add("a {} from {:.4g} to {:.4g} m does not lie on the bottom, 0 to {:.4g} m", what, from[d], to[d], size[d]);
      return false;
    }
  return true;
}

/// True if two parts of an end have nothing in common; a part without corners is all of it.
template <class Part>
bool apart(const Part& a, const Part& b) {
  for (std::size_t d = 0; d < std::min(a.from.size(), b.from.size()); ++d)
    if (a.to[d] <= b.from[d] || b.to[d] <= a.from[d]) return true;
  return false;
}

void Checker::jets() {
  if (!scene_.jets.empty() && scene_.column.closed) add("[[jet]] cannot act: column.closed = true");
  bool lie = true;
  for (const Jet& jet : scene_.jets) lie = lies_on_end(jet.from, jet.to, "jet") && lie;
  for (std::size_t a = 0; lie && a < scene_.jets.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (!apart(scene_.jets[a], scene_.jets[b])) add("two jets overlap: [[jet]] number {} and {}", b + 1, a + 1);
}

void Checker::feeds() {
  const bool closed = scene_.column.closed;
  if (closed && scene_.column.outlet == Outlet::open) add("column.outlet = \"open\" cannot act: column.closed = true");
  if (closed && !scene_.feeds.empty()) add("[[feed]] cannot act: column.closed = true");
  bool lie = true;
  for (const Feed& feed : scene_.feeds) {
    if (!feed.from.empty() || !feed.to.empty()) lie = lies_on_end(feed.from, feed.to, "feed") && lie;
    if (std::none_of(scene_.species.begin(), scene_.species.end(),
                     [&](const auto& s) { return s.name == feed.species; }))
      add("feed.species = \"{}\": no such species", feed.species);
    for (const auto& [t, flux] : feed.superficial_velocity)
      if (flux > scene_.bed.solids_fraction * feed.velocity)
        add("a feed of {} of {:.4g} m/s at a velocity of {:.4g} m/s would be denser than the settled bed: raise "
            "feed.velocity above {:.4g} m/s",
            feed.species, flux, feed.velocity, flux / scene_.bed.solids_fraction);
  }
  for (std::size_t a = 0; lie && a < scene_.feeds.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Feed &one = scene_.feeds[a], &other = scene_.feeds[b];
      if (one.species == other.species && one.at == other.at && !apart(one, other))
        add("two feeds of {} overlap: [[feed]] number {} and {}", one.species, b + 1, a + 1);
    }
}

void Checker::bed(bool by_particles) {
  Bed& bed = scene_.bed;
  if (bed.start.kind == StartKind::list) return;  // which says itself how much there is
  const std::size_t species = scene_.species.size();
  const double area = scene_.column.size[0] * scene_.column.size[2];
  if (by_particles) {
    if (!wrong_.sound({"species.diameter", "column.depth", "dem.skin"})) return;
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
  const Substance substance = fluid.substance();
  if (fluid.equation_of_state == Compressibility::ideal_gas && substance == Substance::water)
    add("fluid.equation_of_state = \"ideal_gas\": water is a liquid; \"tait\" is the law of a compressible liquid");
  if (fluid.equation_of_state == Compressibility::tait && substance == Substance::air)
    add("fluid.equation_of_state = \"tait\": air is a gas; \"ideal_gas\" is its law");
}

void Checker::chooser() {
  const auto range = [&](const char* key, const std::vector<double>& values) {
    if (!values.empty() && (values.size() != 2 || values[0] > values[1]))
      add("chooser.{}: two values, the least and the greatest", key);
  };
  range("velocity_range", scene_.chooser.velocity_range);
  range("temperature_range", scene_.chooser.temperature_range);
}

void Checker::numerics() {
  const Tfm& tfm = scene_.tfm;
  const bool implicit = tfm.integrator == TfmIntegrator::implicit_steps;
  if (tfm.fixed_step && implicit) add("tfm.fixed_step works with the explicit integrator only");
  if (implicit && tfm.rtol > 2e-3)
    add("tfm.rtol = {} with the implicit integrator: at most 0.002, beyond which its predictor jumps past "
        "packing",
        tfm.rtol);
  const double until = scene_.run.until;
  scene_.output.every = scene_.output.every.value_or(until / 20);
  scene_.output.history_every = scene_.output.history_every.value_or(until / 400);
  scene_.output.checkpoint_every = scene_.output.checkpoint_every.value_or(until / 10);
}

}  // namespace

std::vector<CaseProblem> resolve(Scene& scene, const std::string& name, bool by_particles, WrongKeys wrong) {
  join_times(scene);
  resolve_materials(scene);
  Checker checker(scene, name, wrong);
  checker.all(by_particles);
  Problems problems = std::move(checker).problems();
  for (std::string& message : resolve_particles(scene, name, wrong))
    problems.push_back({name, 0, 0, std::move(message)});
  return problems;
}

}  // namespace polybed::core
