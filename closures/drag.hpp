// The menu of drag laws: variants, visited once per batch, so that the chosen law is inlined in the loop.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "closures/drag_batchelor.hpp"
#include "closures/drag_brinkman_oseen.hpp"
#include "closures/drag_carman_kozeny.hpp"
#include "closures/drag_di_felice.hpp"
#include "closures/drag_fand.hpp"
#include "closures/drag_hkl.hpp"
#include "closures/drag_richardson_zaki.hpp"
#include "closures/drag_stokes.hpp"
#include "closures/mixture_laws.hpp"
#include "closures/shape_factor.hpp"

namespace polybed::closures {

/// Every mixture law by name, and the forms with constants from a file, in the order of the displayed lists.
using MixtureLaw =
    std::variant<EachSpecies<DragStokes>, EachSpecies<DragTurtonLevenspiel>, EachSpecies<DragSchillerNaumann>,
                 EachSpecies<DragDallavalle>, EachSpecies<DragCarmanKozeny>, EachSpecies<DragErgun>,
                 EachSpecies<DragFand>, EachSpecies<DragWenYu>, EachSpecies<DragDiFelice>, EachSpecies<DragBatchelor>,
                 EachSpecies<DragRichardsonZaki>, EachSpecies<DragGidaspow>, EachSpecies<DragHkl>, EachSpecies<DragVbk>,
                 MixtureVbkTheory, MixtureVbkCorrected, MixtureCello, MixtureBrinkmanOseen, MixtureYinSundaresan,
                 MixturePatwardhanTien, MixtureSyamlal, MixtureFittedCello, MixtureFittedBrinkmanOseen>;

/// Distribution of a mean drag among species: f_j = f_mean(eps, Re_m) f_j^part/f_one^part(eps, Re_m), with f_one^part
/// the partition's own law of one size and Re_m = rho_f u_j D_mean/mu with the particle's own slip. Partitions that are
/// a factor Omega_j for any mean use a base law of 1.
using Partition = std::variant<CelloShares<DragStokes>, VbkTheoryShares<DragStokes>, VbkCorrectedShares<DragStokes>,
                               MixtureYinSundaresan, MixtureBrinkmanOseen>;

/// The least and the greatest voidage and Reynolds number of the rows that a law was fitted to; Re is of the Sauter
/// diameter and the superficial slip velocity.
struct FittedRange {
  double least_voidage, most_voidage, least_reynolds, most_reynolds;

  [[nodiscard]] bool contains(double voidage, double reynolds) const {
    return voidage >= least_voidage && voidage <= most_voidage && reynolds >= least_reynolds &&
           reynolds <= most_reynolds;
  }
};

/// A mixture law, or its base law as the mean of a partition.
struct DragLaw {
  MixtureLaw law;
  std::optional<Partition> partition = {};
  /// Modification for studies of the law's uncertainty: f_j is multiplied by common [1 + tilt (y_j - 1)]. The tilt
  /// changes only the ratio between species: if f_j is proportional to y_j, sum x_j f_j/y_j^2 is unchanged.
  double common = 1, tilt = 0;
  /// The factors of non-spherical particles, on f_j of each species and on the base law of one size; none: all
  /// are spheres.
  std::optional<BedShape> shape = {};
  /// Replaces the range of the form in the count of evaluations outside the range.
  std::optional<FittedRange> fitted_to = {};

  [[nodiscard]] bool is_moved() const { return common != 1 || tilt != 0; }
  /// The factor of a species; above 0 for any y_j.
  [[nodiscard]] double moved(double y) const { return common * std::max(1 + tilt * (y - 1), least_tilted); }
  static constexpr double least_tilted = 0.1;

