// What follows for a bed from its case alone: when it is fluidised, how fast its particles fall, how high it stands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// What the fluid does to a bed; unknown: there is no flow, or no bed.
enum class Fluidisation { unknown, packed, fluidised, carried_up, carried_out };

/// What becomes of solids that rise with the fluid: a screen at the top holds them, an open outlet lets them out.
[[nodiscard]] Fluidisation carried(const core::Scene& scene);
[[nodiscard]] bool is_carried(Fluidisation state);

/// Of the velocities between bottom and top that one at the bottom gives: where the column is widest.
[[nodiscard]] double least_velocity(const core::Column& column, double velocity);

/// As run.json has it; empty if unknown.
[[nodiscard]] std::string name_of(Fluidisation state);

/// How a particle of one species behaves in the fluid. Empty: it does not sink in the fluid, or there is none.
struct SpeciesInFluid {
  std::string name;
  std::optional<double> minimum_fluidisation;  ///< of a bed of this species alone, superficial, m/s
  std::optional<double> terminal;              ///< of a single particle that falls, m/s
  std::optional<double> rising;                ///< of one that is lighter than the fluid, m/s
  std::string geldart;                         ///< A | B | C | D in a gas; else empty
};

/// Out of an opening in the bottom, by correlation: closures/hopper_discharge.hpp.
struct ExpectedDischarge {
  double rate;       ///< kg/s; 0: the opening is too narrow for the correlation
  double mass;       ///< of all particles, kg
  double diameters;  ///< width of the opening over the mean diameter
  bool flat;         ///< the bottom round it: it keeps what lies in its corners
};

/// What one drag law makes of the bed.
struct ByLaw {
  std::string law;                             ///< its name; empty: Wen and Yu's correlation
  std::optional<double> minimum_fluidisation;  ///< of the mixture, at its Sauter diameter and mean density, m/s
  std::optional<double> height;                ///< expected of a uniform bed, m
};

/// The velocities at which a bed has expanded so far, by the laws that were made from such beds.
struct ExpansionAt {
  double share;        ///< of the settled height that the bed is higher
  double least, most;  ///< superficial, m/s
};

struct BedOfCase {
  std::vector<SpeciesInFluid> species;
  ByLaw own;                                   ///< by the law of the case
  std::vector<ByLaw> others;                   ///< by laws that were made from such beds
  std::optional<double> velocity;              ///< superficial, mean over the bottom at the end of the run, m/s
  Fluidisation state{};                        ///< expected
  std::vector<std::string> leaving;            ///< species that the fluid lifts out of the bed of the others
  std::vector<ExpansionAt> expansion;          ///< of a bed in a liquid, as far as the column is high enough
  std::optional<double> rising_time;           ///< s, in which the top of a packed bed gets there in a liquid at least
  std::optional<ExpectedDischarge> discharge;  ///< of dry particles over dem.opening
  std::string validity;                        ///< how far the models agree with measured beds of this kind
  [[nodiscard]] std::optional<double> velocity_ratio() const;
};

/// By the balance of the case's drag law with the buoyant weight, at the voidage of the settled bed; without a drag law
/// or without that voidage by Wen and Yu's correlation (closures/minimum_fluidisation.hpp). Terminal velocities after
/// Schiller and Naumann. The height is that of the species which stay. Nothing is run. Throws core::CaseError for a
/// fluid that is not known.
[[nodiscard]] BedOfCase bed_of_case(const core::Scene& scene);

/// Height of the settled bed, m; of layers the top of the highest, each at its own solids fraction.
[[nodiscard]] double settled_height(const core::Scene& scene);

/// Geldart's class (Powder Technology 7 (1973) 285) by his lines, rho_s - rho_f in g/cm3 and d in um: D above
/// (rho_s - rho_f) d^2 = 1e6, A below (rho_s - rho_f) d = 225, B between. C is not a formula there: below 30 um, where
/// his chart has its line for sand. \param diameter  m  \param excess  rho_s - rho_f, kg/m3
[[nodiscard]] std::string geldart_class(double diameter, double excess);

}  // namespace polybed::multiscale
