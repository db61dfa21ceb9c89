// Measures of a bed from its vertical profile, defined once for both models and for the comparison.
#pragma once

#include <optional>

#include "measures/profile.hpp"

namespace polybed::measures {

/// z_q: height, m, below which the share q of the solids volume lies; linear within a slab. Empty for an empty bed.
[[nodiscard]] std::optional<double> volume_quantile(const Profile& profile, double q);

/// Highest z, m, where phi, linear between slab centres, equals half of phi_top, the volume-weighted mean of
/// phi between z_0.80 and z_0.95, so that a dense lower layer does not matter. Empty for an empty bed.
[[nodiscard]] std::optional<double> bed_height(const Profile& profile);

/// The same for half of the mean of phi below z_0.50: the top of the dense bed. bed_height instead includes solids
/// suspended above it if they are a good part of all. Empty for an empty bed.
[[nodiscard]] std::optional<double> dense_height(const Profile& profile);

/// Combines several species into one; without the pressure.
[[nodiscard]] Profile merged(const Profile& profile, std::span<const std::size_t> species);

/// Height, m, where two straight lines through the net pressure cross, as experiments report a bed's height: a least
/// squares fit to slabs with centres between z_0.10 and z_0.80, and one to those above 1.1 bed_height. Empty if one fit
/// has fewer than two slabs, if the lines do not cross in the column, or if the species are apart (mixing below
/// 0.5) and the line of the bed misses its pressure by more than 2 % of the drop in the root mean square.
[[nodiscard]] std::optional<double> bed_height_by_pressure(const Profile& profile);

/// Height, m, of the centre of volume of a species; empty if the species is absent.
[[nodiscard]] std::optional<double> centre(const Profile& profile, std::size_t species);

/// Centre of species 2 minus centre of species 1, over the bed height; empty for one species.
[[nodiscard]] std::optional<double> centre_difference(const Profile& profile);

/// Height, m, between two layers: the cut below which the part of a species, F_j, and of all others differ most (the
/// greatest distance of two distributions, as Kolmogorov and Smirnov measure it), for any shares. Between the centres
/// of the two slabs at the cut it is where the share, linear there, is the mean of the layers' shares. One layer, with
/// a difference below 0.05, ends at the bed height, which is the most. Empty for one species.
[[nodiscard]] std::optional<double> interface_height(const Profile& profile);

/// 1 - 2 integral |F_i - F_j| dh, mean over pairs of species. F is the part of a species below a height and h the part
/// of the pair. The integral is 1/2 for two layers whatever their volumes: as Goldschmidt et al. (Powder Technology 138
/// (2003) 135) relate a segregation to the complete one. 1 mixed, 0 separated. Empty without a pair.
[[nodiscard]] std::optional<double> mixing(const Profile& profile);

/// Integral over z of |phi_j - phi_j,ref| over the integral of phi_j,ref; 0 alike, 2 nowhere together. Empty if the
/// reference lacks the species. Throws std::invalid_argument for different slabs.
[[nodiscard]] std::optional<double> profile_distance(const Profile& profile, const Profile& reference,
                                                     std::size_t species);

/// Mean over the species in the reference; empty if it has none.
[[nodiscard]] std::optional<double> profile_distance(const Profile& profile, const Profile& reference);

/// Difference in layering between two beds: half the sum over the species of the integral of |x_j - x_j,ref| over h,
/// the share of the solids volume counted from below, 0 to 1; for two species the integral of |x_2 - x_2,ref|. Uses 50
/// slices of equal solids volume: differences within a slice do not count. Empty for one species or an empty bed.
[[nodiscard]] std::optional<double> composition_distance(const Profile& profile, const Profile& reference);

/// Net pressure at the bottom minus the top, Pa: linear extrapolation from the outermost two slabs.
[[nodiscard]] double pressure_drop(const Profile& profile);

}  // namespace polybed::measures