  /// The law for a bed of one species: its base law has the shape factor of that species.
  [[nodiscard]] DragLaw alone(std::size_t species) const {
    DragLaw law = *this;
    if (law.shape) law.shape->mean = law.shape->species[species];
    return law;
  }
};

/// The law with a name, with or without its guard; throws std::invalid_argument for an unknown name.
[[nodiscard]] DragLaw drag_law(std::string_view name, Guard guard);

/// A law of one size as the mean of a partition; "none" is the law alone. If a mixture law consists of this pair,
/// returns that law. Throws std::invalid_argument for an unknown name and for a law that is not a mean.
[[nodiscard]] DragLaw drag_law(std::string_view name, std::string_view partition, Guard guard);

/// The law with a named partition; "none" is the law alone. Throws std::invalid_argument for an unknown name and for a
/// law that is not a mean. \param name  of the law
[[nodiscard]] DragLaw shared_by(const DragLaw& law, std::string_view name, std::string_view partition, Guard guard);

struct DragLawInfo {
  std::string name, help, source;
  bool obeys_sum_rule;
  bool is_mean;  ///< a law of one size, which a partition can distribute
};
[[nodiscard]] std::vector<DragLawInfo> drag_laws();
[[nodiscard]] std::vector<std::string> drag_law_names();

/// Help and source describe how it distributes; obeys_sum_rule: with any mean law.
[[nodiscard]] std::vector<DragLawInfo> partitions();

/// The base law at points: f and Re df/dRe for one size. All spans have one length; evaluations, and those outside the
/// range, are added to `count`.
void drag_of_points(const DragLaw& law, std::span<const double> voidage, std::span<const double> reynolds,
                    std::span<double> f, std::span<double> re_dfdre, GuardCount& count);

/// The base law at one point: pure drag over Stokes for one size.
[[nodiscard]] double pure_drag_at(const DragLaw& law, double voidage, double reynolds);

/// One cell with a mixture: f_j and Re df_j/dRe for every species.
/// \param slip  superficial slip speed eps |U_f - U_j|, m/s, [species]
void drag_of_mixture(const DragLaw& law, double voidage, std::span<const double> share,
                     std::span<const double> diameter, std::span<const double> slip, double fluid_density,
                     double viscosity, std::span<double> f, std::span<double> re_dfdre);

/// f_mean of a mixture whose species have the drag f at a common slip: the base law, or mean law, at the Sauter
/// diameter if the law or partition is based on it, else sum x_j f_j / y_j^2, T(3.45).
/// \param reynolds  from the Sauter diameter and the superficial slip velocity
[[nodiscard]] double drag_of_mean(const DragLaw& law, double voidage, double reynolds, std::span<const double> share,
                                  std::span<const double> diameter, std::span<const double> f);

/// sum x_j f_j / y_j^2 over the base law at the Sauter diameter, minus 1: relative difference of the mixture's drag,
/// and so of the pressure drop, from the law of one size. Arguments as above.
[[nodiscard]] double deviation_from_base(const DragLaw& law, double voidage, double reynolds,
                                         std::span<const double> share, std::span<const double> diameter,
                                         std::span<const double> f);

/// Many cells: f_j[cell] for every species, no allocation.
/// \param voidage  [cell]  \param share, slip, f  [species], pointers to [cell]  \param diameter  [species], m
void drag_of_cells(const DragLaw& law, std::span<const double> voidage, std::span<const double* const> share,
                   std::span<const double* const> slip, std::span<const double> diameter, double fluid_density,
                   double viscosity, std::span<double* const> f, GuardCount& count);

/// Whether the law needs more than the two mean diameters of a mixture.
[[nodiscard]] bool needs_per_square(const DragLaw& law);

/// Many particles, each in a mixture of its own: f[particle] of the particle's own species, no allocation, without its
/// shape. All spans of one length.
/// \param per_mean  sum x_j / D_j around the particle, 1/m  \param average  sum x_j D_j around it, m
/// \param per_square  sum x_j / D_j^2 around it, 1/m2; may be empty unless needs_per_square(law)
/// \param largest  the greatest diameter of the scene, that of an absent species too, m
/// \param share  x of the particle's own species around it  \param diameter  of the particle, m
/// \param slip  superficial slip speed eps |U_f - U_p|, m/s
void drag_of_particles(const DragLaw& law, std::span<const double> voidage, std::span<const double> per_mean,
                       std::span<const double> average, std::span<const double> per_square, double largest,
                       std::span<const double> share, std::span<const double> diameter, std::span<const double> slip,
                       double fluid_density, double viscosity, std::span<double> f, GuardCount& count);

}  // namespace polybed::closures
