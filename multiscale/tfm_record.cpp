#include "multiscale/tfm_record.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/numerics/ranks.hpp"
#include "multiscale/run_record.hpp"
#include "multiscale/scene_warnings.hpp"

namespace polybed::multiscale {

using core::Json;

namespace {

Json work_of(const tfm::Work& work) {
  return {{"steps", work.steps},
          {"rejected_steps", work.rejected_steps},
          {"rhs_evaluations", work.right_hand_sides},
          {"pressure_solves", work.pressure_solves},
          {"linear_iterations", work.pressure_iterations + work.krylov_iterations},
          {"newton_iterations", work.newton_iterations},
          {"first_order_cells", work.first_order_cells}};
}

/// For a failed run: the last steps, with the limit of each.
Json last_steps_of(const std::deque<tfm::StepLine>& steps) {
  Json json = Json::array();
  for (const tfm::StepLine& step : steps)
    json.push_back({{"time_s", step.time}, {"dt_s", step.step}, {"limited_by", step.limited_by}});
  return json;
}

/// Number of closure evaluations outside their range.
Json guards_of(const std::vector<tfm::ClosureUse>& closures) {
  Json json = Json::array();
  for (const tfm::ClosureUse& use : closures)
    json.push_back({{"closure", use.name}, {"evaluations", use.evaluations}, {"outside_range", use.guarded}});
  return json;
}

/// The smallest G/G_crit in the run with its place; null if there was never slip.
Json well_posedness_of(const tfm::LeastWellPosed& least, int dimensions) {
  if (!std::isfinite(least.cell.least)) return nullptr;
  const auto place = least.cell.place.begin();
  return {{"least", least.cell.least},
          {"critical_slope_Pa", least.cell.critical_slope},
          {"time_s", least.time},
          {"place_m", std::vector<double>(place, place + dimensions)},
          {"share_below_1", least.share_below_now}};
}

/// Mass of each species at the start, in, out and in the column, and the error of the balance.
Json ledger_of(const tfm::Constants& constants, const RunTotals& totals, const measures::Invariants& invariants) {
  Json ledger = Json::array();
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double start = invariants.initial_mass()[j], in = totals.passed[j].in * constants.density[j],
                 out = totals.passed[j].out * constants.density[j], now = totals.masses[j];
    ledger.push_back({{"species", constants.name[j]},
                      {"start_kg", start},
                      {"in_kg", in},
                      {"out_kg", out},
                      {"stored_kg", now},
                      {"relative_error", measures::ledger_error(start, in, out, now)}});
  }
  return ledger;
}

}  // namespace

std::vector<tfm::ClosureUse> closures_of(const tfm::Model& model, std::span<const tfm::ClosureUse> before) {
  std::vector<tfm::ClosureUse> closures;
  const tfm::Effects& effects = model.effects();
  if (effects.drag) closures.push_back(effects.drag->use());
  const auto add = [&](const auto& effect) {
    if (!effect) return;
    if (auto use = effect->use()) closures.push_back(std::move(*use));
  };
  add(effects.solids_stress);
  add(effects.collisions);
  add(effects.species_exchange);
  for (tfm::ClosureUse& use : closures) {
    use.evaluations = std::uint64_t(core::sum_of_ranks(model.constants().grid, double(use.evaluations)));
    use.guarded = std::uint64_t(core::sum_of_ranks(model.constants().grid, double(use.guarded)));
  }
  for (std::size_t n = 0; n < before.size(); ++n) {
    closures[n].evaluations += before[n].evaluations;
    closures[n].guarded += before[n].guarded;
  }
  return closures;
}

RunTotals totals_of(const tfm::Model& model, double cpu_seconds, double wall_seconds,
                    std::span<const tfm::ClosureUse> before) {
  const core::Grid& grid = model.constants().grid;
  RunTotals totals;
  totals.ranks = grid.ranks ? grid.ranks->count() : 1;
  totals.cpu_seconds = core::sum_of_ranks(grid, cpu_seconds);
  totals.wall_seconds = wall_seconds;
  totals.masses = tfm::masses(model);
  if (model.constants().openings.present()) totals.passed = model.passed();
  totals.closures = closures_of(model, before);
  return totals;
}

std::string run_record_text(const RunRecord& record) {
  const tfm::Model& model = record.model;
  const double simulated = model.time() - record.begin;
  Json json;
  begin_record(json, record.scene, "tfm", record.state, record.totals.ranks);
  json.update({{"integrator", core::name_of(model.integrator_kind())},
               {"integrator_reason", model.integrator_reason()},
               {"momentum", core::name_of(model.momentum())},
               {"unknowns", model.unknowns()},
               {"time_s", model.time()},
               {"cpu_s", record.totals.cpu_seconds},
               {"wall_s", record.totals.wall_seconds},
               {"cpu_s_per_simulated_s", simulated > 0 ? record.totals.cpu_seconds / simulated : 0.0}});
  record.write_card(json);
  json["work"] = work_of(model.work());
  if (record.state.starts_with("failed")) json["last_steps"] = last_steps_of(record.observers.last_steps());
  write_timers(json, record.timers);
  write_invariants(json, record.observers.invariants().worst());
  if (model.constants().openings.present())
    json["ledger"] = ledger_of(model.constants(), record.totals, record.observers.invariants());
  json["pressure_drop_over_weight"] = core::or_null(record.observers.force_balance());
  json["well_posedness"] = well_posedness_of(record.observers.least_well_posed(), model.constants().grid.dimensions);
  json["guards"] = guards_of(record.totals.closures);
  write_left_out(json, record.left_out);
  if (record.promise != nullptr) write_neglected(json, *record.promise);
  Json& warnings = json["warnings"] = exceeded_lines(record.observers.invariants().worst());
  for (const Json& line : json.value("drift", Json::object()).value("lines", Json::array())) warnings.push_back(line);
  for (const auto& lines :
       {model.effects().warnings, scene_warnings(record.scene), grid_warnings(record.scene), record.warnings})
    for (const std::string& line : lines) warnings.push_back(line);
  return record.state.starts_with("failed") ? core::json_text_with_nulls(json) : core::json_text(json);
}

}  // namespace polybed::multiscale
