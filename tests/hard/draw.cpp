#include "hard/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "closures/minimum_fluidisation.hpp"
#include "core/numerics/random.hpp"

namespace polybed::hard {

namespace {

constexpr int most_species = 6;
constexpr double gravity = 9.81;
const std::array<const char*, 3> integrators{"auto", "explicit", "implicit"};
const std::array<const char*, 3> periods{"every", "history_every", "checkpoint_every"};
constexpr int most_breakpoints = 3;
const std::array<const char*, 5> drag_laws{"cello", "di_felice", "gidaspow", "ergun", "wen_yu"};

/// Draws the numbers of one scene in a row.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t n) : seed_(seed), n_(n) {}
  double even() { return core::uniform(seed_, n_, count_++); }
  double logarithmic(double low, double high) { return low * std::pow(high / low, even()); }
  int whole(int number) { return std::min(int(even() * number), number - 1); }

 private:
  std::uint64_t seed_, n_, count_ = 0;
};

std::string numbered(const char* name, int j) { return fmt::format("{} {}", name, j + 1); }

/// What a draw says of its fluid and of the mean of its solids.
struct Means {
  double diameter = 0, density = 0, largest = 0;
};

/// Of the volume of the solids, each species.
std::vector<double> shares_of(const Draw& draw) {
  std::vector<double> shares;
  for (int j = 0; j < int(draw.of("species")); ++j) shares.push_back(draw.of(numbered("share", j)));
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= all;
  return shares;
}

Means means_of(const Draw& draw) {
  Means means;
  const std::vector<double> shares = shares_of(draw);
  for (int j = 0; j < int(shares.size()); ++j) {
    const double share = shares[std::size_t(j)], d = draw.of(numbered("diameter", j));
    means.diameter += share / d;  // of Sauter
    means.density += share * draw.of(numbered("density", j));
    means.largest = std::max(means.largest, d);
  }
  means.diameter = 1 / means.diameter;
  return means;
}

/// With a fluid heavier than the solids it flows downwards.
double velocity_of(const Draw& draw, const Means& means) {
  const double excess = means.density - draw.of("fluid density");
  return std::copysign(
      draw.of("velocity over u_mf") * closures::minimum_fluidisation(means.diameter, excess, draw.of("fluid density"),
                                                                     draw.of("viscosity"), gravity),
      excess);
}

std::string species_text(const Draw& draw) {
  std::string text;
  for (int j = 0; j < int(draw.of("species")); ++j)
    text += fmt::format("[[species]]\nname = \"s{}\"\ndiameter = \"{:.17g} m\"\ndensity = {:.17g}\n", j + 1,
                        draw.of(numbered("diameter", j)), draw.of(numbered("density", j)));
  return text;
}

std::string shares_text(const Draw& draw) {
  const std::vector<double> shares = shares_of(draw);
  double before = 0;
  std::string text;
  for (std::size_t j = 0; j < shares.size(); ++j) {
    text += fmt::format("{}{:.17g}", j > 0 ? ", " : "", j + 1 < shares.size() ? shares[j] : 1 - before);
    before += shares[j];
  }
  return text;
}

/// An inlet that keeps its velocity, or one that jumps at the drawn breakpoints.
std::string inlet_text(const Draw& draw, double velocity) {
  const int breakpoints = int(draw.of("breakpoints"));
  if (breakpoints == 0) return fmt::format("[inlet]\nsuperficial_velocity = {:.17g}\n", velocity);
  std::string text = fmt::format("[inlet]\nsuperficial_velocity = [[0, {:.17g}]", velocity);
  double last = 0;
  for (int n = 0; n < breakpoints; ++n) {
    const double time = draw.of(numbered("breakpoint", n));
    if (time <= last) continue;  // a table's times increase
    text += fmt::format(", [{}, {:.17g}]", time, velocity * draw.of(numbered("velocity factor", n)));
    last = time;
  }
  return text + "]\n";
}

/// End, output and checkpoint times; a period of 0 is left to the program.
std::string times_text(const Draw& draw) {
  std::string text = fmt::format("[run]\nuntil = {}\n[output]\n", draw.of("end"));
  for (const char* period : periods)
    if (const double every = draw.of(period); every > 0) text += fmt::format("{} = {}\n", period, every);
  return text;
}

std::string continuum_text(const Draw& draw, const Means& means) {
  const double cell = draw.of("cell over diameter") * means.largest;
  const int nx = int(draw.of("columns")), ny = 40;
  const bool closed = draw.of("closed") > 0;
  std::string text =
      fmt::format("[column]\nsize = [{:.17g}, {:.17g}]\ncells = [{}, {}]\nsides = \"periodic\"\nclosed = {}\n",
                  nx * cell, ny * cell, nx, ny, closed ? "true" : "false");
  text += fmt::format("[fluid]\nname = \"fluid\"\ndensity = {:.17g}\nviscosity = {:.17g}\n", draw.of("fluid density"),
                      draw.of("viscosity"));
  text += species_text(draw);
  const double start = draw.of("start fraction");
  text += fmt::format(
      "[bed]\nvolume_share = [{}]\nstatic_height = {:.17g}\nsolids_fraction = 0.6\nstart_solids_fraction = {:.17g}\n",
      shares_text(draw), 0.4 * ny * cell * start / 0.6, start);
  if (!closed) text += inlet_text(draw, velocity_of(draw, means));
  text += fmt::format("[effects]\ndrag = \"{}\"\nsolids_stress = \"frictional\"\n",
                      drag_laws[std::size_t(draw.of("drag law"))]);
  if (draw.of("species exchange") > 0) text += "species_exchange = \"syamlal\"\n";
  return text + times_text(draw) +
         fmt::format("[tfm]\nintegrator = \"{}\"\n", integrators[std::size_t(draw.of("model"))]);
}

std::string particle_text(const Draw& draw, const Means& means) {
  const int species = int(draw.of("species")), each = std::max(1, int(draw.of("particles")) / species);
  const bool wet = draw.of("model") > 3;
  double solids = 0;
  std::string numbers;
  for (int j = 0; j < species; ++j) {
    solids += each * std::numbers::pi / 6 * std::pow(draw.of(numbered("diameter", j)), 3);
    numbers += fmt::format("{}{}", j > 0 ? ", " : "", each);
  }
  // A box of square ground, three times as high as wide, that the bed fills to two thirds at its start at most.
  const double start = std::clamp(draw.of("start fraction"), 0.05, 0.4);
  const double width = std::max(6 * means.largest, std::cbrt(solids / (2 * start)));
  const int cells = 3;
  std::string text = fmt::format(
      "[column]\nsize = [{0:.17g}, {0:.17g}, {1:.17g}]\ncells = [{2}, {2}, {3}]\nsides = \"{4}\"\nclosed = {5}\n",
      width, 3 * width, cells, 3 * cells, draw.of("columns") > 1 ? "wall" : "periodic",
      wet && draw.of("closed") > 0 ? "true" : "false");
  text += wet ? fmt::format("[fluid]\nname = \"fluid\"\ndensity = {:.17g}\nviscosity = {:.17g}\n",
                            draw.of("fluid density"), draw.of("viscosity"))
              : "[fluid]\nname = \"none\"\n";
  text += species_text(draw) + fmt::format(
                                   "[bed]\nparticles = [{}]\nsolids_fraction = 0.6\nstart = \"mixed\"\n"
                                   "start_solids_fraction = {:.17g}\n",
                                   numbers, start);
  if (wet && draw.of("closed") <= 0) text += inlet_text(draw, velocity_of(draw, means));
  text += "[effects]\ncontact = \"hertz_mindlin\"\n";
  if (wet) text += fmt::format("drag = \"{}\"\n", drag_laws[std::size_t(draw.of("drag law"))]);
  if (wet && draw.of("species exchange") > 0) text += "added_mass = \"half\"\n";
  return text + times_text(draw) + fmt::format("[dem]\nyoungs_modulus = {:.17g}\n", draw.of("youngs modulus"));
}

}  // namespace

