// The file of a solids stress table: measurements in sheared boxes of particles, over closed forms.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "closures/stress_ratios.hpp"
#include "closures/stress_reference.hpp"
#include "core/case/scene.hpp"

namespace polybed::tfm {

/// A ratio at every point of the table, its standard error, and the number of seeds in its mean.
struct TableQuantity {
  std::vector<double> value, error, seeds;  ///< [phi][stokes][restitution][friction][share]
};

/// Name of kinetic theory at closures::effective_restitution.
inline const std::string effective_reference = "GD-CS e_eff";

/// p_bed in a fluidised bed over the solids fraction; empty if a table has none.
struct BedPressure {
  std::vector<double> phi, pressure, error;  ///< error: one standard error, or empty
};

struct SolidsTable {
  core::BoxRegime regime = core::BoxRegime::dry;                  ///< dry | wet
  std::string reference;                                          ///< GD-CS | GD-CS e_eff | viscous
  std::vector<double> phi, stokes, restitution, friction, share;  ///< axes; stokes of a dry table: 0
  TableQuantity pressure, viscosity, dissipation, temperature;    ///< temperature: T_2/T_1
  TableQuantity exchange;            ///< beta_12 of two species over species_exchange_kinetic.hpp; empty if absent
  double exchange_drift = 0;         ///< largest |U_1 - U_2|/sqrt(theta) in all its measurements
  std::vector<double> shear_number;  ///< S = gamma d/sqrt(theta) at every point
  BedPressure bed;
  double inertia = 0;     ///< lambda in the viscous form
  double size_ratio = 1;  ///< of the two species, if share is an axis
  double residual = 0;    ///< as left_out, beyond two standard errors
  double left_out = 0;    ///< greatest error of p and mu if a solids fraction is left out of the fit
  std::string case_hash, created, git_commit;

  /// Restitution in the reference of a dry table: for smooth spheres with the same losses as rough ones, except in
  /// older files ("GD-CS").
  [[nodiscard]] double reference_restitution(double restitution, double friction) const {
    return reference == effective_reference ? closures::effective_restitution(restitution, friction) : restitution;
  }
  [[nodiscard]] std::size_t size() const {
    return phi.size() * stokes.size() * restitution.size() * friction.size() * share.size();
  }
  /// Whether its boxes contained both species of a bed, instead of one for all.
  [[nodiscard]] bool of_two_species() const { return size_ratio != 1 || share.size() > 1 || share.front() > 0; }
  [[nodiscard]] std::size_t index(std::size_t p, std::size_t s, std::size_t e, std::size_t m, std::size_t x) const {
    return (((p * stokes.size() + s) * restitution.size() + e) * friction.size() + m) * share.size() + x;
  }
};

/// Position of a scene in a table, except phi and the Stokes number, and the shift in standard errors.
struct TablePlace {
  double restitution = 0, friction = 0, share = 0, sigma = 0;
  double size_ratio = 1;  ///< D_2/D_1 for two species
};

/// For a scene: restitution and friction are the means over its species, by volume in the bed, as is the density of the
/// one sphere that represents them. Splitting a species or adding a trace of one then changes nothing, unlike with a
/// plain mean over the species, and boxes whose only knot is this mean match exactly.
[[nodiscard]] TablePlace place_of(const core::Scene& scene);

/// The ratios at a place: linear in restitution, friction and share, constant outside. Throws std::invalid_argument for
/// axes that do not increase.
[[nodiscard]] closures::StressRatios ratios_at(const SolidsTable& table, const TablePlace& place);

/// beta_12 over its closed form along phi, at a place like the ratios. Throws std::invalid_argument for axes that do
/// not increase, or a table without it.
[[nodiscard]] closures::MonotoneCurve exchange_at(const SolidsTable& table, const TablePlace& place);

/// The axes of a table that a place lies outside, whose edge is then used, or its different sizes; a line each, empty
/// if there are none. Values that differ by less than 1e-9, the rounding of a mean, are equal.
[[nodiscard]] std::vector<std::string> beyond(const SolidsTable& table, const TablePlace& place);

/// Regime of a file of type "polybed solids table": dry, wet or bed. Throws core::FileError.
[[nodiscard]] core::BoxRegime regime_of_table(const std::filesystem::path& path);

/// One line for a table without a checksum, as from earlier versions; empty for one with a checksum. Throws
/// core::FileError.
[[nodiscard]] std::string missing_checksum(const std::filesystem::path& path);

void write_solids_table(const std::filesystem::path& path, const SolidsTable& table);
/// Throws core::FileError if it is another file, damaged, or of regime "bed", and for impossible numbers.
[[nodiscard]] SolidsTable read_solids_table(const std::filesystem::path& path);
/// For a table of regime "bed". Throws core::FileError likewise.
[[nodiscard]] BedPressure read_bed_table(const std::filesystem::path& path);

}  // namespace polybed::tfm
