#include "multiscale/particle_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "core/case/particle_list.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/numerics/blocks.hpp"
#include "core/print.hpp"
#include "core/progress.hpp"
#include "dem/feeding.hpp"
#include "dem/packing.hpp"
#include "dem/rules.hpp"
#include "dem/scene.hpp"
#include "dem/settling.hpp"
#include "fluid/viscous_stress.hpp"
#include "multiscale/card/card.hpp"
#include "multiscale/requirements.hpp"
#include "relevance/effects/contact.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

/// Increase of a run's peak memory per particle of a dense bed, with its ledger of energy (docs/record/cost.md), and
/// memory for output of any size; bytes.
constexpr double bytes_per_particle = 1000, bytes_of_output = 12e6;

/// Increase of a run's peak memory per cell of the fluid.
constexpr double bytes_per_cell = 1100;

/// A sphere as fast as the fastest of n in random motion with speed s per component: the mean of the greatest of n
/// magnitudes is s sqrt(2 ln n) and a little more, which hardly changes the step.
double fastest_of(double speed, std::int64_t n) {
  return speed * std::sqrt(3 + 2 * std::log(double(std::max<std::int64_t>(n, 1))));
}

std::int64_t sum_of(const std::vector<std::int64_t>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), std::int64_t(0));
}

/// Data of the start that affect time and memory.
struct Start {
  std::vector<std::int64_t> numbers;  ///< of each species
  /// Represent all particles where only the fastest and the highest matter: one or two per species.
  std::vector<dem::Particle> foremost;
};

dem::Particle particle(const dem::Materials& materials, std::size_t species, const dem::Vector& x,
                       const dem::Vector& v) {
  dem::Particle particle{};
  particle.species = std::int32_t(species);
  particle.place = {x, materials.species()[species].radius};
  particle.motion.v = v;
  return particle;
}

/// Avoids start_particles(), as a run calls this while its own particles fill the memory.
Start listed_start(const core::Scene& scene, const dem::Materials& materials) {
  const core::ParticleList list = core::read_particle_list(scene);
  const auto speed = [&](std::size_t n) {
    const dem::Vector& v = list.velocity[n];
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  };
  Start start{std::vector<std::int64_t>(materials.species().size(), 0), {}};
  std::vector<std::size_t> fastest(start.numbers.size()), highest(start.numbers.size());
  for (std::size_t n = 0; n < list.species.size(); ++n) {
    const auto j = std::size_t(list.species[n]);
    if (start.numbers[j]++ == 0) fastest[j] = highest[j] = n;
    if (speed(n) > speed(fastest[j])) fastest[j] = n;
    if (list.position[n][1] > list.position[highest[j]][1]) highest[j] = n;
  }
  for (std::size_t j = 0; j < start.numbers.size(); ++j)
    for (const std::size_t n : {fastest[j], highest[j]})
      if (start.numbers[j] > 0) start.foremost.push_back(particle(materials, j, list.position[n], list.velocity[n]));
  return start;
}

Start start_of(const core::Scene& scene, const dem::Materials& materials) {
  if (scene.bed.start.kind == core::StartKind::list) return listed_start(scene, materials);
  Start start{dem::particle_numbers(scene, materials), {}};
  const std::int64_t count = sum_of(start.numbers);
  for (std::size_t j = 0; j < start.numbers.size(); ++j)
    start.foremost.push_back(particle(materials, j, {}, {fastest_of(scene.dem.start_speed, count), 0, 0}));
  return start;
}

/// Whether the scene's particles move in a solved fluid.
bool couples(const core::Scene& scene) { return scene.fluid.present() && scene.column.shear_rate == 0; }

/// The step of a run and its limits, without the rest of its requirements.
dem::StepLimits limits_of(const core::Scene& scene) {
  const dem::Materials materials(scene);
  const dem::PairLaws laws = dem::make_pair_laws(scene, materials);
  core::refuse(dem::start_rules(), scene);
  const std::vector<dem::Particle> foremost = start_of(scene, materials).foremost;
  return dem::step_limits(scene, materials, laws,
                          dem::expected_speeds(scene, materials, dem::box_of(scene), foremost).greatest);
}

