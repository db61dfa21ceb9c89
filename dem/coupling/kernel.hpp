// The averaging width of particles for the fluid: from the case, or suited to cells and particles.
#pragma once

#include <cstdint>
#include <string>

#include "core/case/scene.hpp"

namespace polybed::dem {

struct Kernel {
  double width = 0;    ///< full width at half height, m; 0: bilinear weights alone
  std::string reason;  ///< for people
};

/// \param smallest_cell, largest_diameter  m  \param particles  their number
[[nodiscard]] Kernel kernel_of(const core::Scene& scene, double smallest_cell, double largest_diameter,
                               std::int64_t particles);

/// Warning if an automatic width is so large a part of the bed's height that its drag is noticeably too small; empty
/// otherwise. \param width  m
[[nodiscard]] std::string smearing_warning(const core::Scene& scene, double width);

}  // namespace polybed::dem
