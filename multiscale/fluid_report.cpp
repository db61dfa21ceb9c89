#include "multiscale/fluid_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "relevance/drag_law.hpp"

namespace polybed::multiscale {

FluidReport fluid_report(const core::Scene& scene, const dem::Coupling& coupling, const dem::FluidTotals& totals,
                         double dt, std::optional<double> work) {
  return {totals,
          coupling.kernel_width() > 0 ? "diffusion" : "bilinear",
          scene.drag().given ? relevance::drag_name_of(scene) : "none",
          coupling.flow().grid().ranks != nullptr,
          coupling.kernel_width(),
          coupling.every(),
          coupling.every() * dt,
          work};
}

void write_fluid(core::Json& json, const FluidReport& r) {
  json["fluid"] = {{"every", r.every},
                   {"dt_s", r.step},
                   {"steps", r.totals.steps},
                   {"iterations", r.totals.iterations},
                   {"worst_residual", r.totals.worst_residual},
                   {"greatest_courant", r.totals.greatest_courant},
                   {"change_of_forces", r.totals.relative_change()},
                   {"ranks", r.shared ? "shared" : "each"},
                   {"kernel", r.kernel},
                   {"kernel_width_m", r.kernel_width},
                   {"drag",
                    {{"law", r.law},
                     {"evaluations", r.totals.law.evaluations},
                     {"guarded", r.totals.law.guarded},
                     {"clamped_voidage", r.totals.law.clamped_voidage}}}};
  if (r.work) json["fluid"]["work_J"] = *r.work;
}

std::vector<std::string> fluid_lines(const FluidReport& r) {
  const dem::FluidTotals& t = r.totals;
  const auto per = [](std::uint64_t part, std::uint64_t all) {
    return double(part) / double(std::max<std::uint64_t>(all, 1));
  };
  const std::string kernel = r.kernel_width > 0
                                 ? fmt::format("kernel {}, {:.3g} mm wide", r.kernel, 1e3 * r.kernel_width)
                                 : "kernel " + r.kernel;
  return {fmt::format("fluid: {} steps of {:.3g} s, every {} of the particles', {:.3g} iterations each, residual up to "
                      "{:.1e}, Courant number up to {:.2g}; {}; its forces change by {:.2g} % in a step",
                      t.steps, r.step, r.every, per(t.iterations, t.steps), t.worst_residual, t.greatest_courant,
                      kernel, 100 * t.relative_change()),
          fmt::format("drag {}: {:.3g} evaluations, {:.3g} % guarded, {:.3g} % at the bounds of voidage{}", r.law,
                      double(t.law.evaluations), 100 * per(t.law.guarded, t.law.evaluations),
                      100 * per(t.law.clamped_voidage, t.law.evaluations),
                      r.work ? fmt::format("; work of the fluid {:.3g} J", *r.work) : "")};
}

}  // namespace polybed::multiscale