/// Courant number of the fluid over a time: from the inflow, between packed particles, and from the viscous stress.
double courant_of(const core::Scene& scene, double dt) {
  double inflow = 0;
  const auto see = [&](const std::vector<std::pair<double, double>>& velocity) {
    for (const auto& [t, u] : velocity) inflow = std::max(inflow, std::abs(u));
  };
  see(scene.inlet.superficial_velocity);
  inflow *= scene.column.contraction();
  for (const core::Jet& jet : scene.jets) see(jet.superficial_velocity);
  const core::Grid grid = core::grid_of(scene, nullptr);
  const double convected = inflow / (1 - scene.bed.solids_fraction) * dt / grid.smallest_spacing();
  if (!core::acts(scene, "fluid_stress")) return convected;
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  return std::max(convected, 2 * fluid.viscosity / fluid.density * dt * fluid::viscous_rate(grid));
}

constexpr double mega = 1e-6;

std::optional<FluidNeed> fluid_need(const core::Scene& scene, const dem::Materials& materials, std::int64_t particles,
                                    double dt, double steps) {
  if (!couples(scene)) return {};
  const core::Grid grid = core::grid_of(scene.column, nullptr);  // walls inside change neither the cells nor their size
  FluidNeed need;
  need.every = scene.dem.fluid_every.value_or(core::most_fluid_every);
  need.step = need.every * dt;
  need.steps = std::floor(steps / need.every);
  need.cells = grid.cell_count();
  need.kernel = dem::kernel_of(scene, grid.smallest_spacing(), materials.greatest_diameter(), particles);
  // Each cell and its faces have their weights for the particles between walls.
  constexpr double bytes_of_weights = 4 * 48;
  need.memory = bytes_per_cell * double(need.cells);
  if (const double walls = bytes_of_walls(scene); walls > 0)
    need.memory += walls + bytes_of_weights * double(need.cells);
  need.warning = fluid_every_warning(scene, dt);
  need.smearing = dem::smearing_warning(scene, need.kernel.width);
  return need;
}

std::vector<std::int64_t> fed_in(const core::Scene& scene, const dem::Materials& materials, const dem::Box& box) {
  if (!dem::is_fed(scene)) return {};
  return dem::Feeding(scene, materials, box, dem::skin_of(scene, materials), 0).called_for(scene.run.until);
}

/// CPU time, s: for the particles, and for the fluid's steps. \param count  of particles, on average
double expected_time(const ParticleRequirements& need, const ParticleSpeed& speed, double steps, double count) {
  const double particles =
      steps * (count * (need.fluid ? speed.particle_step_in_fluid : speed.particle_step) + speed.step);
  if (!need.fluid) return particles;
  return particles + steps / need.fluid->every *
                         fluid_step_seconds(speed, count, double(need.fluid->cells), need.fluid->kernel.width > 0);
}

void require_memory_for(const core::Scene& scene, const ParticleRequirements& need) {
  const bool cells = need.fluid && need.fluid->memory > need.particles;
  refuse_beyond_memory(scene, need.memory(), core::available_memory(),
                       cells ? 0 : std::max<std::int64_t>(need.count(), 1));
}

void print_fluid(const FluidNeed& fluid) {
  core::print("fluid step {:.3g} s, one in {} of the particles': {:.3g} steps on {} cells\n", fluid.step, fluid.every,
              fluid.steps, fluid.cells);
  if (fluid.kernel.width > 0)
    core::print("kernel diffusion, {:.3g} mm wide: {}\n", 1e3 * fluid.kernel.width, fluid.kernel.reason);
  else
    core::print("kernel bilinear: {}\n", fluid.kernel.reason);
}

}  // namespace

std::int64_t ParticleRequirements::count() const { return sum_of(numbers); }

std::vector<std::string> ParticleRequirements::warnings() const {
  std::vector<std::string> lines;
  for (const std::string& line : {limits.warning, overlap.warning, fluid ? fluid->warning : std::string(),
                                  fluid ? fluid->smearing : std::string()})
    if (!line.empty()) lines.push_back(line);
  return lines;
}

