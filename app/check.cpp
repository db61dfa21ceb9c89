// polybed check: predictions and requirements of a case, on one screen, without a run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/drag_notes.hpp"
#include "app/run_directory.hpp"
#include "closures/mixture.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "core/progress.hpp"
#include "core/timers.hpp"
#include "fluid/inlet.hpp"
#include "multiscale/card/card.hpp"
#include "multiscale/card/velocity_text.hpp"
#include "multiscale/effects/left_out.hpp"
#include "multiscale/estimate/estimate.hpp"
#include "multiscale/particle_requirements.hpp"
#include "multiscale/program.hpp"
#include "multiscale/requirements.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/run_record.hpp"
#include "multiscale/scene_rules.hpp"
#include "multiscale/scene_warnings.hpp"
#include "tfm/model.hpp"
#include "tfm/step_estimate.hpp"

namespace polybed::app {

namespace {

constexpr double mega = 1e-6;

/// Numbers derived from a case.
struct Derived {
  relevance::FluidConstants fluid;
  double weight = 0;  ///< buoyant weight of the solids per area, Pa
  double max_packing = 0;
  double sound = 0;  ///< speed in a compressible fluid, m/s
  std::vector<double> terminal, reynolds;
  std::vector<std::string> notes;
};

/// Notes effects in the case that the two-fluid model has no law for, with the consequence of each.
void note_roles_of_particles(const core::Scene& scene, Derived& derived) {
  std::map<std::string, std::vector<std::string>> roles;
  for (const core::Role& role : all_roles())
    if (scene.effects.contains(role.name) && role.models.find("tfm") == std::string::npos)
      roles[role.absent].push_back(role.name);
  for (const auto& [absent, names] : roles)
    derived.notes.push_back(fmt::format("{} in polybed dem alone: {}", fmt::join(names, ", "), absent));
}

/// Inflow: its greatest speed, m/s, and the consequence for particles that fall more slowly.
struct Inflow {
  std::string name;
  double velocity = 0;
  std::string fate;
};

std::vector<Inflow> inflows_of(const core::Scene& scene) {
  const auto greatest = [](const auto& points) { return fluid::Ramp(points).greatest(); };
  std::vector<Inflow> inflows{
      {"the inlet", least_velocity(scene.column, greatest(scene.inlet.superficial_velocity)),
       std::string("it will be carried to the top") + (scene.column.outlet == core::Outlet::open ? ", and out" : "")}};
  for (std::size_t n = 0; n < scene.jets.size(); ++n)
    inflows.push_back({fmt::format("jet {}", n + 1), greatest(scene.jets[n].superficial_velocity),
                       "it will be carried along as far as the jet keeps together"});
  return inflows;
}

Derived derive(const core::Scene& scene, const tfm::Model& model) {
  const tfm::Constants& constants = model.constants();
  Derived derived;
  derived.notes = scene_warnings(scene);
  for (std::string& line : grid_warnings(scene)) derived.notes.push_back(std::move(line));
  derived.fluid = constants.fluid;
  if (scene.fluid.compressible())
    derived.sound = fluid::speed_of_sound(fluid::equation_of_state(scene.fluid, constants.fluid.density),
                                          scene.fluid.outlet_pressure);
  if (model.effects().solids_stress) derived.max_packing = model.effects().solids_stress->max_packing();
  const std::vector<Inflow> inflows = inflows_of(scene);
  double fastest = 0;
  for (const Inflow& inflow : inflows) fastest = std::max(fastest, inflow.velocity);
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double excess = constants.density[j] - constants.fluid.density;
    derived.weight +=
        scene.bed.volume_share[j] * scene.bed.static_height * scene.bed.solids_fraction * excess * constants.gravity;
    derived.terminal.push_back(tfm::terminal_velocity(constants, j));
    derived.reynolds.push_back(constants.fluid.density * fastest * constants.diameter[j] / constants.fluid.viscosity);
    for (const Inflow& inflow : inflows)
      if (scene.bed.volume_share[j] > 0 && inflow.velocity > derived.terminal[j])
        derived.notes.push_back(fmt::format("{}'s {:.4g} m/s is above the terminal velocity of {}, {:.3g} m/s: {}",
                                            inflow.name, inflow.velocity, constants.name[j], derived.terminal[j],
                                            inflow.fate));
  }
  for (std::string& note : notes_on_drag(scene, derived.fluid)) derived.notes.push_back(std::move(note));
  note_roles_of_particles(scene, derived);
  return derived;
}

/// \param weight  of the bed in the fluid, Pa
std::string weight_text(const core::Scene& scene, const BedOfCase& bed, double weight) {
  std::string is = weight < 0 ? "upwards in the fluid" : "in the fluid: the pressure drop of the fluidised bed";
  if (bed.joined)
    is = bed.joined->by_weight ? "in the fluid, carried by the mean gradient of the pressure"
                               : "in the fluid; column.pressure_gradient gives what acts against it";
  if (scene.column.is_tapered()) is = "in the fluid, settled; less once it expands into a wider part";
  if (bed.lift && scene.column.is_tapered())
    is = fmt::format("in the fluid, settled; pressure drop between that and {:.4g} Pa, if expanded evenly", *bed.lift);
  else if (bed.lift)
    is = fmt::format("in the fluid over the bottom; pressure drop between the walls {:.4g} Pa", *bed.lift);
  return fmt::format("{} Pa {}", plain(std::abs(weight), 4), is);
}

core::Json json_of(const BedState& bed) {
  core::Json json = {{"solids_fraction", bed.solids_fraction}};
  for (const tfm::TimeScale& scale : bed.scales)
    if (std::isfinite(scale.seconds)) json[scale.process + "_s"] = scale.seconds;
  json["expected_step_s"] = bed.step;
  return json;
}

void write_requirements(core::Json& json, const core::Scene& scene, const Requirements& need) {
  json.update({{"integrator", core::name_of(need.integrator)},
               {"momentum", core::name_of(need.momentum)},
               {"unknowns", need.unknowns},
               {"cells", need.cells},
               {"memory_MB", mega * need.memory.total()}});
  json["memory"] = {{"state_MB", mega * need.memory.state},
                    {"fields_MB", mega * need.memory.fields},
                    {"solver_MB", mega * need.memory.solver},
                    {"program_MB", mega * need.memory.program}};
  json["dt_limits"] = {
      {"at_rest", json_of(need.rest)}, {"lifted", json_of(need.lifted)}, {"expanded", json_of(need.expanded)}};
  json["dt_limits"]["expanded"]["bed_height_m"] = core::or_null(measured_height(scene, need.expanded.solids_fraction));
  json["time"] = need.time ? seconds_of(tfm_time(scene, need, known_machine())) : core::Json();
  if (need.time) json["time"].update({{"steps", need.time->steps}, {"s_per_step", need.time->seconds_per_step}});
}

void print_state(const char* name, const BedState& bed) {
  std::string text;
  for (const tfm::TimeScale& scale : bed.scales)
    if (std::isfinite(scale.seconds)) text += fmt::format("{} {:.2g} s, ", scale.process, scale.seconds);
  core::print("  {:8} (solids fraction {:.2f}): {}expected step {:.2g} s\n", name, bed.solids_fraction, text, bed.step);
}

void print_requirements(const core::Scene& scene, const Requirements& need) {
  core::print("{} cells, {} unknowns; integrator {} ({})\n", need.cells, need.unknowns, core::name_of(need.integrator),
              need.reason);
  core::print("convection of momentum {}\n", core::name_of(need.momentum));
  core::print("memory about {:.0f} MB: state {:.1f}, fields {:.1f}, solvers {:.1f}, program {:.0f}\n",
              mega * need.memory.total(), mega * need.memory.state, mega * need.memory.fields,
              mega * need.memory.solver, mega * need.memory.program);
  core::print("time scales of the bed, from the case alone:\n");
  print_state(scene.flows_around() ? "even" : "at rest", need.rest);
  if (need.expanded.solids_fraction != need.rest.solids_fraction) {
    print_state("lifted", need.lifted);
    print_state("expanded", need.expanded);
  }
  if (!need.time) {
    core::print("time: not known, the numbers failed in the sample that is measured\n");
    return;
  }
  core::print("{:.4g} s takes {}: {:.2g} steps of {:.2g} s\n", scene.run.until,
              computing_text(tfm_time(scene, need, known_machine())), need.time->steps, need.time->seconds_per_step);
}

/// The classes of the distributions, with y_j = D_j over the distribution's Sauter diameter.
void print_size_classes(const core::Scene& scene) {
  for (const core::SizeClasses& record : scene.size_classes) {
    const double sauter = closures::sauter_diameter(record.share, record.diameter);
    core::print("{}: {} as {} classes, Sauter diameter {:.5g} m, y_m {:.5g}\n", record.species,
                core::name_of(record.given.kind.value()), record.diameter.size(), sauter,
                closures::poly_index_mean(record.share, record.diameter));
    for (std::size_t k = 0; k < record.diameter.size(); ++k)
      core::print("  {}.{}: diameter {:.6g} m, share {:.6g}, y {:.4g}\n", record.species, k + 1, record.diameter[k],
                  record.share[k], record.diameter[k] / sauter);
  }
}

constexpr std::size_t screen = 25;  // lines

void add_continuum(const core::Scene& scene, const Requirements& need, std::vector<std::string>& lines) {
  const std::string time = need.time ? computing_text(tfm_time(scene, need, known_machine()))
                                     : "time not known: the numbers failed in a sample";
  if (const std::string shape = shape_text(scene); !shape.empty()) lines.push_back(card_line("column", shape));
  lines.push_back(card_line("polybed tfm", fmt::format("{:.4g} s on {} cells: {}; {:.0f} MB of memory", scene.run.until,
                                                       need.cells, time, mega * need.memory.total())));
}

void add_particles(const core::Scene& scene, const ParticleRequirements& need, std::vector<std::string>& lines) {
  lines.push_back(
      card_line("polybed dem", fmt::format("{:.4g} s of {} particle{}: {}; {:.0f} MB of memory", scene.run.until,
                                           need.count(), need.count() == 1 ? "" : "s",
                                           computing_text(dem_time(scene, known_machine())), mega * need.memory())));
  lines.push_back(card_line("", fmt::format("step {:.2g} s, limited by {}", need.limits.dt, need.limits.limited_by)));
}

/// Another command on the same case, as it can be typed.
std::string command_on(const RunOptions& options, const char* name) {
  std::string command = fmt::format("{} {} {}", typed_program(), name, core::shell_word(options.case_path.string()));
  for (const std::string& setting : options.overrides) command += " --set " + core::shell_word(setting);
  return command;
}

/// Prints title, card, notes; counts those that do not fit on the screen.
void print_screen(const core::Scene& scene, const RunOptions& options, std::vector<std::string> lines,
                  const std::vector<std::string>& notes) {
  const std::string title = scene.title.empty() ? "a case without a title" : scene.title;
  core::put(stdout, core::Colour::bold, title + "\n");
  for (const std::string& line : lines) core::print("{}\n", line);
  const std::size_t room = screen - 3 - std::min(lines.size(), screen - 3);  // next to title, empty line and last line
  const std::size_t shown = notes.size() <= room ? notes.size() : room - std::min<std::size_t>(room, 1);
  if (!notes.empty()) core::print("\n");
  for (std::size_t n = 0; n < shown; ++n) {
    core::put(stdout, core::Colour::yellow, "note:");
    core::print(" {}\n", notes[n]);
  }
  if (shown < notes.size()) core::print("and {} more notes: --details\n", notes.size() - shown);
  core::print("more: --details (numerics, memory), --resolved (all keys); {}; {}\n", command_on(options, "effects"),
              command_on(options, "estimate"));
}

void print_json(core::Json json, const core::Scene& scene, const std::vector<std::string>& lines,
                const std::vector<std::string>& notes) {
  write_expected(json, scene, bed_of_case(scene));
  write_size_classes(json, scene);
  json.update({{"hash", core::case_hash(scene)}, {"lines", lines}, {"notes", notes}});
  core::print("{}\n", core::json_text(json));
}

/// Adds the effects that each model of the case neglects.
void add_left_out(const core::Scene& scene, const std::string& model, std::vector<std::string>& lines) {
  lines.push_back(card_line("left out", model + ": " + left_out_text(left_out(scene, model))));
}

/// Notes effects that make a run of particles much longer.
void note_costs(const core::Scene& scene, std::vector<std::string>& notes) {
  for (const auto& [role, law] : scene.effects)
    if (const double times = steps_by(scene, role); times > many_more_steps)
      notes.push_back(fmt::format("{} = \"{}\" makes polybed dem take {:.2g} times as long: its steps are shorter",
                                  role, law, times));
}

/// Notes the chosen effects, and effects that are off but needed, for each model of the case.
void note_choice(const core::Scene& scene, const std::vector<std::string>& models, std::vector<std::string>& notes) {
  for (std::string line : {chosen_line(scene), unsuited_line(scene)})
    if (!line.empty()) notes.push_back(std::move(line));
  for (const std::string& model : models)
    if (const std::string line = called_for_line(left_out(scene, model)); !line.empty())
      notes.push_back(model + ": " + line);
}

/// Checks a case that only the particle model runs: its requirements there, and the reasons against the continuum.
void check_particle_scene(const core::Scene& scene, const std::vector<std::string>& reasons,
                          const RunOptions& options) {
  const ParticleRequirements need = placed_requirements_of(scene);
  std::vector<std::string> notes = need.warnings();
  notes.insert(notes.end(), reasons.begin(), reasons.end());
  for (const std::string& warning : scene_warnings(scene)) notes.push_back(warning);
  note_choice(scene, {"dem"}, notes);
  note_costs(scene, notes);
  if (options.details && !options.json) {
    print_size_classes(scene);
    print_particle_requirements(scene, need);
    for (const std::string& note : notes) core::print("{}\n", note);
    return;
  }
  std::vector<std::string> lines = expectation_lines(scene, bed_of_case(scene));
  add_particles(scene, need, lines);
  add_left_out(scene, "dem", lines);
  if (options.json) {
    core::Json json = {{"case", core::resolved_case(scene)}};
    write_particle_requirements(json, scene, need);
    json["refused"] = refusals_of(scene);
    return print_json(std::move(json), scene, lines, notes);
  }
  print_screen(scene, options, lines, notes);
}

/// Requirements as particles of a case that both models run, if it defines contacts. Reasons against that are added to
/// the notes.
std::optional<ParticleRequirements> as_particles(const core::Scene& scene, std::vector<std::string>& notes) {
  if (!scene.effects.contains("contact")) return {};
  std::vector<std::string> reasons = core::texts_of(rules_of_dem().problems(scene));
  try {
    if (reasons.empty()) return placed_requirements_of(scene);
  } catch (const core::CaseError& error) {
    reasons.push_back(fmt::format("polybed dem cannot run it: {}", error.what()));
  }
  notes.insert(notes.end(), reasons.begin(), reasons.end());
  return {};
}

/// The models that suit the case, among those that can run it: the continuum, and particles if possible.
std::vector<std::string> advised_models(const core::Scene& scene, bool particles) {
  return particles ? models_of(scene) : std::vector<std::string>{"tfm"};
}

/// Prints all derived numbers and the cost.
void print_details(const core::Scene& scene, const Derived& derived, const Requirements& need,
                   const std::optional<ParticleRequirements>& particles) {
  print_size_classes(scene);
  core::print("fluid: density {:.6g} kg/m3, viscosity {:.6g} Pa s\n", derived.fluid.density, derived.fluid.viscosity);
  if (derived.sound > 0) core::print("sound in the fluid {:.5g} m/s\n", derived.sound);
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    core::print("{}: terminal velocity {:.4g} m/s, Re of the inlet {:.4g}\n", scene.species[j].name,
                derived.terminal[j], derived.reynolds[j]);
  core::print("buoyant weight of the bed {:.5g} Pa per area\n", derived.weight);
  if (derived.max_packing > 0) core::print("maximum packing {:.4f}\n", derived.max_packing);
  print_requirements(scene, need);
  if (particles) {
    core::print("as particles, polybed dem:\n");
    print_particle_requirements(scene, *particles);
  }
  for (const std::string& note : derived.notes) core::print("{}\n", note);
}

void run_check(const RunOptions& options) {
  const core::Scene scene = read_scene(options, either_model());
  if (const auto reasons = rules_of_tfm().problems(scene); !reasons.empty())
    return check_particle_scene(scene, core::texts_of(reasons), options);
  std::vector<std::string> hindrances;
  const auto particles = as_particles(scene, hindrances);  // measured while the memory is the program's
  core::Timers timers;
  std::unique_ptr<tfm::Model> part;
  const Requirements need = requirements_of(scene, timers, part);
  refuse_beyond_memory(scene, need.memory.total(), core::available_memory());
  Derived derived = derive(scene, *part);
  if (particles)
    for (const std::string& warning : particles->warnings()) derived.notes.push_back(warning);
  derived.notes.insert(derived.notes.end(), hindrances.begin(), hindrances.end());
  const std::vector<std::string> models = advised_models(scene, particles.has_value());
  note_choice(scene, models, derived.notes);
  if (particles) note_costs(scene, derived.notes);
  if (options.details && !options.json) return print_details(scene, derived, need, particles);
  const BedOfCase bed = bed_of_case(scene);
  std::vector<std::string> lines = expectation_lines(scene, bed);
  if (const double w = derived.weight; w != 0) lines.push_back(card_line("weight", weight_text(scene, bed, w)));
  add_continuum(scene, need, lines);
  if (particles) add_particles(scene, *particles, lines);
  for (const std::string& model : models) add_left_out(scene, model, lines);
  if (options.json) {
    core::Json json = {{"case", core::resolved_case(scene)},
                       {"fluid_density_kg_m3", derived.fluid.density},
                       {"fluid_viscosity_Pa_s", derived.fluid.viscosity}};
    if (derived.sound > 0) json["speed_of_sound_m_s"] = derived.sound;
    json.update({{"buoyant_weight_Pa", derived.weight}, {"static_height_m", scene.bed.static_height}});
    write_requirements(json, scene, need);
    if (particles) write_particle_requirements(json["dem"], scene, *particles);
    json["refused"] = refusals_of(scene);
    if (json["refused"]["dem"].empty()) json["refused"]["dem"] = hindrances;  // found only by placing the particles
    return print_json(std::move(json), scene, lines, derived.notes);
  }
  print_screen(scene, options, lines, derived.notes);
}

}  // namespace

void add_check(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<RunOptions>();
  const auto resolved = std::make_shared<bool>(false);
  CLI::App& command = *app.add_subcommand("check", "what to expect of a case and what it will need; nothing is run");
  take_case(command, *options);
  command.add_option("--until", options->until, "simulated time, e.g. \"20 s\"");
  command.add_flag("--details", options->details, "the numerics, memory and all notes instead of one screen");
  command.add_flag("--resolved", *resolved, "print the case with all defaults instead");
  commands.push_back({&command,
                      doing([options, resolved] { *resolved ? print_resolved(*options) : run_check(*options); }),
                      [resolved] { return *resolved ? On::one_process : On::first_rank; }});
}

}  // namespace polybed::app
