// Quantities of interest of a bed, from its vertical profile: one definition for both models and for the comparison.
#pragma once

#include <optional>

#include "measures/profile.hpp"

namespace polybed::measures {

/// z_q: height, m, below which the share q of the solids volume lies; linear within a slab. Empty for an empty bed.
[[nodiscard]] std::optional<double> volume_quantile(const Profile& profile, double q);

/// Highest z, m, where phi, linear between slab centres, equals half of phi_top, the volume-weighted mean of
/// phi between z_0.80 and z_0.95 (so a dense lower layer does not decide). Empty for an empty bed.
[[nodiscard]] std::optional<double> bed_height(const Profile& profile);

/// The same for half of the mean of phi below z_0.50: the top of the dense bed, where bed_height counts what is
/// suspended above it once that is a good part of the solids. Empty for an empty bed.
[[nodiscard]] std::optional<double> dense_height(const Profile& profile);

/// Several species as one; without the pressure.
[[nodiscard]] Profile merged(const Profile& profile, std::span<const std::size_t> species);

/// Where two straight lines through the net pressure cross, m, as experiments report a bed's height: one by least
/// squares over the slabs with centres between z_0.10 and z_0.80, one over those above 1.1 bed_height. Empty where one
/// of them has fewer than two slabs, or where they do not cross in the column.
[[nodiscard]] std::optional<double> bed_height_by_pressure(const Profile& profile);

/// Height, m, of the centre of volume of a species; empty if there is none of it.
[[nodiscard]] std::optional<double> centre(const Profile& profile, std::size_t species);

/// Centre of species 2 less that of species 1, over the bed height; empty for one species.
[[nodiscard]] std::optional<double> centre_difference(const Profile& profile);

/// Top, m, of the lower layer of the thesis: the profile is cut from below into 50 slices of equal solids
/// volume; slices are dropped from below while the next one differs from them by more than `tolerance` in the
/// share of any species; the interface is the top of the last slice whose shares are within `tolerance` of
/// those accumulated from the first kept slice, but no higher than the bed: the uppermost slices hold what drifts above
/// it, up to the last trace in the freeboard. Empty for one species or where nothing is alike.
[[nodiscard]] std::optional<double> interface_height(const Profile& profile, double tolerance = 0.05);

/// 1 - mean over the 50 slices of (x - x_mean)^2 / (x_mean (1 - x_mean)), mean over species: 1 mixed, 0 separated.
[[nodiscard]] std::optional<double> mixing(const Profile& profile);

/// Integral over z of |phi_j - phi_j,ref| over that of phi_j,ref; 0 alike, 2 nowhere together. Empty if the reference
/// has none of the species. Throws std::invalid_argument for other slabs.
[[nodiscard]] std::optional<double> profile_distance(const Profile& profile, const Profile& reference,
                                                     std::size_t species);

/// Mean of it over the species that the reference has; empty if it has none.
[[nodiscard]] std::optional<double> profile_distance(const Profile& profile, const Profile& reference);

/// How differently two beds are layered: half the sum over the species of the integral of |x_j - x_j,ref| over h, the
/// share of the solids volume counted from below, 0 to 1; of two species the integral of |x_2 - x_2,ref|. By the 50
/// slices of equal solids volume, so a difference within a slice does not count. Empty for one species or an empty bed.
[[nodiscard]] std::optional<double> composition_distance(const Profile& profile, const Profile& reference);

/// Net pressure at the bottom less that at the top, Pa: linear continuation of the outermost two slabs.
[[nodiscard]] double pressure_drop(const Profile& profile);

}  // namespace polybed::measures