ParticleRequirements particle_requirements_of(const core::Scene& scene, const ParticleSpeed& speed) {
  const dem::Box box = dem::box_of(scene);
  const dem::Materials materials(scene);
  const dem::PairLaws laws = dem::make_pair_laws(scene, materials);
  core::refuse(dem::start_rules(), scene);
  ParticleRequirements need;
  Start start = start_of(scene, materials);
  need.numbers = std::move(start.numbers);
  const dem::Speeds speeds = dem::expected_speeds(scene, materials, box, start.foremost);
  need.limits = dem::step_limits(scene, materials, laws, speeds.greatest);
  need.overlap = dem::overlap_forecast(scene, materials, laws, speeds.impact);
  need.program = core::process_memory().now + bytes_of_output;
  need.fed = fed_in(scene, materials, box);
  // What runs out of a hole in the bottom meanwhile is not known: as much as is fed. One in a side can lie above the
  // bed.
  const bool leave = std::any_of(box.openings.begin(), box.openings.end(), [](const auto& o) { return o.is_bottom(); });
  const double start_count = double(need.count()), more = leave ? 0 : double(sum_of(need.fed));
  need.particles = bytes_per_particle * (start_count + more);
  need.steps = std::ceil(scene.run.until / need.limits.dt);
  need.particle_steps = need.steps * (start_count + 0.5 * more);
  need.fluid = fluid_need(scene, materials, need.count(), need.limits.dt, need.steps);
  if (scene.bed.start.kind == core::StartKind::settled) need.settling = dem::settling_time(scene, materials, box);
  need.before = expected_time(need, speed, need.settling / need.limits.dt, start_count);
  need.expected = need.before + expected_time(need, speed, need.steps, start_count + 0.5 * more);
  return need;
}

ParticleRequirements placed_requirements_of(const core::Scene& scene) {
  constexpr std::int64_t quickly = 5000;  // a fraction of a second
  ParticleRequirements need = particle_requirements_of(scene, known_machine().particles);
  require_memory_for(scene, need);
  if (need.count() <= quickly) (void)dem::start_particles(scene, dem::Materials(scene), dem::box_of(scene));
  return need;
}

void require_particle_memory(const core::Scene& scene) { require_memory_for(scene, particle_requirements_of(scene)); }

double steps_by(const core::Scene& scene, const std::string& role) {
  if (role == relevance::effects::contact.role) return 1;
  core::Scene with = scene;
  with.walls.clear();  // they hardly change the ratio, and it takes a while to cut cells by them
  core::Scene without = with;
  without.effects.erase(role);
  try {
    return limits_of(without).dt / limits_of(with).dt;
  } catch (const core::CaseError&) {
    return 1;
  }
}

void choose_stiffness(core::Scene& scene) {
  const auto own = [](const auto& part) { return part.youngs_modulus.has_value(); };
  if (!relevance::effects::contact.has(scene, relevance::effects::elastic_spheres) || own(scene.dem) ||
      std::any_of(scene.species.begin(), scene.species.end(), own) ||
      std::any_of(scene.contact_pairs.begin(), scene.contact_pairs.end(), own))
    return;
  const dem::Materials materials(scene);
  try {
    const dem::PairLaws laws = dem::make_pair_laws(scene, materials);
    const dem::Speeds speeds =
        dem::known_speeds(scene, materials, dem::box_of(scene), start_of(scene, materials).foremost);
    const dem::OverlapForecast overlap = dem::overlap_forecast(scene, materials, laws, speeds.impact, dem::Met::single);
    scene.dem.youngs_modulus =
        std::min(dem::rounded_up(core::least_modulus * std::max(1.0, overlap.stiffening)), dem::stiffest(scene));
  } catch (const core::StartError&) {
    throw;
  } catch (const core::CaseError&) {
    // The particle model reports why it cannot build this scene when it runs.
  }
}

void choose_fluid_every(core::Scene& scene) {
  if (scene.dem.fluid_every || !couples(scene) || scene.effects.count(relevance::effects::contact.role) == 0) return;
  constexpr double sound = 0.5;  // Courant number
  try {
    const double each = courant_of(scene, limits_of(scene).dt);
    scene.dem.fluid_every = std::clamp(int(sound / std::max(each, 1e-9)), 1, core::most_fluid_every);
  } catch (const core::CaseError&) {
    // The particle model reports why it cannot build this scene when it runs.
  }
}

std::string fluid_every_warning(const core::Scene& scene, double dt) {
  if (!couples(scene)) return "";
  const int every = scene.dem.fluid_every.value_or(core::most_fluid_every);
  const double each = courant_of(scene, dt);
  if (!(every * each > 1)) return "";
  const int fitting = int(1 / each);
  return fmt::format(
      "dem.fluid_every = {}: the fluid is expected to move by {:.2g} cells in its step of {:.3g} s, and the run stops "
      "above 1; {}",
      every, every * each, every * dt,
      fitting > 0 ? fmt::format("use at most {}", fitting) : "use larger cells, or a smaller dem.fixed_step");
}

