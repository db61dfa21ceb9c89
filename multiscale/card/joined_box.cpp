#include "multiscale/card/joined_box.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "closures/suspension_slip.hpp"
#include "measures/box_flow.hpp"
#include "multiscale/card/card.hpp"
#include "multiscale/card/velocity_text.hpp"
#include "multiscale/program.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

core::Json json_of_mean(const std::optional<measures::TimeMean>& mean) {
  if (!mean) return nullptr;
  return {{"value", mean->mean}, {"interval", core::or_null(mean->interval)}};
}

}  // namespace

JoinedBox joined_box_of(const core::Scene& scene, const Balance& balance, const std::vector<double>& share) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const double fraction = scene.bed.static_height * scene.bed.solids_fraction / scene.column.size[1];
  const double* given = std::get_if<double>(&scene.column.pressure_gradient);
  std::vector<double> diameter, density, excess, fractions;
  for (std::size_t j = 0; j < share.size(); ++j) {
    diameter.push_back(scene.species[j].diameter);
    density.push_back(scene.species[j].density);
    excess.push_back(density[j] - fluid.density);
    fractions.push_back(fraction * share[j]);
  }
  const double of_weight = measures::gradient_of_weight(fractions, density, fluid.density, -scene.column.gravity);
  JoinedBox box{fraction, given != nullptr ? *given : of_weight, given == nullptr};
  const bool form_a = scene.tfm.form == core::PressureForm::A;
  if (!box.by_weight || !balance.law || !(fraction > 0) || !form_a || core::acts(scene, "gas_slip")) return box;
  const std::vector<double> slips =
      closures::suspension_slips(*balance.law, 1 - fraction, share, diameter, excess, fluid.density, fluid.viscosity,
                                 scene.column.gravity, box.gradient);
  double mean = 0;
  for (std::size_t j = 0; j < share.size(); ++j) {
    box.slips.emplace_back(scene.species[j].name, slips[j]);
    mean += share[j] * slips[j];
  }
  box.superficial_slip = (1 - fraction) * mean;
  return box;
}

void add_joined_box(const core::Scene& scene, const JoinedBox& box, const std::string& law,
                    std::vector<std::string>& lines) {
  const bool sides = scene.column.sides == core::Boundary::periodic;
  lines.push_back(card_line(
      "box",
      fmt::format("periodic: {}; solids fraction {:.3g}, driven by {}, dp/dy {} Pa/m",
                  sides ? "bottom and top joined, and the sides" : "bottom and top joined, walls at the sides",
                  box.fraction, box.by_weight ? "the weight" : "column.pressure_gradient", plain(box.gradient, 4))));
  constexpr std::size_t most_listed = 4;
  if (!box.superficial_slip) return;
  std::vector<std::string> slips;
  for (const auto& [name, slip] : box.slips) slips.push_back(name + " " + velocity_text(slip, 0));
  const std::string species = slips.size() > most_listed ? "" : "slip of the fluid over " + each(slips) + ", ";
  const char* without = core::acts(scene, "species_exchange") ? ", without species_exchange" : "";
  lines.push_back(card_line("expect", fmt::format("{}superficial {} over all solids, by {}{} while it stays even",
                                                  species, velocity_text(*box.superficial_slip, 0), law, without)));
}

void add_slips(const BedOfRun::Joined& run, std::vector<std::string>& lines) {
  constexpr double milli = 1e3;
  std::vector<std::string> slips;
  for (const auto& [name, slip] : run.slips) slips.push_back(name + " " + mean_text(slip, milli, " mm/s"));
  lines.push_back(card_line("slip", "of the fluid over " + each(slips)));
  if (run.superficial_slip)
    lines.push_back(card_line("", "superficial, over all solids " + mean_text(*run.superficial_slip, milli, " mm/s")));
  lines.push_back(card_line("box", fmt::format("mean dp/dy {} Pa/m; its centre of mass moves at {:.3g} mm/s",
                                               plain(run.gradient, 4), milli * run.mass_velocity)));
}

core::Json json_of(const JoinedBox& box) {
  core::Json slips = core::Json::object();
  for (const auto& [name, slip] : box.slips) slips[name] = slip;
  return {{"solids_fraction", box.fraction},
          {"pressure_gradient_Pa_m", box.gradient},
          {"slip_m_s", slips},
          {"superficial_slip_m_s", core::or_null(box.superficial_slip)}};
}

core::Json json_of(const BedOfRun::Joined& run) {
  core::Json slips = core::Json::object();
  for (const auto& [name, slip] : run.slips) slips[name] = json_of_mean(slip);
  return {{"slip_m_s", slips},
          {"superficial_slip_m_s", json_of_mean(run.superficial_slip)},
          {"pressure_gradient_Pa_m", run.gradient},
          {"mass_velocity_m_s", run.mass_velocity}};
}

}  // namespace polybed::multiscale
