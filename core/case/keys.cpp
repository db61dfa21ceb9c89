#include "core/case/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace polybed::core {

namespace {

/// Turns a lambda without captures into the place of a key.
template <class T>
AnyPlace at(Place<T> place) {
  return place;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// clang-format off
std::vector<Key> make_keys() {
  using S = Scene;
  using N = std::size_t;
  std::vector<Key> k;
  k.push_back({"", "title", at<std::string>([](S& s, N) -> auto& { return s.title; }), "what the case is, in one line"});

  k.push_back({"column", "size", at<std::vector<double>>([](S& s, N) -> auto& { return s.column.given_size; }), "width, height; three numbers make it 3-D: width, depth, height", dimension::length, 0, 1e3, true, {}, {}, true});
  k.push_back({"column", "cells", at<std::vector<std::int64_t>>([](S& s, N) -> auto& { return s.column.given_cells; }), "number of cells along each direction of size", {}, 1, 1e6, false, {}, {}, true});
  k.push_back({"column", "depth", at<std::optional<double>>([](S& s, N) -> auto& { return s.column.depth; }), "of a 2-D column; default: twice the largest diameter and twice dem.skin", dimension::length, 0, 1e3, true});
  k.push_back({"column", "sides", at<std::string>([](S& s, N) -> auto& { return s.column.sides; }), "walls: no slip for the fluid, free slip for solids unless said; or joined", {}, -infinity, infinity, false, "wall", {"wall", "periodic"}});
  k.push_back({"column", "ends", at<std::string>([](S& s, N) -> auto& { return s.column.ends; }), "bottom and top; joined for the DEM only, without a fluid", {}, -infinity, infinity, false, "wall", {"wall", "periodic"}});
  k.push_back({"column", "gravity", at<double>([](S& s, N) -> auto& { return s.column.gravity; }), "acceleration of gravity", dimension::acceleration, 0, 1e3, false, "9.81 m/s2"});
  k.push_back({"column", "gravity_direction", at<std::vector<double>>([](S& s, N) -> auto& { return s.column.gravity_direction; }), "of gravity, of any length, in the order of size: along width and height, or width, depth and height; default: down; for the TFM another one needs column.closed = true and walls", {}, -1e6, 1e6});
  k.push_back({"column", "outlet", at<std::string>([](S& s, N) -> auto& { return s.column.outlet; }), "top of the column: a screen that holds solids, or open to them: they leave and are counted", {}, -infinity, infinity, false, "screen", {"screen", "open"}});
  k.push_back({"column", "closed", at<bool>([](S& s, N) -> auto& { return s.column.closed; }), "walls all round: no inlet and no outlet", {}, -infinity, infinity, false, "false"});

  k.push_back({"fluid", "name", at<std::string>([](S& s, N) -> auto& { return s.fluid.name; }), "water and air know density and viscosity from the temperature; any other fluid needs both, and may go without a name; none: particles without a fluid, for the DEM only"});
  k.push_back({"fluid", "temperature", at<std::optional<double>>([](S& s, N) -> auto& { return s.fluid.temperature; }), "water 0 to 40 degC, air 200 to 1000 K", dimension::temperature, 0, 5000, true});
  k.push_back({"fluid", "density", at<std::optional<double>>([](S& s, N) -> auto& { return s.fluid.density; }), "rho_f", dimension::density, 0, 1e5, true});
  k.push_back({"fluid", "viscosity", at<std::optional<double>>([](S& s, N) -> auto& { return s.fluid.viscosity; }), "mu", dimension::viscosity, 0, 1e6, true});
  k.push_back({"fluid", "equation_of_state", at<std::string>([](S& s, N) -> auto& { return s.fluid.equation_of_state; }), "how density depends on pressure; a compressible fluid carries sound", {}, -infinity, infinity, false, "incompressible", {"incompressible", "tait", "ideal_gas"}, false, "tait: P + B = (P_out + B)(rho/rho_0)^n; ideal_gas: P = rho R T, T fixed"});
  k.push_back({"fluid", "outlet_pressure", at<double>([](S& s, N) -> auto& { return s.fluid.outlet_pressure; }), "P_out, absolute, at the top of the column; a density given is that at this pressure, and air's follows from it", dimension::pressure, 1, 1e9, false, "101325 Pa"});
  k.push_back({"fluid", "tait_stiffness", at<double>([](S& s, N) -> auto& { return s.fluid.tait_stiffness; }), "B of equation_of_state = tait", dimension::pressure, 1, 1e13, false, "3e8 Pa", {}, false, "c^2 = n (P + B)/rho"});
  k.push_back({"fluid", "tait_exponent", at<double>([](S& s, N) -> auto& { return s.fluid.tait_exponent; }), "n of equation_of_state = tait", {}, 1, 20, false, "7", {}, false, "c^2 = n (P + B)/rho"});

  k.push_back({"species", "name", at<std::string>([](S& s, N n) -> auto& { return s.species[n].name; }), "of the species; names columns and datasets", {}, -infinity, infinity, false, {}, {}, true});
  k.push_back({"species", "diameter", at<double>([](S& s, N n) -> auto& { return s.species[n].diameter; }), "D_j of its spheres; or give a distribution", dimension::length, 1e-8, 1});
  k.push_back({"species", "distribution", at<std::string>([](S& s, N n) -> auto& { return s.species[n].sizes.kind; }), "of sizes by volume, in place of one diameter: it becomes the species name.1, name.2, ... from fine to coarse, which have its moments", {}, -infinity, infinity, false, {}, {"lognormal", "sieves"}, false, "sum x_j D_j^k = integral X D^k dD, k = -N ... N-1", false, false, true});
  k.push_back({"species", "median", at<std::optional<double>>([](S& s, N n) -> auto& { return s.species[n].sizes.median; }), "lognormal: half of the volume is finer", dimension::length, 1e-8, 1, false, {}, {}, false, {}, false, false, true});
  k.push_back({"species", "mean", at<std::optional<double>>([](S& s, N n) -> auto& { return s.species[n].sizes.mean; }), "lognormal: mean diameter by volume, in place of the median", dimension::length, 1e-8, 1, false, {}, {}, false, "mean = median exp(deviation^2/2)", false, false, true});
  k.push_back({"species", "deviation", at<std::optional<double>>([](S& s, N n) -> auto& { return s.species[n].sizes.deviation; }), "lognormal: standard deviation of ln D", {}, 0, 1, true, {}, {}, false, {}, false, false, true});
  k.push_back({"species", "sieves", at<Points>([](S& s, N n) -> auto& { return s.species[n].sizes.sieves; }), "a table [[opening, share of the volume retained on it], ...]: openings rise, the last retains nothing, shares sum to 1", {}, 0, 1, false, {}, {}, false, {}, false, true, true});
  k.push_back({"species", "classes", at<int>([](S& s, N n) -> auto& { return s.species[n].sizes.classes; }), "N: number of species that stand for the distribution", {}, 1, 10, false, "3", {}, false, {}, false, false, true});
  k.push_back({"species", "density", at<double>([](S& s, N n) -> auto& { return s.species[n].density; }), "rho_j", dimension::density, 1e-3, 1e16, false, {}, {}, true});
  k.push_back({"species", "max_packing", at<double>([](S& s, N n) -> auto& { return s.species[n].max_packing; }), "P_j: random packing of this species alone, for tfm.max_packing = fedors_landel | yu_standish", {}, 0.3, 0.9, false, "0.64"});
  k.push_back({"species", "youngs_modulus", at<std::optional<double>>([](S& s, N n) -> auto& { return s.species[n].youngs_modulus; }), "else that of [dem]", dimension::pressure, 0, 1e13, true});
  k.push_back({"species", "poisson_ratio", at<std::optional<double>>([](S& s, N n) -> auto& { return s.species[n].poisson_ratio; }), "else that of [dem]", {}, 0, 0.5});
  k.push_back({"species", "friction", at<std::optional<double>>([](S& s, N n) -> auto& { return s.species[n].friction; }), "else that of [dem]", {}, 0, 10});
  k.push_back({"species", "restitution", at<std::optional<double>>([](S& s, N n) -> auto& { return s.species[n].restitution; }), "else that of [dem]", {}, 0, 1, true});

  k.push_back({"bed", "volume_share", at<std::vector<double>>([](S& s, N) -> auto& { return s.bed.volume_share; }), "x_j, share of each species in the volume of the solids; sums to 1", {}, 0, 1});
  k.push_back({"bed", "static_height", at<double>([](S& s, N) -> auto& { return s.bed.static_height; }), "of the settled bed; 0: the fluid alone", dimension::length, 0, 1e3});
  k.push_back({"bed", "solids_fraction", at<double>([](S& s, N) -> auto& { return s.bed.solids_fraction; }), "of the settled bed", {}, 0, 0.9, true});
  k.push_back({"bed", "start_solids_fraction", at<std::optional<double>>([](S& s, N) -> auto& { return s.bed.start_fraction; }), "of the bed at the start, with the mass of the settled bed; default: solids_fraction", {}, 0, 0.9, true});
  k.push_back({"bed", "particles", at<std::vector<std::int64_t>>([](S& s, N) -> auto& { return s.bed.particles; }), "numbers of particles of each species, instead of volume_share and static_height", {}, 0, 1e12});
  k.push_back({"bed", "start", at<std::string>([](S& s, N) -> auto& { return s.bed.start; }), "the bed at time zero; layered: in the order of the species, the first at the bottom; settled: in equilibrium; for the DEM only: random: anywhere in the column, list: particles one by one, SI, columns species, x, y, z and if not zero vx, vy, vz, wx, wy, wz, y upward", {}, -infinity, infinity, false, "mixed", {"mixed", "layered", "settled", "random", "checkpoint:FILE", "list:FILE"}});
  k.push_back({"bed", "seed", at<std::uint64_t>([](S& s, N) -> auto& { return s.bed.seed; }), "of random numbers", {}, 0, 9.2e18, false, "1"});

  k.push_back({"inlet", "superficial_velocity", at<Points>([](S& s, N) -> auto& { return s.inlet.superficial_velocity; }), "a velocity, or a table [[time, velocity], ...]: linear between, constant beyond; two equal times make a jump", dimension::velocity, -1e3, 1e3});

  k.push_back({"chooser", "tolerance", at<double>([](S& s, N) -> auto& { return s.chooser.tolerance; }), "what is left out sums to at most this share of the buoyant weight", {}, 1e-6, 1, false, "0.02"});
  k.push_back({"chooser", "purpose", at<std::string>([](S& s, N) -> auto& { return s.chooser.purpose; }), "steady leaves out forces of acceleration, whose means vanish", {}, -infinity, infinity, false, "steady", {"steady", "transient"}});
  k.push_back({"chooser", "roughness", at<std::optional<double>>([](S& s, N) -> auto& { return s.chooser.roughness; }), "radius of asperities of the surfaces; default: dem.roughness", dimension::length, 0, 1, true});
  k.push_back({"chooser", "hamaker", at<std::optional<double>>([](S& s, N) -> auto& { return s.chooser.hamaker; }), "A of the van der Waals force; default: dem.hamaker_constant, else 1e-20 J in a liquid, 1e-19 J in a gas", dimension::energy, 0, 1e-6, true});
  k.push_back({"chooser", "free_liquid", at<std::optional<double>>([](S& s, N) -> auto& { return s.chooser.free_liquid; }), "particles in a gas are wet: surface tension of the liquid between them", dimension::stiffness, 0, 10, true});
  k.push_back({"chooser", "static_heap", at<bool>([](S& s, N) -> auto& { return s.chooser.static_heap; }), "a heap at rest matters: rolling needs a spring", {}, -infinity, infinity, false, "false"});
  k.push_back({"chooser", "charge", at<std::optional<double>>([](S& s, N) -> auto& { return s.chooser.charge; }), "electric charge of a particle, C; without it nothing can be said of its force", {}, -1, 1});
  k.push_back({"chooser", "voidage", at<std::optional<double>>([](S& s, N) -> auto& { return s.chooser.voidage; }), "of the bulk, where it is known; default: by the balance of drag and weight at each velocity", {}, 0.2, 1, true});
  k.push_back({"chooser", "velocity_range", at<std::vector<double>>([](S& s, N) -> auto& { return s.chooser.velocity_range; }), "superficial velocities that the scene may meet, least and greatest: widens what the inlet says", dimension::velocity, -1e3, 1e3});
  k.push_back({"chooser", "temperature_range", at<std::vector<double>>([](S& s, N) -> auto& { return s.chooser.temperature_range; }), "likewise of the fluid", dimension::temperature, 0, 5000, true});
  k.push_back({"chooser", "zones", at<std::vector<std::string>>([](S& s, N) -> auto& { return s.chooser.zones; }), "where effects are weighed: packed, bulk, wall, freeboard; default: all", {}, -infinity, infinity, false, {}, {"packed", "bulk", "wall", "freeboard"}});
  k.push_back({"chooser", "monitor", at<std::string>([](S& s, N) -> auto& { return s.chooser.monitor; }), "what to do where forces that were left out exceed the tolerance during the run; auto: warn where a role is auto, else off", {}, -infinity, infinity, false, "auto", {"auto", "off", "warn", "stop"}});
  k.push_back({"chooser", "monitor_every", at<int>([](S& s, N) -> auto& { return s.chooser.monitor_every; }), "steps between samples", {}, 1, 1e9, false, "200"});
  k.push_back({"chooser", "monitor_sample", at<int>([](S& s, N) -> auto& { return s.chooser.monitor_sample; }), "one in so many particles or cells is looked at, chosen by its number", {}, 1, 1e9, false, "64"});
  k.push_back({"chooser", "chosen", at<std::vector<std::string>>([](S& s, N) -> auto& { return s.chooser.chosen; }), "a record: the roles that were auto before the case was resolved"});

  k.push_back({"run", "until", at<double>([](S& s, N) -> auto& { return s.run.until; }), "simulated time", dimension::time, 0, 1e9, true, {}, {}, true});

  k.push_back({"output", "every", at<std::optional<double>>([](S& s, N) -> auto& { return s.output.every; }), "between stored fields and profiles; default: a twentieth of the run", dimension::time, 0, 1e9, true});
  k.push_back({"output", "history_every", at<std::optional<double>>([](S& s, N) -> auto& { return s.output.history_every; }), "between rows of history.csv; default: a 400th of the run", dimension::time, 0, 1e9, true});
  k.push_back({"output", "checkpoint_every", at<std::optional<double>>([](S& s, N) -> auto& { return s.output.checkpoint_every; }), "between checkpoints; default: a tenth of the run", dimension::time, 0, 1e9, true});

  k.push_back({"tfm", "integrator", at<std::string>([](S& s, N) -> auto& { return s.tfm.integrator; }), "explicit for a bed fluidised by a liquid, implicit for gas, compressible fluids and settling; auto chooses so", {}, -infinity, infinity, false, "auto", {"auto", "explicit", "implicit"}});
  k.push_back({"tfm", "rtol", at<double>([](S& s, N) -> auto& { return s.tfm.rtol; }), "relative tolerance of the time integration", {}, 1e-12, 0.1, false, "1e-4"});
  k.push_back({"tfm", "flux", at<std::string>([](S& s, N) -> auto& { return s.tfm.flux; }), "solids fractions at faces: second order with a limiter, or first order", {}, -infinity, infinity, false, "limited", {"limited", "upwind"}});
  k.push_back({"tfm", "momentum", at<std::string>([](S& s, N) -> auto& { return s.tfm.momentum; }), "convection of velocities: first order, or second with a limiter; as (U.grad)U, or in the conservative form; auto: conservative, for particles conservative_limited", {}, -infinity, infinity, false, "auto", {"auto", "upwind", "limited", "conservative", "conservative_limited"}});
  k.push_back({"tfm", "solids_wall", at<std::string>([](S& s, N) -> auto& { return s.tfm.solids_wall; }), "velocity of the solids along walls; johnson_jackson: partial slip, with a viscosity of the solids", {}, -infinity, infinity, false, "free_slip", {"free_slip", "no_slip", "johnson_jackson"}, false, "johnson_jackson: mu_s dU_t/dn = -[pi sqrt(3 theta) s rho phi g0/(6 phi_max) + p_f tan(delta_w)/abs(U_t)] U_t"});
  k.push_back({"tfm", "max_packing", at<std::string>([](S& s, N) -> auto& { return s.tfm.max_packing; }), "phi_max of the frictional pressure: a number; auto: the settled bed then has bed.solids_fraction; or of the mixture in each cell, from species.max_packing", {}, 0, 1, true, "auto", {"auto", "fedors_landel", "yu_standish"}, false, {}, true});
  k.push_back({"tfm", "frictional_pressure", at<double>([](S& s, N) -> auto& { return s.tfm.frictional_pressure; }), "Fr", dimension::pressure, 0, 1e6, true, "0.05 Pa", {}, false, "p_f = Fr (phi - phi_min)^2/(phi_max - phi)^5"});
  k.push_back({"tfm", "frictional_onset", at<double>([](S& s, N) -> auto& { return s.tfm.frictional_onset; }), "phi_min, above which solids press on each other", {}, 0, 0.9, true, "0.5", {}, false, "p_f = Fr (phi - phi_min)^2/(phi_max - phi)^5"});
  k.push_back({"tfm", "bulk_viscosity", at<std::optional<double>>([](S& s, N) -> auto& { return s.tfm.bulk_viscosity; }), "alpha; damps elastic waves of the packed bed; 0 is off; default: 1 over the number of directions with more than one cell", {}, 0, 10, false, {}, {}, false, "p_s = p_f - alpha rho_s c_s h sum phi_j div U_j"});
  k.push_back({"tfm", "friction_angle", at<double>([](S& s, N) -> auto& { return s.tfm.friction_angle; }), "delta, angle of internal friction of schaeffer, in degrees", {}, 0, 60, true, "28.5", {}, false, "mu_s = p_f sin(delta)/abs(gamma)"});
  k.push_back({"tfm", "viscosity_cap", at<double>([](S& s, N) -> auto& { return s.tfm.viscosity_cap; }), "greatest frictional viscosity, which solids at rest have: they creep", dimension::viscosity, 0, 1e6, true, "10 Pa s"});
  k.push_back({"tfm", "least_shear_rate", at<double>([](S& s, N) -> auto& { return s.tfm.least_shear_rate; }), "gamma_0 of the frictional viscosity", dimension::rate, 0, 1e6, true, "1", {}, false, "abs(gamma) = sqrt(2 D':D' + gamma_0^2)"});
  k.push_back({"tfm", "kinetic_theory", at<std::string>([](S& s, N) -> auto& { return s.tfm.kinetic_theory; }), "viscosity and dissipation of solids_stress = kinetic", {}, -infinity, infinity, false, "garzo_dufty", {"garzo_dufty", "lun"}});
  k.push_back({"tfm", "radial_distribution", at<std::string>([](S& s, N) -> auto& { return s.tfm.radial_distribution; }), "g0 of solids_stress = kinetic; torquato: above 0.49 growing towards 0.64", {}, -infinity, infinity, false, "torquato", {"torquato", "carnahan_starling"}, false, "g0 = (1 - phi/2)/(1 - phi)^3; above 0.49 CS(0.49) 0.15/(0.64 - phi)"});
  k.push_back({"tfm", "start_temperature", at<double>([](S& s, N) -> auto& { return s.tfm.start_temperature; }), "theta_j at the start, for granular_temperature = transported", dimension::speed_squared, 0, 1e6, false, "1e-6"});
  k.push_back({"tfm", "specularity", at<double>([](S& s, N) -> auto& { return s.tfm.specularity; }), "s: share of tangential momentum that a collision with the wall takes; solids_wall = johnson_jackson with kinetic stress", {}, 0, 1, false, "0.1"});
  k.push_back({"tfm", "wall_restitution", at<double>([](S& s, N) -> auto& { return s.tfm.wall_restitution; }), "e_w of collisions with that wall; granular_temperature = transported", {}, 0, 1, false, "0.9", {}, false, "k dtheta/dn = pi sqrt(3 theta) rho phi g0/phi_max [s U_t^2/6 - (1 - e_w^2) theta/4]"});
  k.push_back({"tfm", "wall_friction", at<double>([](S& s, N) -> auto& { return s.tfm.wall_friction; }), "tan(delta_w) of solids_wall = johnson_jackson", {}, 0, 2, false, "0.2"});
  k.push_back({"tfm", "exchange_pressure", at<double>([](S& s, N) -> auto& { return s.tfm.exchange_pressure; }), "C_s: contact friction between species in a packed bed", dimension::per_pressure, 0, 1e9, false, "0 s/m2", {}, false, "K_jk = ... + C_s p_s phi_j phi_k/phi^2"});
  k.push_back({"tfm", "fixed_step", at<std::optional<double>>([](S& s, N) -> auto& { return s.tfm.fixed_step; }), "steps of one length without error control, for verification; explicit only", dimension::time, 0, 1e3, true});
  k.push_back({"tfm", "pressure_tolerance", at<std::optional<double>>([](S& s, N) -> auto& { return s.tfm.pressure_tolerance; }), "relative residual of the pressure's equation; default: the smaller of 1e-4 and rtol/10", {}, 1e-15, 0.1});

  k.push_back({"dem", "steps_per_contact", at<double>([](S& s, N) -> auto& { return s.dem.steps_per_contact; }), "time steps in one contact", {}, 5, 1e5, false, "20"});
  k.push_back({"dem", "youngs_modulus", at<std::optional<double>>([](S& s, N) -> auto& { return s.dem.youngs_modulus; }), "E of all species that do not say otherwise; default: 5 MPa, or the least at which impacts at dem.greatest_speed overlap by no more than dem.max_overlap", dimension::pressure, 0, 1e13, true});
  k.push_back({"dem", "poisson_ratio", at<double>([](S& s, N) -> auto& { return s.dem.poisson_ratio; }), "likewise", {}, 0, 0.5, false, "0.25"});
  k.push_back({"dem", "friction", at<double>([](S& s, N) -> auto& { return s.dem.friction; }), "likewise; the TFM's species exchange reads it too", {}, 0, 10, false, "0.3"});
  k.push_back({"dem", "restitution", at<double>([](S& s, N) -> auto& { return s.dem.restitution; }), "likewise; the TFM's species exchange reads it too", {}, 0, 1, true, "0.9"});
  k.push_back({"dem", "fluid_every", at<int>([](S& s, N) -> auto& { return s.dem.fluid_every; }), "solid steps per fluid step", {}, 1, 1e6, false, "16"});
  k.push_back({"dem", "kernel", at<std::string>([](S& s, N) -> auto& { return s.dem.kernel; }), "how particles are averaged for the fluid: bilinear in the cells around them; diffusion: with a width of its own; auto: diffusion where a cell is smaller than 1.5 of the largest diameters, for fewer than 10 particles 5", {}, -infinity, infinity, false, "auto", {"auto", "bilinear", "diffusion"}});
  k.push_back({"dem", "kernel_width", at<std::optional<double>>([](S& s, N) -> auto& { return s.dem.kernel_width; }), "of the diffusion kernel, full width at half height; default: 4 of the largest diameters, of fewer than 10 particles 6", dimension::length, 0, 10, true});
  k.push_back({"dem", "own_share", at<std::string>([](S& s, N) -> auto& { return s.dem.own_share; }), "what a particle counts for in the averages that its drag follows from, less the neighbours that it keeps away: kept as the thesis has it, or removed, as drag laws are made of means of the mixture", {}, -infinity, infinity, false, "kept", {"kept", "removed"}});
  k.push_back({"dem", "held", at<bool>([](S& s, N) -> auto& { return s.dem.held; }), "particles stay where they are: a fixed bed, for its pressure drop", {}, -infinity, infinity, false, "false"});
  k.push_back({"dem", "fluid_ranks", at<std::string>([](S& s, N) -> auto& { return s.dem.fluid_ranks; }), "on several ranks: each solves for the whole fluid, and particles have the same bits on any number of ranks; shared: each solves for a block of it, to the solver's tolerance; auto: shared from 20000 cells on", {}, -infinity, infinity, false, "auto", {"auto", "each", "shared"}});
  k.push_back({"dem", "tangential", at<std::string>([](S& s, N) -> auto& { return s.dem.tangential; }), "tangential force with contact = hertz_mindlin: hdd after Di Renzo and Di Maio, mindlin incremental, mindlin_deresiewicz with partial slip; linear: a spring of tangential_ratio times k_n", {}, -infinity, infinity, false, "hdd", {"hdd", "mindlin", "mindlin_deresiewicz", "linear"}, false, "hdd: F_t = -(2/3) 8 G* a xi - c_t v_t"});
  k.push_back({"dem", "tail", at<std::string>([](S& s, N) -> auto& { return s.dem.tail; }), "near separation the dashpot would pull: clip: F_n >= 0, with the damping that then realises the restitution; keep: it pulls", {}, -infinity, infinity, false, "clip", {"clip", "keep"}});
  k.push_back({"dem", "integrator", at<std::string>([](S& s, N) -> auto& { return s.dem.integrator; }), "thesis: forces from half-step velocities; synchronised: velocities at the time of the positions; auto: synchronised with friction and a ratio of diameters of at least 3", {}, -infinity, infinity, false, "auto", {"auto", "thesis", "synchronised"}});
  k.push_back({"dem", "normal_stiffness", at<std::optional<double>>([](S& s, N) -> auto& { return s.dem.normal_stiffness; }), "k_n of contact = linear", dimension::stiffness, 0, 1e12, true});
  k.push_back({"dem", "tangential_ratio", at<double>([](S& s, N) -> auto& { return s.dem.tangential_ratio; }), "k_t/k_n of tangential = linear", {}, 0, 1, false, "2/7"});
  k.push_back({"dem", "rolling_friction", at<double>([](S& s, N) -> auto& { return s.dem.rolling_friction; }), "mu_r, arm of the rolling moment over R*; 0 is off", {}, 0, 10, false, "0", {}, false, "M <= mu_r R* F_n"});
  k.push_back({"dem", "rolling_damping", at<double>([](S& s, N) -> auto& { return s.dem.rolling_damping; }), "of the rolling spring, over its critical damping", {}, 0, 10, false, "0"});
  k.push_back({"dem", "skin", at<std::optional<double>>([](S& s, N) -> auto& { return s.dem.skin; }), "of the list of neighbours; default: a tenth of the smallest diameter", dimension::length, 0, 1, true});
  k.push_back({"dem", "max_overlap", at<double>([](S& s, N) -> auto& { return s.dem.max_overlap; }), "over the diameter of the smaller particle; above it the run stops", {}, 0, 1, true, "0.05"});
  k.push_back({"dem", "fixed_step", at<std::optional<double>>([](S& s, N) -> auto& { return s.dem.fixed_step; }), "time step; default: from stiffness, sound and speed", dimension::time, 0, 1e3, true});
  k.push_back({"dem", "greatest_speed", at<std::optional<double>>([](S& s, N) -> auto& { return s.dem.greatest_speed; }), "expected of any particle: sets the time step", dimension::velocity, 0, 1e5, true});
  k.push_back({"dem", "start_speed", at<double>([](S& s, N) -> auto& { return s.dem.start_speed; }), "root mean square of each component of random velocities at the start", dimension::velocity, 0, 1e5, false, "0 m/s"});
  k.push_back({"dem", "shear_rate", at<double>([](S& s, N) -> auto& { return s.dem.shear_rate; }), "dv_x/dy of a sheared box (Lees and Edwards): needs column.sides and column.ends periodic and no gravity", dimension::rate, -1e6, 1e6, false, "0 1/s"});
  k.push_back({"dem", "opening", at<std::optional<double>>([](S& s, N) -> auto& { return s.dem.opening; }), "width of an opening in the middle of the bottom, through which particles fall out and are counted: a slot as deep as the column, or with three numbers in column.size a round hole; needs fluid.name = \"none\"", dimension::length, 0, 100, true});
  k.push_back({"dem", "ledger", at<bool>([](S& s, N) -> auto& { return s.dem.ledger; }), "account of the energy: kinetic, elastic, potential, dissipated, work", {}, -infinity, infinity, false, "true"});
  k.push_back({"dem", "cohesion_energy", at<double>([](S& s, N) -> auto& { return s.dem.cohesion_energy; }), "W of cohesion of the kinds DMT and JKR, J/m2", dimension::surface_energy, 0, 1e6, false, "0 J/m2", {}, false, "pull-off: DMT 2 pi W R*, JKR 1.5 pi W R*"});
  k.push_back({"dem", "hamaker_constant", at<double>([](S& s, N) -> auto& { return s.dem.hamaker_constant; }), "A of the van der Waals force", dimension::energy, 0, 1e-6, false, "0 J", {}, false, "F = A R*/(6 z^2)"});
  k.push_back({"dem", "cohesion_gap", at<double>([](S& s, N) -> auto& { return s.dem.cohesion_gap; }), "z_0, cut-off of the van der Waals force: nearer than this it grows no more", dimension::length, 0, 1, true, "0.165 nm", {}, false, "F = A R*/(6 max(z, z_0)^2)"});
  k.push_back({"dem", "asperity_radius", at<std::optional<double>>([](S& s, N) -> auto& { return s.dem.asperity_radius; }), "R* of the van der Waals force of rough surfaces; default: that of the spheres", dimension::length, 0, 1, true, {}, {}, false, "F = A R*/(6 max(z, z_0)^2)"});
  k.push_back({"dem", "roughness", at<double>([](S& s, N) -> auto& { return s.dem.roughness; }), "of surfaces: the film between them is not thinner (effects.lubrication = film)", dimension::length, 0, 1, true, "0.1 um", {}, false, "F = -6 pi mu R*^2 v_n/max(h, roughness)"});

  k.push_back({"calibrate", "regime", at<std::string>([](S& s, N) -> auto& { return s.calibrate.regime; }), "boxes of polybed calibrate: dry: collisions alone; wet: sheared, with drag towards the flow and films; bed: fluidised; auto: dry where the shear rate times the relaxation time of the slip is 1 or more, else wet", {}, -infinity, infinity, false, "auto", {"auto", "dry", "wet", "bed"}});
  k.push_back({"calibrate", "solids_fraction", at<std::vector<double>>([](S& s, N) -> auto& { return s.calibrate.solids_fraction; }), "of the boxes, rising; default: 0.1 to 0.5", {}, 0.01, 0.66});
  k.push_back({"calibrate", "restitution", at<std::vector<double>>([](S& s, N) -> auto& { return s.calibrate.restitution; }), "of dry boxes, rising; default: dem.restitution", {}, 0.05, 0.9999});
  k.push_back({"calibrate", "friction", at<std::vector<double>>([](S& s, N) -> auto& { return s.calibrate.friction; }), "of the boxes, rising; default: dem.friction", {}, 0, 2});
  k.push_back({"calibrate", "stokes", at<std::vector<double>>([](S& s, N) -> auto& { return s.calibrate.stokes; }), "of wet boxes, rising; default: 1, 3, 10", {}, 1e-3, 1e4, false, {}, {}, false, "St = rho_p d^2 gamma/mu"});
  k.push_back({"calibrate", "share", at<std::vector<double>>([](S& s, N) -> auto& { return s.calibrate.share; }), "volume of the second species over that of both, rising; default: spheres of one size, the Sauter diameter of the bed", {}, 0, 1});
  k.push_back({"calibrate", "particles", at<int>([](S& s, N) -> auto& { return s.calibrate.particles; }), "of a box", {}, 100, 1e6, false, "1000"});
  k.push_back({"calibrate", "seeds", at<int>([](S& s, N) -> auto& { return s.calibrate.seeds; }), "boxes at each point, with other random starts; from 3 on a point of a sheared table gets more, up to 10, while its standard error is above 5 %", {}, 1, 100, false, "2"});
  k.push_back({"calibrate", "strain", at<double>([](S& s, N) -> auto& { return s.calibrate.strain; }), "over which a box is averaged, in 20 blocks", {}, 1, 1e4, false, "20"});
  k.push_back({"calibrate", "discard_strain", at<double>([](S& s, N) -> auto& { return s.calibrate.discard_strain; }), "before that", {}, 0, 1e4, false, "5"});
  k.push_back({"calibrate", "doublings", at<int>([](S& s, N) -> auto& { return s.calibrate.doublings; }), "of the averaged strain, at most, while blocks are not independent", {}, 0, 10, false, "2"});
  k.push_back({"calibrate", "softness", at<double>([](S& s, N) -> auto& { return s.calibrate.softness; }), "of dry boxes: duration of a contact over the time between collisions", {}, 1e-3, 0.2, false, "0.03"});
  k.push_back({"calibrate", "film_gap", at<double>([](S& s, N) -> auto& { return s.calibrate.film_gap; }), "of wet boxes: least thickness of a film over the diameter, if dem.roughness is not more; steps are as short as it needs", {}, 1e-5, 0.02, false, "0.005"});

  k.push_back({"jet", "from", at<std::vector<double>>([](S& s, N n) -> auto& { return s.jets[n].from; }), "low corner of a part of the bottom with a velocity of its own: [x], or [x, z] (width, depth) in three dimensions", dimension::length, 0, 1e3, false, {}, {}, true});
  k.push_back({"jet", "to", at<std::vector<double>>([](S& s, N n) -> auto& { return s.jets[n].to; }), "high corner", dimension::length, 0, 1e3, false, {}, {}, true});
  k.push_back({"jet", "superficial_velocity", at<Points>([](S& s, N n) -> auto& { return s.jets[n].superficial_velocity; }), "over the jet's own area, in place of inlet.superficial_velocity; a velocity or a table as there", dimension::velocity, -1e3, 1e3, false, {}, {}, true});

  k.push_back({"feed", "species", at<std::string>([](S& s, N n) -> auto& { return s.feeds[n].species; }), "name of the species that is fed; of one with a distribution: all classes, by their shares", {}, -infinity, infinity, false, {}, {}, true});
  k.push_back({"feed", "at", at<std::string>([](S& s, N n) -> auto& { return s.feeds[n].at; }), "end of the column", {}, -infinity, infinity, false, "bottom", {"bottom", "top"}});
  k.push_back({"feed", "superficial_velocity", at<Points>([](S& s, N n) -> auto& { return s.feeds[n].superficial_velocity; }), "volume of solids per area of the feed and time, into the column, besides the fluid of the inlet; a velocity or a table as there", dimension::velocity, 0, 1e3, false, {}, {}, true});
  k.push_back({"feed", "velocity", at<double>([](S& s, N n) -> auto& { return s.feeds[n].velocity; }), "of the particles as they enter; superficial_velocity over it is their volume fraction", dimension::velocity, 0, 1e3, true, {}, {}, true});
  k.push_back({"feed", "from", at<std::vector<double>>([](S& s, N n) -> auto& { return s.feeds[n].from; }), "low corner of the part of the end, as of a jet; default: the whole end", dimension::length, 0, 1e3});
  k.push_back({"feed", "to", at<std::vector<double>>([](S& s, N n) -> auto& { return s.feeds[n].to; }), "high corner", dimension::length, 0, 1e3});

  k.push_back({"contact_pair", "between", at<std::vector<std::string>>([](S& s, N n) -> auto& { return s.contact_pairs[n].between; }), "two species, or a species and \"wall\"", {}, -infinity, infinity, false, {}, {}, true});
  k.push_back({"contact_pair", "youngs_modulus", at<std::optional<double>>([](S& s, N n) -> auto& { return s.contact_pairs[n].youngs_modulus; }), "of both partners in this pair; default: each has its own, a wall that of [dem]", dimension::pressure, 0, 1e13, true});
  k.push_back({"contact_pair", "poisson_ratio", at<std::optional<double>>([](S& s, N n) -> auto& { return s.contact_pairs[n].poisson_ratio; }), "of both partners in this pair; default: as the modulus", {}, 0, 0.5});
  k.push_back({"contact_pair", "friction", at<std::optional<double>>([](S& s, N n) -> auto& { return s.contact_pairs[n].friction; }), "of this pair; default: the mean of both", {}, 0, 10});
  k.push_back({"contact_pair", "restitution", at<std::optional<double>>([](S& s, N n) -> auto& { return s.contact_pairs[n].restitution; }), "of this pair; default: the mean of both", {}, 0, 1, true});
  return k;
}
// clang-format on

/// Edits that turn one text into the other: insert, delete, replace, swap of neighbours.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

}  // namespace

std::span<const Key> keys() {
  static const std::vector<Key> table = make_keys();
  return table;
}

bool is_array_of_tables(std::string_view table) {
  return table == "species" || table == "contact_pair" || table == "jet" || table == "feed";
}

std::string kind_name(const Key& key) {
  struct Visitor {
    std::string operator()(Place<double>) const { return "number"; }
    std::string operator()(Place<std::optional<double>>) const { return "number"; }
    std::string operator()(Place<int>) const { return "count"; }
    std::string operator()(Place<std::uint64_t>) const { return "count"; }
    std::string operator()(Place<bool>) const { return "true or false"; }
    std::string operator()(Place<std::string>) const { return "text"; }
    std::string operator()(Place<std::vector<double>>) const { return "list of numbers"; }
    std::string operator()(Place<std::vector<std::int64_t>>) const { return "list of counts"; }
    std::string operator()(Place<std::vector<std::string>>) const { return "list of texts"; }
    std::string operator()(Place<Points>) const { return "number or table in time"; }
  };
  const std::string kind = key.by_size ? "table of length, m, and number" : std::visit(Visitor{}, key.place);
  return key.dimension == dimension::none ? kind : kind + ", " + unit_name(key.dimension);
}

bool fits_word(std::string_view word, std::string_view text) {
  constexpr std::string_view file = "FILE";
  if (!word.ends_with(file)) return word == text;
  word.remove_suffix(file.size());
  return text.starts_with(word) && text.size() > word.size();
}

bool is_word(const Key& key, std::string_view text) {
  return std::any_of(key.words.begin(), key.words.end(), [&](std::string_view word) { return fits_word(word, text); });
}

std::string range_text(const Key& key) {
  if (!key.words.empty() && !key.or_number) return fmt::format("{}", fmt::join(key.words, " | "));
  const std::string unit = key.dimension == dimension::none ? "" : " " + unit_name(key.dimension);
  std::string text;
  if (key.least > -infinity) text = fmt::format("{} {:g}", key.above_least ? "above" : "at least", key.least);
  if (key.most < infinity) text += fmt::format("{}at most {:g}", text.empty() ? "" : ", ", key.most);
  if (!text.empty()) text += unit;
  return key.or_number ? fmt::format("{} | a number {}", fmt::join(key.words, " | "), text) : text;
}

std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names) {
  std::string best;
  std::size_t fewest = std::max<std::size_t>(2, wrong.size() / 3) + 1;
  for (const std::string& name : names)
    if (const std::size_t n = edits(wrong, name); n < fewest) {
      fewest = n;
      best = name;
    }
  return best;
}

}  // namespace polybed::core
