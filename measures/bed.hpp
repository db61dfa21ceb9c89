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
/// has fewer than two slabs, or if the lines do not cross in the column.
[[nodiscard]] std::optional<double> bed_height_by_pressure(const Profile& profile);

/// Height, m, of the centre of volume of a species; empty if the species is absent.
[[nodiscard]] std::optional<double> centre(const Profile& profile, std::size_t species);

/// Centre of species 2 minus centre of species 1, over the bed height; empty for one species.
[[nodiscard]] std::optional<double> centre_difference(const Profile& profile);

/// Top, m, of the lower layer as in the thesis. The profile is cut from below into 50 slices of equal solids volume.
/// Slices are dropped from below while the next one differs from them by more than `tolerance` in the share of any
/// species. The interface is the top of the last slice whose shares are within `tolerance` of those accumulated from
/// the first kept slice, but at most the bed height: the uppermost slices contain solids above the bed, up to the last
/// trace in the freeboard. Empty for one species, or if no two slices are alike.
[[nodiscard]] std::optional<double> interface_height(const Profile& profile, double tolerance = 0.05);

/// 1 - mean over the 50 slices of (x - x_mean)^2 / (x_mean (1 - x_mean)), mean over species: 1 mixed, 0 separated.
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
