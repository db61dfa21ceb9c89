// The file of a table of the solids stress: what sheared boxes of particles have measured, over closed forms.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "closures/stress_ratios.hpp"
#include "closures/stress_reference.hpp"
#include "core/case/scene.hpp"

namespace polybed::tfm {

/// A ratio at every point of the table, its standard error, and how many seeds it is the mean of.
struct TableQuantity {
  std::vector<double> value, error, seeds;  ///< [phi][stokes][restitution][friction][share]
};

/// Name of kinetic theory at closures::effective_restitution.
inline const std::string effective_reference = "GD-CS e_eff";

/// p_bed of a fluidised bed over the solids fraction; empty of a table that has none.
struct BedPressure {
  std::vector<double> phi, pressure, error;  ///< error: one standard error, or empty
};

struct SolidsTable {
  core::BoxRegime regime = core::BoxRegime::dry;                  ///< dry | wet
  std::string reference;                                          ///< GD-CS | GD-CS e_eff | viscous
  std::vector<double> phi, stokes, restitution, friction, share;  ///< axes; stokes of a dry table: 0
  TableQuantity pressure, viscosity, dissipation, temperature;    ///< temperature: T_2/T_1
  TableQuantity exchange;            ///< beta_12 of two species over species_exchange_kinetic.hpp; empty if not in it
  double exchange_drift = 0;         ///< |U_1 - U_2|/sqrt(theta) up to which all of it was measured
  std::vector<double> shear_number;  ///< S = gamma d/sqrt(theta) at every point
  BedPressure bed;
  double inertia = 0;     ///< lambda of the viscous form
  double size_ratio = 1;  ///< of the two species, if share is an axis
  double residual = 0;    ///< as left_out, beyond two standard errors
  double left_out = 0;    ///< greatest error of p and mu where a solids fraction is left out of the fit
  std::string case_hash, created, git_commit;

  /// Restitution at which the reference of a dry table is taken: that of smooth spheres that lose as much as rough
  /// ones, but in files written before it was ("GD-CS").
  [[nodiscard]] double reference_restitution(double restitution, double friction) const {
    return reference == effective_reference ? closures::effective_restitution(restitution, friction) : restitution;
  }
  [[nodiscard]] std::size_t size() const {
    return phi.size() * stokes.size() * restitution.size() * friction.size() * share.size();
  }
  /// Whether its boxes held both species of a bed, not one that stands for all.
  [[nodiscard]] bool of_two_species() const { return size_ratio != 1 || share.size() > 1 || share.front() > 0; }
  [[nodiscard]] std::size_t index(std::size_t p, std::size_t s, std::size_t e, std::size_t m, std::size_t x) const {
    return (((p * stokes.size() + s) * restitution.size() + e) * friction.size() + m) * share.size() + x;
  }
};

/// Where in a table a scene lies, other than phi and the Stokes number, and by how many standard errors it is moved.
struct TablePlace {
  double restitution = 0, friction = 0, share = 0, sigma = 0;
  double size_ratio = 1;  ///< D_2/D_1 of two species
};

/// Of a scene: restitution and friction are the means of its species by volume over the bed, as is the density of the
/// one sphere that stands for all of them. So a species cut in two changes nothing, nor does one of which there is
/// hardly any, as they would by a plain mean over the species; and boxes whose only knot is this mean are hit.
[[nodiscard]] TablePlace place_of(const core::Scene& scene);

/// The ratios at a place: linear in restitution, friction and share, the edges held. Throws std::invalid_argument for
/// axes that do not rise.
[[nodiscard]] closures::StressRatios ratios_at(const SolidsTable& table, const TablePlace& place);

/// beta_12 over its closed form along phi, at a place as the ratios. Throws std::invalid_argument for axes that do not
/// rise, or a table without it.
[[nodiscard]] closures::MonotoneCurve exchange_at(const SolidsTable& table, const TablePlace& place);

/// Where a place lies outside the axes of a table, whose edge is then held, or is of other sizes; a line each, empty
/// if nowhere. Equal is what differs by less than 1e-9, the rounding of a mean.
[[nodiscard]] std::vector<std::string> beyond(const SolidsTable& table, const TablePlace& place);

/// Regime of a file of type "polybed solids table": dry, wet or bed. Throws core::FileError.
[[nodiscard]] core::BoxRegime regime_of_table(const std::filesystem::path& path);

/// One line for a table that carries no checksum, as those of earlier versions do not; empty of one that does. Throws
/// core::FileError.
[[nodiscard]] std::string missing_checksum(const std::filesystem::path& path);

void write_solids_table(const std::filesystem::path& path, const SolidsTable& table);
/// Throws core::FileError if it is another file, damaged, or of regime "bed", and for numbers that cannot be.
[[nodiscard]] SolidsTable read_solids_table(const std::filesystem::path& path);
/// Of a table of regime "bed". Throws core::FileError likewise.
[[nodiscard]] BedPressure read_bed_table(const std::filesystem::path& path);

}  // namespace polybed::tfm
