// Lateral averages of a bed on its vertical axis, from which both models compute their measures.
#pragma once

#include <span>
#include <vector>

#include "core/numerics/field.hpp"

namespace polybed::measures {

/// Slabs of one thickness from the bottom up.
struct Profile {
  double slab = 0;                            ///< thickness, m
  std::vector<std::vector<double>> fraction;  ///< phi_j, [species][slab]
  std::vector<double> pressure;               ///< net p, Pa; can be empty
  std::vector<double> areas = {};             ///< of the slabs, m2; empty: all equal

  [[nodiscard]] std::size_t slabs() const { return fraction.empty() ? 0 : fraction.front().size(); }
  [[nodiscard]] double centre(std::size_t k) const { return (double(k) + 0.5) * slab; }
  [[nodiscard]] double area(std::size_t k) const { return areas.empty() ? 1 : areas[k]; }
  /// phi = sum phi_j of a slab; negative fractions count as they are.
  [[nodiscard]] double solids_fraction(std::size_t k) const {
    double sum = 0;
    for (const auto& phi : fraction) sum += phi[k];
    return sum;
  }
};

/// The same profile on slabs of another thickness. Each receives the parts of the old slabs that lie in it, so that
/// volumes are kept; the part above the last slab is dropped. \param slab  thickness, m, > 0
[[nodiscard]] Profile on_slabs(const Profile& profile, double slab, std::size_t count);

/// Number of slabs of a profile: of layers of cells; graded ones are laid on slabs as thick as the lowest layer.
[[nodiscard]] std::size_t slabs_of(const core::Grid& grid);

/// Open areas of the slabs where the cross-section changes, m2; else empty.
[[nodiscard]] std::vector<double> areas_of_slabs(const core::Grid& grid);

/// Values of graded layers on slabs.
enum class Within { even, linear };  ///< even in each layer, so that volumes are kept; linear between the centres

/// The block's part of the mean over each horizontal layer of the column for a padded cell field; [slab from the
/// bottom]. The sum over the ranks is the mean.
[[nodiscard]] std::vector<double> part_of_lateral_mean(const core::Grid& grid, std::span<const double> field,
                                                       Within layers = Within::even);
/// The complete mean. Collective.
[[nodiscard]] std::vector<double> lateral_mean(const core::Grid& grid, std::span<const double> field,
                                               Within layers = Within::even);

}  // namespace polybed::measures
