// Report on the fluid in a run of particles: in run.json, and at its end on the screen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "dem/coupling/coupling.hpp"
#include "dem/coupling/fluid_record.hpp"

namespace polybed::multiscale {

struct FluidReport {
  dem::FluidTotals totals;
  std::string kernel, law;     ///< diffusion | bilinear; drag law, or none
  bool shared = false;         ///< each rank solves for a block of the fluid instead of all of it
  double kernel_width = 0;     ///< m; 0 for bilinear weights
  int every = 1;               ///< steps of the particles per fluid step
  double step = 0;             ///< of the fluid, s
  std::optional<double> work;  ///< of the fluid on the particles, including buoyancy, J; absent without dem.ledger
};

/// \param dt  of the particles, s  \param work  of the fluid on all particles, J
[[nodiscard]] FluidReport fluid_report(const core::Scene& scene, const dem::Coupling& coupling,
                                       const dem::FluidTotals& totals, double dt, std::optional<double> work);

/// The member "fluid" of an object that is open.
void write_fluid(core::Json& json, const FluidReport& report);

/// The same in two lines.
[[nodiscard]] std::vector<std::string> fluid_lines(const FluidReport& report);

}  // namespace polybed::multiscale
