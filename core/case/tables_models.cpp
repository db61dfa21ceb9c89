// The keys of the models and of the boxes of a calibration.
#include "core/case/schema.hpp"

namespace polybed::core::schema {

namespace {

Table tfm_table() {
  return table(
      "tfm", &Scene::tfm,
      {
          key(&Tfm::integrator, "integrator",
              help("imex (drag implicit, the rest explicit) for liquid beds, implicit for gas, compressible fluids and "
                   "settling, explicit without drag; auto chooses so")),
          key(&Tfm::follow_bed, "follow_bed",
              help("solve for the solids only in the rows that contain them and eight above; explicit and imex")),
          key(&Tfm::rtol, "rtol", range(1e-12, 0.1), help("relative tolerance of the time integration")),
          key(&Tfm::form, "form",
              help("the pressure gradient acts, A: on every phase by its volume; B: on the fluid alone, with the net "
                   "force on particles (drag over voidage, for one species) instead of the drag: the same uniform bed, "
                   "other waves and bubbles"),
              equation("B: b_j + sum phi_k b_k/eps in place of b_j, no grad p in dU_j/dt")),
          key(&Tfm::flux, "flux", help("solids fractions at faces: second order with a limiter, or first order")),
          shared<Tfm>(&Scene::scheme, key(&FluidScheme::momentum, "momentum",
                                          help("convection of velocities, conservative: of first order, or of second "
                                               "with a limiter; auto: conservative, in the DEM conservative_limited"))),
          key(&Tfm::solids_wall, "solids_wall",
              help("solids at walls; johnson_jackson: partial slip, with a viscosity of the solids"),
              equation("johnson_jackson: mu_s dU_t/dn = -[pi sqrt(3 theta) s rho phi g0/(6 phi_max) + p_f "
                       "tan(delta_w)/abs(U_t)] U_t")),
          key(&Tfm::max_packing, "max_packing", above(0, 1),
              help("phi_max of the frictional pressure: a number; auto: the settled bed then has bed.solids_fraction; "
                   "or of the mixture in each cell, from species.max_packing")),
          key(&Tfm::frictional_pressure, "frictional_pressure", dimension::pressure, above(0, 1e6), help("Fr"),
              equation("p_f = Fr (phi - phi_min)^2/(phi_max - phi)^5")),
          key(&Tfm::frictional_onset, "frictional_onset", above(0, 0.9),
              help("phi_min, above which solids press on each other; default with max_packing = \"auto\" and a bed or "
                   "layer settled to at most 0.5: 0.9 of the loosest"),
              equation("p_f = Fr (phi - phi_min)^2/(phi_max - phi)^5")),
          key(&Tfm::bulk_viscosity, "bulk_viscosity", range(0, 10),
              help("alpha; damps elastic waves of the packed bed; 0 is off; default: 1 over the number of directions "
                   "with more than one cell"),
              equation("p_s = p_f - alpha rho_s c_s h sum phi_j div U_j")),
          key(&Tfm::viscosity_cap, "viscosity_cap", dimension::viscosity, above(0, 1e6),
              help("greatest frictional viscosity: solids at rest creep")),
          key(&Tfm::least_shear_rate, "least_shear_rate", dimension::rate, above(0, 1e6),
              help("gamma_0 of the frictional viscosity"), equation("abs(gamma) = sqrt(2 D':D' + gamma_0^2)")),
          key(&Tfm::kinetic_theory, "kinetic_theory", help("viscosity and dissipation of solids_stress = kinetic")),
          key(&Tfm::radial_distribution, "radial_distribution",
              help("g0 of solids_stress = kinetic; torquato: above 0.49 growing towards 0.64"),
              equation("g0 = (1 - phi/2)/(1 - phi)^3; above 0.49 CS(0.49) 0.15/(0.64 - phi)")),
          key(&Tfm::start_temperature, "start_temperature", dimension::speed_squared, range(0, 1e6),
              help("theta_j at the start, for granular_temperature = transported")),
          key(&Tfm::specularity, "specularity", range(0, 1),
              help("s: share of the tangential momentum that a collision passes to the wall; solids_wall = "
                   "johnson_jackson with kinetic stress")),
          key(&Tfm::wall_friction, "wall_friction", range(0, 2), help("tan(delta_w) of solids_wall = johnson_jackson")),
          key(&Tfm::exchange_pressure, "exchange_pressure", dimension::per_pressure, range(0, 1e9),
              help("C_s: contact friction between species in a packed bed"),
              equation("K_jk = ... + C_s p_s phi_j phi_k/phi^2")),
          key(&Tfm::fixed_step, "fixed_step", dimension::time, above(0, 1e3),
              help("length of steps without error control, for verification; explicit and imex")),
          key(&Tfm::pressure_tolerance, "pressure_tolerance", range(1e-13, 0.1),
              help("relative residual of the pressure equation; default: the smaller of 1e-4 and rtol/10")),
      });
}

Table dem_table() {
  return table(
      "dem", &Scene::dem,
      {
          key(&Dem::steps_per_contact, "steps_per_contact", range(5, 1e5), help("time steps in one contact")),
          key(&Dem::youngs_modulus, "youngs_modulus", dimension::pressure, above(0, 1e13),
              help("E of species without their own; default: 5 MPa, or the least at which impacts at "
                   "dem.greatest_speed overlap by no more than dem.max_overlap")),
          key(&Dem::poisson_ratio, "poisson_ratio", range(0, 0.5), help("likewise")),
          shared<Dem>(&Scene::material, key(&Material::friction, "friction", range(0, 10),
                                            help("likewise; also for the TFM's species exchange"))),
          shared<Dem>(&Scene::material, key(&Material::restitution, "restitution", above(0, 1),
                                            help("likewise; also for the TFM's species exchange"))),
          key(&Dem::fluid_every, "fluid_every", range(1, 1e6),
              help("particle steps per fluid step; default: 16, or as many as move the fluid by at most half a cell at "
                   "its velocity between packed particles")),
          key(&Dem::kernel, "kernel",
              help("averaging of particles for the fluid: bilinear over the cells around them; diffusion: with its own "
                   "width; auto: diffusion in cells below 1.5 largest diameters, for fewer than 10 particles 5")),
          key(&Dem::kernel_width, "kernel_width", dimension::length, above(0, 10),
              help(
                  "full width of the diffusion kernel at half height; default: 4 mean (Sauter) diameters, at least 1.5 "
                  "largest ones, and 6 of these for fewer than 10 particles")),
          key(&Dem::own_share, "own_share",
              help("a particle's own share in the averages that set its drag, less the neighbours that it keeps away: "
                   "kept as in the thesis, or removed, as drag laws are made from means of the mixture")),
          shared<Dem>(&Scene::bed,
                      key(&Bed::held, "held", help("particles do not move: a fixed bed, for its pressure drop"))),
          key(&Dem::fluid_ranks, "fluid_ranks",
              help("on several ranks, each: every rank solves for the whole fluid, with the same bits on any number; "
                   "shared: each solves for a block, to the solver's tolerance; auto: shared from 20000 cells on")),
          key(&Dem::tangential, "tangential",
              help("tangential force with contact = hertz_mindlin: hdd after Di Renzo and Di Maio, mindlin "
                   "incremental, mindlin_deresiewicz with partial slip; linear: spring of 2/7 k_n"),
              equation("hdd: F_t = -(2/3) 8 G* a xi - c_t v_t")),
          key(&Dem::tail, "tail",
              help("near separation the dashpot would pull: clip: F_n >= 0, with the damping that then gives the "
                   "restitution; keep: it pulls")),
          key(&Dem::integrator, "integrator",
              help("thesis: forces from half-step velocities; synchronised: from velocities at the time of the "
                   "positions; auto: synchronised with friction and diameters in a ratio of at least 3")),
          key(&Dem::normal_stiffness, "normal_stiffness", dimension::stiffness, above(0, 1e12),
              help("k_n of contact = linear")),
          key(&Dem::rolling_friction, "rolling_friction", range(0, 10),
              help("mu_r, arm of the rolling moment over R*; 0 is off"), equation("M <= mu_r R* F_n")),
          key(&Dem::rolling_damping, "rolling_damping", range(0, 10),
              help("of the rolling spring, over its critical damping")),
          key(&Dem::skin, "skin", dimension::length, above(0, 1),
              help("of the list of neighbours; default: a tenth of the smallest diameter, up to half of it in fast "
                   "beds")),
          key(&Dem::max_overlap, "max_overlap", above(0, 1),
              help("over the diameter of the smaller particle; above it the run stops")),
          key(&Dem::fixed_step, "fixed_step", dimension::time, above(0, 1e3),
              help("time step; default: from stiffness, sound and speed")),
          key(&Dem::greatest_speed, "greatest_speed", dimension::velocity, above(0, 1e5),
              help("expected of any particle: sets the time step")),
          key(&Dem::start_speed, "start_speed", dimension::velocity, range(0, 1e5),
              help("root mean square of each component of random velocities at the start")),
          shared<Dem>(&Scene::column, key(&Column::shear_rate, "shear_rate", dimension::rate, range(-1e6, 1e6),
                                          help("dv_x/dy of a sheared box (Lees and Edwards): needs periodic "
                                               "column.sides and column.ends, no gravity"))),
          key(&Dem::opening, "opening", dimension::length, above(0, 100),
              help("width of an opening in the middle of the bottom, for dry particles, which are counted: a slot as "
                   "deep as the column, in 3-D a round hole")),
          key(&Dem::ledger, "ledger", help("energy balance: kinetic, elastic, potential, dissipated, work")),
          key(&Dem::cohesion_energy, "cohesion_energy", dimension::surface_energy, range(0, 1e6),
              help("W of cohesion = dmt, jkr, J/m2"), equation("pull-off: DMT 2 pi W R*, JKR 1.5 pi W R*")),
          shared<Dem>(&Scene::material,
                      key(&Material::hamaker_constant, "hamaker_constant", dimension::energy, range(0, 1e-6),
                          help("A of the van der Waals force"), equation("F = A R*/(6 z^2)"))),
          key(&Dem::cohesion_gap, "cohesion_gap", dimension::length, above(0, 1),
              help("z_0, gap below which the van der Waals force grows no more"),
              equation("F = A R*/(6 max(z, z_0)^2)")),
          key(&Dem::asperity_radius, "asperity_radius", dimension::length, above(0, 1),
              help("R* of the van der Waals force of rough surfaces; default: of the spheres"),
              equation("F = A R*/(6 max(z, z_0)^2)")),
          shared<Dem>(&Scene::material,
                      key(&Material::surface_tension, "surface_tension", dimension::stiffness, above(0, 10),
                          help("gamma of the liquid of liquid bridges, in a gas"),
                          equation("F = 2 pi R gamma cos(theta)/(1 + 1.05 s + 2.5 s^2), s = gap sqrt(R/V), R = 2 R*"))),
          shared<Dem>(&Scene::material, key(&Material::contact_angle, "contact_angle", range(0, 90),
                                            help("theta of that liquid on particles and walls, in degrees"),
                                            equation("bridges break at a gap of (1 + theta/2) V^(1/3)"))),
          shared<Dem>(&Scene::material,
                      key(&Material::liquid_fraction, "liquid_fraction", range(0, 0.1),
                          help("volume of that liquid on a particle over the particle's; a bridge gets the part of "
                               "both films that each sphere covers, seen from the other's centre"),
                          equation("V = sum of a_i liquid_fraction V_i, a_i = [1 - sqrt(1 - (R_j/(R_i + R_j))^2)]/2"))),
          shared<Dem>(&Scene::material,
                      key(&Material::roughness, "roughness", dimension::length, above(0, 1),
                          help("of surfaces: least thickness of the film between them (effects.lubrication = film)"),
                          equation("F = -6 pi mu R*^2 v_n/max(h, roughness)"))),
      });
}

Table inversion_table() {
  return table("inversion", &Scene::inversion,
               {
                   key(&Inversion::measured, "measured", dimension::velocity, range(0, 1e3),
                       help("superficial velocity at which two species changed places in an experiment, or the two "
                            "that enclose it; polybed inversion prints it, no run reads it")),
                   key(&Inversion::simulated, "simulated", dimension::velocity, range(0, 1e3),
                       help("the same of a published simulation")),
               });
}

Table calibrate_table() {
  return table(
      "calibrate", &Scene::calibrate,
      {
          key(&Calibrate::regime, "regime",
              help("boxes of polybed calibrate: dry: collisions alone; wet: sheared, with drag towards the flow and "
                   "films; bed: fluidised; auto: dry where the shear rate times the relaxation time of the slip is at "
                   "least 1, else wet")),
          key(&Calibrate::solids_fraction, "solids_fraction", range(0.01, 0.66),
              help("of the boxes, rising; default: 0.1 to 0.5")),
          key(&Calibrate::restitution, "restitution", range(0.05, 0.9999),
              help("of dry boxes, rising; default: dem.restitution")),
          key(&Calibrate::friction, "friction", range(0, 2), help("of the boxes, rising; default: dem.friction")),
          key(&Calibrate::stokes, "stokes", range(1e-3, 1e4), help("of wet boxes, rising; default: 1, 3, 10"),
              equation("St = rho_p d^2 gamma/mu")),
          key(&Calibrate::share, "share", range(0, 1),
              help("volume of the second species over both, rising; default: spheres of one size, the Sauter diameter "
                   "of the bed")),
          key(&Calibrate::particles, "particles", range(100, 1e6), help("of a box")),
          key(&Calibrate::seeds, "seeds", range(1, 100),
              help("boxes at each point, with other random starts; from 2 on a point of a sheared table gets up to 10, "
                   "while its standard error exceeds 5 %")),
          key(&Calibrate::strain, "strain", range(1, 1e4), help("over which a box is averaged, in 20 blocks")),
          key(&Calibrate::discard_strain, "discard_strain", range(0, 1e4), help("before that")),
          key(&Calibrate::doublings, "doublings", range(0, 10),
              help("of the averaged strain at most, while blocks are not independent")),
          key(&Calibrate::softness, "softness", range(1e-3, 0.2),
              help("of dry boxes: duration of a contact over the time between collisions")),
      });
}

Table resolve_table() {
  return table(
      "resolve", &Scene::resolve,
      {
          key(&Resolve::voidage, "voidage", range(0.3, 0.99), help("of the boxes of polybed resolve, one or more")),
          key(&Resolve::motion, "motion",
              help("of the spheres: held; moving: each species past all others, for the forces by relative motion; "
                   "free: under drag, weight and contacts")),
          key(&Resolve::reynolds, "reynolds", range(0, 300),
              help("of the Sauter diameter and the superficial velocity, one or more; 0: Stokes flow")),
          key(&Resolve::cells_per_diameter, "cells_per_diameter", range(6, 200),
              help("of the smallest spheres, on the finest grid")),
          key(&Resolve::grids, "grids", range(1, 3),
              help("each 1.5 times coarser than the one before; rows are from the finest, from two on with the "
                   "difference to the next")),
          key(&Resolve::packings, "packings", range(1, 1000), help("random boxes per row")),
          key(&Resolve::spheres, "spheres", range(1, 1e5), help("in a box, all sizes together")),
          key(&Resolve::precision, "precision", help("of the numbers of the flow: single takes half the memory")),
          key(&Resolve::until, "until", dimension::time, above(0, 1e6),
              help("simulated time of boxes of free spheres, less the first third; default: the fastest species, "
                   "hindered by the others, falls through its box about ten times")),
          key(&Resolve::checkpoint_every, "checkpoint_every", dimension::time, above(0, 1e9),
              help("wall time between checkpoints of a box that is not steady yet")),
      });
}

}  // namespace

std::vector<Table> model_tables() {
  return {tfm_table(), dem_table(), inversion_table(), calibrate_table(), resolve_table()};
}

}  // namespace polybed::core::schema