void write_step(core::Json& json, const dem::StepLimits& limits, double greatest_speed) {
  core::Json all = core::Json::array();
  for (const dem::StepLimit& limit : limits.all) all.push_back({{"name", limit.name}, {"dt_s", limit.dt}});
  json["step"] = {{"dt_s", limits.dt},
                  {"limited_by", limits.limited_by},
                  {"greatest_speed_expected_m_s", greatest_speed},
                  {"limits", all}};
}

void write_overlap(core::Json& json, const dem::OverlapForecast& overlap) {
  json["overlap"] = {{"pair", overlap.pair}, {"expected_m", overlap.overlap}, {"over_diameter", overlap.share}};
}

void write_particle_requirements(core::Json& json, const core::Scene& scene, const ParticleRequirements& need) {
  core::Json& particles = json["particles"] = core::Json::object();
  for (std::size_t j = 0; j < need.numbers.size(); ++j) particles[scene.species[j].name] = need.numbers[j];
  for (std::size_t j = 0; j < need.fed.size(); ++j) json["fed"][scene.species[j].name] = need.fed[j];
  json["memory_MB"] = mega * need.memory();
  core::Json& memory = json["memory"] = {{"particles_MB", mega * need.particles}};
  if (need.fluid) memory["fluid_MB"] = mega * need.fluid->memory;
  memory["program_MB"] = mega * need.program;
  if (const std::optional<FluidNeed>& fluid = need.fluid)
    json["fluid"] = {{"every", fluid->every},
                     {"dt_s", fluid->step},
                     {"steps", fluid->steps},
                     {"cells", fluid->cells},
                     {"kernel", fluid->kernel.width > 0 ? "diffusion" : "bilinear"},
                     {"kernel_width_m", fluid->kernel.width},
                     {"kernel_reason", fluid->kernel.reason}};
  json["integrator"] = need.limits.synchronised ? "synchronised" : "thesis";
  write_step(json, need.limits, need.limits.greatest_speed);
  write_overlap(json, need.overlap);
  json["time"] = seconds_of(dem_time(scene, known_machine()));
  json["time"].update({{"settling_s", need.settling},
                       {"before_s", need.before},
                       {"steps", need.steps},
                       {"particle_steps", need.particle_steps}});
}

void print_particle_requirements(const core::Scene& scene, const ParticleRequirements& need) {
  std::string each;
  for (std::size_t j = 0; j < need.numbers.size(); ++j)
    each += fmt::format("{}{} {}", j == 0 ? "" : ", ", need.numbers[j], scene.species[j].name);
  core::print("{} particles: {}\n", need.count(), each);
  if (!need.fed.empty()) core::print("{} more are fed\n", sum_of(need.fed));
  const std::string fluid = need.fluid ? fmt::format("fluid {:.1f}, ", mega * need.fluid->memory) : "";
  core::print("memory about {:.0f} MB: particles and contacts {:.1f}, {}program {:.0f}\n", mega * need.memory(),
              mega * need.particles, fluid, mega * need.program);
  core::print("time step {:.3g} s, limited by {}; greatest speed expected {:.3g} m/s; {} integrator ({})\n",
              need.limits.dt, need.limits.limited_by, need.limits.greatest_speed,
              need.limits.synchronised ? "synchronised" : "thesis", need.limits.integrator_reason);
  for (const dem::StepLimit& limit : need.limits.all) core::print("  {}: {:.3g} s\n", limit.name, limit.dt);
  core::print("contacts overlap by up to {:.2g} of the smaller diameter, those of {}; the run stops above {:g}\n",
              need.overlap.share, need.overlap.pair, scene.dem.max_overlap);
  if (need.fluid) print_fluid(*need.fluid);
  if (need.settling > 0)
    core::print("the bed settles first, for about {:.2g} s, which takes {} of the time below\n", need.settling,
                short_time(need.before));
  core::print("{:.4g} s takes {}: {:.3g} steps, {:.3g} particle-steps\n", scene.run.until,
              computing_text(dem_time(scene, known_machine())), need.steps, need.particle_steps);
}

}  // namespace polybed::multiscale
