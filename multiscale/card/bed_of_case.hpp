// Predictions for a bed from its case alone: minimum fluidisation, fall of its particles, height.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// State of a bed in the fluid; unknown: there is no flow, or no bed. Partly fluidised: jets lift the solids on their
/// path out of a bed that the rest of the flow leaves packed, as in a spouted bed.
enum class Fluidisation { unknown, packed, fluidised, carried_up, carried_out, partly_fluidised };

/// The state of solids that rise with the fluid: a screen at the top stops them, an open outlet does not.
[[nodiscard]] Fluidisation carried(const core::Scene& scene);
[[nodiscard]] bool is_carried(Fluidisation state);

/// The least velocity between bottom and top for a given one at the bottom: where the column is widest.
[[nodiscard]] double least_velocity(const core::Column& column, double velocity);

/// Name in run.json; empty if unknown.
[[nodiscard]] std::string name_of(Fluidisation state);

struct BedOfCase;

/// Whether solids are expected to leave over an open outlet.
[[nodiscard]] bool overflows(const core::Scene& scene, const BedOfCase& bed);

/// Behaviour of one species' particles in the fluid. Empty: they do not sink in it, or there is no fluid.
struct SpeciesInFluid {
  std::string name;
  std::optional<double> minimum_fluidisation;  ///< for a bed of this species alone, superficial, m/s
  std::optional<double> terminal;              ///< of a single falling particle, m/s
  std::optional<double> rising;                ///< of one lighter than the fluid, m/s
  std::string geldart;                         ///< A | B | C | D in a gas; else empty
};

/// Discharge through an opening in the bottom, from a correlation: closures/hopper_discharge.hpp.
struct ExpectedDischarge {
  double rate;       ///< kg/s; 0: the opening is too narrow for the correlation
  double mass;       ///< of all particles, kg
  double diameters;  ///< width of the opening over the mean diameter
  bool flat;         ///< the bottom around it is flat and keeps solids in its corners
  bool cone;         ///< a cone leads to it, for which the correlation is not made
};

/// Predictions of one drag law for the bed.
struct ByLaw {
  std::string law;                             ///< its name; empty: Wen and Yu's correlation
  std::optional<double> minimum_fluidisation;  ///< of the mixture, at its Sauter diameter and mean density, m/s
  std::optional<double> height;                ///< predicted for a uniform bed, or the sum of its layers, m
  std::optional<double> mixed = {};            ///< of a bed in layers, if they were mixed, m
};

/// The range of velocities at a bed expansion, from the laws derived from such beds.
struct ExpansionAt {
  double share;                    ///< increase in height over the settled height
  double least, most;              ///< superficial, m/s
  std::optional<double> own = {};  ///< by the law of the case, if it is one of them, m/s
};

/// The least time, s, until a bed can be steady, 0 for one that is from the start, and why; without a time why none is
/// foreseen.
struct FirstSteady {
  std::optional<double> least;
  std::string why;
};

/// A bed of several species that part into layers, each a bed of its own.
struct PartedBed {
  double height = 0;                 ///< m; infinite if the fluid carries up a species that is alone
  std::vector<std::string> leaving;  ///< species that reach the top of the column
};

/// A box with joined ends in a fluid: it has no bottom and no top.
struct JoinedBox {
  double fraction = 0;                                     ///< of the solids
  double gradient = 0;                                     ///< mean, of the net pressure, Pa/m
  bool by_weight = true;                                   ///< it carries the solids; else the case gives it
  std::vector<std::pair<std::string, double>> slips = {};  ///< of the fluid over each species while even, m/s; or none
  std::optional<double> superficial_slip = {};             ///< of the fluid over the mean of the solids, m/s
};

struct BedOfCase {
  std::optional<JoinedBox> joined;  ///< then only terminal velocities, law, masses and this are known
  std::vector<SpeciesInFluid> species;
  ByLaw own;                  ///< from the law of the case
  std::vector<ByLaw> others;  ///< from laws derived from such beds
  std::vector<ByLaw> shapes;  ///< from the law of the case with each other formula of the shape
  /// The species that fluidise first and last by themselves, with at least 5 % between them.
  std::optional<SpeciesInFluid> first, last;
  std::vector<std::pair<double, double>> by_packing;   ///< u_mf of the mixture at other settled solids fractions, m/s
  std::vector<std::pair<std::string, double>> masses;  ///< kg at the start; size classes count as one
  double area = 0;                                     ///< m2, of the inlet of a case that gives its flow rate
  std::optional<double> assumed_depth;                 ///< m, of a column in two dimensions without column.depth
  std::optional<double> velocity;                      ///< superficial, mean over the bottom at the end of the run, m/s
  std::optional<double> inlet;                         ///< of a case with jets: the inlet's own at that time, m/s
  double settled = 0;                                  ///< m, height of the settled bed, higher between walls inside
  std::optional<double> lift;         ///< Pa, pressure drop expected, fluidised, where the cross-section changes
  std::optional<double> packed_drop;  ///< Pa, pressure drop of the packed bed, by the law of the case
  Fluidisation state{};               ///< predicted
  std::size_t resting = 0;            ///< layers of a fluidised bed that are still packed
  bool turns_over = false;            ///< an upper layer has a greater bulk density than the one below it
  bool top_heavy = false;             ///< it is wider, and therefore denser, at its top than at the bottom
  std::vector<std::string> leaving;   ///< species that the fluid lifts out of a bed of the others
  std::optional<PartedBed> parted;    ///< of species mixed in a liquid whose own beds differ in bulk density
  bool no_balance = false;            ///< fluidised, but by the law of the case the fluid carries the solids up
  std::vector<std::pair<std::size_t, double>> discharges;  ///< in the sides, reached by the bed: number, lower edge, m
  std::vector<ExpansionAt> expansion;          ///< of a bed in a liquid, as far as the height of the column allows
  FirstSteady steady;                          ///< of a bed in a flow
  std::optional<ExpectedDischarge> discharge;  ///< of dry particles with dem.opening
  std::string validity;                        ///< agreement of the models with measured beds of this kind
  [[nodiscard]] std::optional<double> velocity_ratio() const;
};

/// From the balance of the case's drag law with the buoyant weight, at the voidage of the settled bed; without a drag
/// law or that voidage from Wen and Yu's correlation (closures/minimum_fluidisation.hpp). Terminal velocities after
/// Schiller and Naumann. The height is for the species that stay; layers across the whole column of one cross-section
/// stay apart, and their heights add up. Runs nothing. Throws core::CaseError for an unknown fluid.
[[nodiscard]] BedOfCase bed_of_case(const core::Scene& scene);

/// Geldart's class (Powder Technology 7 (1973) 285) by his lines, rho_s - rho_f in g/cm3 and d in um: D above (rho_s -
/// rho_f) d^2 = 1e6, A below (rho_s - rho_f) d = 225, B between. He gives no formula for C: below 30 um, as on his
/// chart for sand. \param diameter  m  \param excess  rho_s - rho_f, kg/m3
[[nodiscard]] std::string geldart_class(double diameter, double excess);

}  // namespace polybed::multiscale
