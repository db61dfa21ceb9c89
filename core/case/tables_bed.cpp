// The keys of the column, the fluid, the particles and the bed.
#include "core/case/schema.hpp"

namespace polybed::core::schema {

void Access<Start>::set(Start& place, const Value& value) {
  const std::string& text = std::get<std::string>(value);
  const auto word = std::find_if(words.begin(), words.end(), [&](std::string_view w) { return fits_word(w, text); });
  place.kind = static_cast<StartKind>(word - words.begin());
  place.file = text.substr(std::min(text.size(), word->find("FILE")));
}

namespace {

Table title_table() {
  return table_of<Scene>("", false, [](auto& scene, std::size_t) -> auto& { return scene; },
                         {key(&Scene::title, "title", help("what the case is, in one line"))});
}

Table column_table() {
  return table(
      "column", &Scene::column,
      {
          key(&Column::shape, "shape",
              help("cylinder: upright and round, size = [diameter, diameter, height]; axisymmetric: the same in two "
                   "dimensions, size = [radius, height], for the TFM")),
          key(&Column::given_size, "size", dimension::length, above(0, 1e3), Mark::required,
              help("width, height; in 3-D width, depth, height")),
          key(&Column::given_cells, "cells", range(1, 1e6), Mark::required,
              help("number of cells in each direction of size")),
          key(&Column::profile, "profile", dimension::length, above(0, 1e3), Mark::by_height,
              help("diameter of a round column in pairs [height, diameter] from 0 to its height, linear between; two "
                   "pairs at one height are a step; size has the largest diameter, or half of it")),
          key(&Column::grading, "grading", above(1, 1.2),
              help("height of a layer of cells over that of the one below it, above graded_above, at most: fewer and "
                   "larger cells in the freeboard; cells is then the number without grading")),
          key(&Column::graded_above, "graded_above", dimension::length, above(0, 1e3),
              help("height above which layers grow; the bed should stay below it")),
          key(&Column::grading_across, "grading_across", above(1, 1.2),
              help("width of a cell over that of its neighbour towards the nearer side wall, in a flat box of the TFM: "
                   "smaller cells at the walls, the same number; along width and depth")),
          key(&Column::depth, "depth", dimension::length, above(0, 1e3),
              help("of a 2-D column; default: twice the largest diameter and twice dem.skin")),
          key(&Column::sides, "sides", help("walls (fluid: no slip; solids: tfm.solids_wall), or joined")),
          key(&Column::ends, "ends",
              help("bottom and top; joined: a box in which what leaves at the top returns at the bottom")),
          key(&Column::pressure_gradient, "pressure_gradient", dimension::pressure_gradient, range(-1e9, 1e9),
              help("mean gradient of the net pressure along the height of a fluid between joined ends, negative for an "
                   "upward flow; weight: it carries the weight of all that is in the box"),
              equation("weight: dp/dy = -sum <phi_j> (rho_j - rho_f) g")),
          key(&Column::gravity, "gravity", dimension::acceleration, range(0, 1e3), help("acceleration of gravity")),
          key(&Column::gravity_direction, "gravity_direction", range(-1e6, 1e6),
              help("direction in the order of size, of any length; default: down; another one in the TFM needs walls, "
                   "and column.closed = true or inlet.at = \"top\"")),
          key(&Column::outlet, "outlet",
              help("top of the column: a screen stops solids; through an open one they leave and are counted; a lid "
                   "stops "
                   "the fluid, too, which leaves through a [[discharge]] with a pressure")),
          key(&Column::closed, "closed", help("walls all round: no inlet and no outlet")),
      });
}

Table fluid_table() {
  return table("fluid", &Scene::fluid,
               {
                   key(&Fluid::name, "name",
                       help("the properties of water and air follow from the temperature; any other fluid, also "
                            "without a name, needs both; none: dry particles, for the DEM only")),
                   key(&Fluid::temperature, "temperature", dimension::temperature, above(0, 5000),
                       help("water 0 to 40 degC, air 200 to 1000 K")),
                   key(&Fluid::density, "density", dimension::density, above(0, 1e5), help("rho_f")),
                   key(&Fluid::viscosity, "viscosity", dimension::viscosity, above(0, 1e6), help("mu")),
                   key(&Fluid::equation_of_state, "equation_of_state",
                       help("how density depends on pressure; a compressible fluid carries sound"),
                       equation("tait: P + B = (P_out + B)(rho/rho_0)^n; ideal_gas: P = rho R T, T fixed")),
                   key(&Fluid::outlet_pressure, "outlet_pressure", dimension::pressure, range(1, 1e9),
                       help("P_out, absolute, at the top of the column: a given density is at this pressure; the "
                            "density of air follows from it")),
                   key(&Fluid::tait_stiffness, "tait_stiffness", dimension::pressure, range(1, 1e13),
                       help("B of equation_of_state = tait"), equation("c^2 = n (P + B)/rho")),
               });
}

Table species_table() {
  return table(
      "species", &Scene::species,
      {
          key(&Species::name, "name", Mark::required, help("names columns and datasets")),
          key(&Species::diameter, "diameter", dimension::length, range(1e-8, 1), Mark::given,
              help("D_j; or give a distribution")),
          within(&Species::sizes, key(&SizeDistribution::kind, "distribution", Mark::replaced,
                                      help("of sizes by volume, instead of one diameter: becomes the species name.1, "
                                           "name.2, ... from fine to coarse, with its moments"),
                                      equation("sum x_j D_j^k = integral X D^k dD, k = -N ... N-1"))),
          within(&Species::sizes, key(&SizeDistribution::median, "median", dimension::length, range(1e-8, 1),
                                      Mark::replaced, help("lognormal: half of the volume is finer"))),
          within(&Species::sizes, key(&SizeDistribution::mean, "mean", dimension::length, range(1e-8, 1),
                                      Mark::replaced, help("lognormal: mean diameter by volume, instead of the median"),
                                      equation("mean = median exp(deviation^2/2)"))),
          within(&Species::sizes, key(&SizeDistribution::deviation, "deviation", above(0, 1), Mark::replaced,
                                      help("lognormal: standard deviation of ln D"))),
          within(&Species::sizes, key(&SizeDistribution::sieves, "sieves", range(0, 1), Mark::by_size, Mark::replaced,
                                      help("[[opening, share of the volume retained on it], ...]: openings rise, the "
                                           "last retains nothing, shares sum to 1"))),
          within(&Species::sizes, key(&SizeDistribution::classes, "classes", range(1, 10), Mark::replaced,
                                      help("N: number of species that represent the distribution"))),
          key(&Species::density, "density", dimension::density, range(1e-3, 1e16), Mark::required, help("rho_j")),
          key(&Species::sphericity, "sphericity", range(0.2, 1),
              help("surface of the equal-volume sphere over the particle's: below 1 effects.shape raises the drag; all "
                   "else is that of a sphere")),
          key(&Species::max_packing, "max_packing", range(0.3, 0.9),
              help("P_j: random packing of this species alone, for tfm.max_packing = fedors_landel, yu_standish")),
          key(&Species::youngs_modulus, "youngs_modulus", dimension::pressure, above(0, 1e13),
              help("else that of [dem]")),
          key(&Species::poisson_ratio, "poisson_ratio", range(0, 0.5), help("else that of [dem]")),
          key(&Species::given_friction, "friction", range(0, 10), help("else that of [dem]")),
          key(&Species::given_restitution, "restitution", above(0, 1), help("else that of [dem]")),
      });
}

Table bed_table() {
  return table(
      "bed", &Scene::bed,
      {
          key(&Bed::volume_share, "volume_share", range(0, 1),
              help("x_j, share of each species in the volume of the solids; sums to 1")),
          key(&Bed::static_height, "static_height", dimension::length, range(0, 1e3), Mark::given,
              help("of the settled bed; 0: fluid alone; [[layer]] replaces it and volume_share")),
          key(&Bed::solids_fraction, "solids_fraction", above(0, 0.9), Mark::given,
              help("of the settled bed, and of each [[layer]] without its own")),
          key(&Bed::start_fraction, "start_solids_fraction", above(0, 0.9),
              help("of the bed at the start, with the mass of the settled bed; default: solids_fraction. A [[layer]] "
                   "starts at most as dense as it settles")),
          key(&Bed::particles, "particles", range(0, 1e12),
              help("numbers of particles of each species, instead of volume_share and static_height")),
          key(&Bed::start, "start",
              help("layered: by [[layer]], else in the order of the species from the bottom, size classes together; "
                   "settled: in equilibrium; in the DEM also random: anywhere in the column, and list: one by one, SI, "
                   "columns species, x, y, z and if not zero vx, vy, vz, wx, wy, wz, y upward")),
          key(&Bed::layer, "layer", range(1, 15),
              help("of start = \"layered\": layer of each species, 1 at the bottom; species with one number are mixed; "
                   "default: a layer for each")),
          key(&Bed::seed, "seed", range(0, 9.2e18), help("of random numbers")),
          key(&Bed::perturbation, "perturbation", range(0, 0.1),
              help("random difference of the solids fractions of a mixed start from cell to cell, so that the bed can "
                   "break its symmetry; TFM; 0: none")),
      });
}

Table layer_table() {
  return table("layer", &Scene::layers,
               {
                   key(&Layer::species, "species", Mark::replaced,
                       help("the only species of this layer; all classes of a distribution, by their shares. Each "
                            "[[layer]] lies on those before it")),
                   key(&Layer::volume_share, "volume_share", range(0, 1),
                       help("x_j, share of each species in its solids, instead of species; sums to 1")),
                   key(&Layer::height, "height", dimension::length, above(0, 1e3), Mark::required,
                       help("of the settled layer; bed.start_solids_fraction makes it start higher")),
                   key(&Layer::solids_fraction, "solids_fraction", above(0, 0.9),
                       help("of the settled layer; default: bed.solids_fraction")),
                   key(&Layer::from, "from", dimension::length, range(0, 1e3),
                       help("low corner across: [x], in 3-D [x, z] (width, depth); default: the whole column")),
                   key(&Layer::to, "to", dimension::length, range(0, 1e3), help("high corner")),
               });
}

Table inlet_table() {
  return table("inlet", &Scene::inlet,
               {
                   key(&Inlet::superficial_velocity, "superficial_velocity", dimension::velocity, range(-1e3, 1e3),
                       help("a velocity, or a table [[time, velocity], ...]: linear between, constant beyond; two "
                            "equal times make a jump")),
                   key(&Inlet::flow_rate, "flow_rate", dimension::volume_rate, range(-1e4, 1e4),
                       help("instead of the velocity: through the whole bottom, a number or table likewise; in 2-D "
                            "with column.depth")),
                   key(&Inlet::at, "at",
                       help("bottom: even flow over the bottom, pressure given at the top; top: even flow over both "
                            "ends, for a fluid that enters there (velocity below 0)")),
               });
}

Table jet_table() {
  return table(
      "jet", &Scene::jets,
      {
          key(&Jet::at, "at", help("part of the bottom, or of a side: left is x = 0, front depth 0")),
          key(&Jet::from, "from", dimension::length, range(0, 1e3), Mark::required,
              help("low corner: of the bottom [x], in 3-D [x, z] (width, depth); of a side [y], in 3-D left and right "
                   "[z, y], front and back [x, y]")),
          key(&Jet::to, "to", dimension::length, range(0, 1e3), Mark::required, help("high corner")),
          key(&Jet::superficial_velocity, "superficial_velocity", dimension::velocity, range(-1e3, 1e3), Mark::required,
              help("over the jet's own area, into the column, on the bottom instead of the inlet's; a velocity or a "
                   "table as there")),
      });
}

Table feed_table() {
  return table(
      "feed", &Scene::feeds,
      {
          key(&Feed::species, "species", Mark::required,
              help("the species that is fed; all classes of a distribution, by their shares")),
          key(&Feed::at, "at", help("end or side of the column")),
          key(&Feed::superficial_velocity, "superficial_velocity", dimension::velocity, range(0, 1e3), Mark::required,
              help("volume of solids per area of the feed and time, into the column, added to the fluid of the inlet; "
                   "a velocity or a table as there")),
          key(&Feed::velocity, "velocity", dimension::velocity, above(0, 1e3), Mark::required,
              help("of the entering particles; superficial_velocity over it is their volume fraction, in the DEM at "
                   "most 0.35")),
          key(&Feed::from, "from", dimension::length, range(0, 1e3),
              help("low corner, as of a jet; default: all of the end or side")),
          key(&Feed::to, "to", dimension::length, range(0, 1e3), help("high corner")),
      });
}

Table discharge_table() {
  return table("discharge", &Scene::discharges,
               {
                   key(&Discharge::at, "at", Mark::required,
                       help("bottom or side through which fluid and solids leave together, as they are in the cells "
                            "next to it; in the DEM a hole with a sharp rim, also where nothing flows")),
                   key(&Discharge::superficial_velocity, "superficial_velocity", dimension::velocity, range(0, 1e3),
                       help("volume of the mixture per area of the discharge and time, out of the column; a velocity "
                            "or a table as of the inlet. What enters in excess leaves at the top, also with inlet.at = "
                            "\"top\". No effect without a fluid")),
                   key(&Discharge::pressure, "pressure", dimension::pressure, range(-1e8, 1e8),
                       help("instead of the velocity, in a side: outside, less the pressure of the fluid at rest that "
                            "stands up to the top; 0: an overflow into a vessel of clear fluid. The flow follows, and "
                            "fluid can come back, solids cannot")),
                   key(&Discharge::from, "from", dimension::length, range(0, 1e3),
                       help("low corner, as of a jet; default: all of the bottom or side")),
                   key(&Discharge::to, "to", dimension::length, range(0, 1e3), help("high corner")),
               });
}

Table wall_table() {
  return table(
      "wall", &Scene::walls,
      {
          key(&InnerWall::shape, "shape",
              help("of a wall inside the column. flat: as deep as the column; cone: about its upright axis, cut off "
                   "at both ends; cylinder: a cone of one diameter; rod: round and solid, as deep as the column")),
          key(&InnerWall::from, "from", dimension::length, range(0, 1e3), Mark::required,
              help("one end: [x, y] (width, height) of a flat wall, [diameter, height] of a cone or cylinder, both in "
                   "the middle of its thickness; or the centre of a rod")),
          key(&InnerWall::to, "to", dimension::length, range(0, 1e3), help("the other end; not of a rod")),
          key(&InnerWall::thickness, "thickness", dimension::length, range(0, 1e3),
              help("of the wall, with rounded edges, or diameter of a rod. Without it the wall is a sheet, which only "
                   "particles without a fluid meet. A fluid needs at least a cell in every direction across the wall; "
                   "an obstacle of three cells or more is resolved. The cells keep their open shares (see "
                   "theory/numerics.md): no slip for the fluid, free slip for solids of the TFM")),
      });
}

Table contact_pair_table() {
  return table(
      "contact_pair", &Scene::contact_pairs,
      {
          key(&ContactPair::between, "between", Mark::required, help("two species, or a species and \"wall\"")),
          key(&ContactPair::youngs_modulus, "youngs_modulus", dimension::pressure, above(0, 1e13),
              help("of both partners in this pair; default: each has its own, a wall that of [dem]")),
          key(&ContactPair::poisson_ratio, "poisson_ratio", range(0, 0.5),
              help("of both partners in this pair; default: as the modulus")),
          key(&ContactPair::friction, "friction", range(0, 10), help("of this pair; default: the mean of both")),
          key(&ContactPair::restitution, "restitution", above(0, 1), help("of this pair; default: the mean of both")),
      });
}

}  // namespace

std::vector<Table> bed_tables() {
  return {title_table(), column_table(), fluid_table(), species_table(), bed_table(), layer_table(), inlet_table()};
}

std::vector<Table> part_tables() {
  return {jet_table(), feed_table(), discharge_table(), wall_table(), contact_pair_table()};
}

}  // namespace polybed::core::schema