double Draw::of(const std::string& name) const {
  for (const Parameter& p : parameters)
    if (p.name == name) return p.value;
  throw std::out_of_range("no parameter " + name);
}

int Draw::size() const {
  return int(
      std::count_if(parameters.begin(), parameters.end(), [](const Parameter& p) { return p.value != p.standard; }));
}

Draw draw_of(std::uint64_t seed, std::uint64_t n) {
  Dice dice(seed, n);
  Draw draw;
  const auto add = [&](const std::string& name, double value, double standard, bool whole = false) {
    draw.parameters.push_back({name, value, standard, whole});
  };
  // 0 to 2: the continuum by each integrator; 3: particles alone; 4: particles in the fluid.
  const int model = dice.whole(10);
  add("model", model < 8 ? model % 4 % 3 : model - 5, 0, true);
  add("species", 1 + dice.whole(most_species), 1, true);
  for (int j = 0; j < most_species; ++j) {
    add(numbered("diameter", j), dice.logarithmic(1e-6, 0.1), 1e-3);
    add(numbered("density", j), dice.logarithmic(1, 2e4), 2500);
    add(numbered("share", j), dice.logarithmic(1e-3, 1), 1);
  }
  add("fluid density", dice.logarithmic(1, 2e4), 1000);
  add("viscosity", dice.logarithmic(1e-6, 1e3), 1e-3);
  add("velocity over u_mf", dice.even() < 0.1 ? 0 : dice.logarithmic(1e-2, 100), 1);
  add("start fraction", dice.logarithmic(0.01, 0.6), 0.5);
  add("cell over diameter", dice.logarithmic(1, 30), 5);
  add("columns", dice.even() < 0.7 ? 1 : 4, 1, true);
  add("closed", dice.even() < 0.2 ? 1 : 0, 0, true);
  add("drag law", dice.whole(int(drag_laws.size())), 0, true);
  add("species exchange", dice.even() < 0.5 ? 1 : 0, 0, true);
  add("particles", std::round(dice.logarithmic(1, 200)), 20, true);
  add("youngs modulus", dice.logarithmic(1e5, 1e9), 5e6);
  // Whole milliseconds, as people write them, and parts of the end: their multiples meet, or miss each other by an ulp.
  const auto milliseconds = [&](double most) { return std::round(dice.logarithmic(1, most * 1e3)) / 1e3; };
  const double end = milliseconds(4);
  add("end", end, 2);
  for (const char* period : periods) {
    const int way = dice.whole(3);
    const double part = end / std::round(dice.logarithmic(1, 30)), whole = milliseconds(end);
    add(period, way == 0 ? 0 : way == 1 ? part : whole, 0);
  }
  add("breakpoints", dice.even() < 0.5 ? 0 : 1 + dice.whole(most_breakpoints), 0, true);
  for (int n = 0; n < most_breakpoints; ++n) {
    add(numbered("breakpoint", n), milliseconds(end), 1e-3 * (n + 1));
    add(numbered("velocity factor", n), dice.even() < 0.2 ? 0 : dice.logarithmic(0.1, 2), 1);
  }
  return draw;
}

std::string case_text(const Draw& draw) {
  const Means means = means_of(draw);
  return draw.is_particles() ? particle_text(draw, means) : continuum_text(draw, means);
}

}  // namespace polybed::hard
