// What the errors of a sweep are measured against.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/output/files.hpp"
#include "multiscale/cost/judge.hpp"
#include "multiscale/cost/refinement.hpp"
#include "multiscale/cost/sweeper.hpp"

namespace polybed::multiscale {

namespace {

constexpr double floor_factor = 10;  ///< of the disagreement of two references: cost.md, section 4
constexpr double formal_order = 2;   ///< of the discretisation in space where nothing is sharp

std::map<std::string, double> means_of(const Row& row) {
  std::map<std::string, double> found;
  for (const auto& [id, mean] : row.measured.values) found[id] = mean.mean;
  return found;
}

}  // namespace

void Sweeper::find_reference() {
  const std::string& wanted = sweep_.options.reference;
  if (wanted == "exact") return exact_reference();
  if (wanted != "auto") {
    const Measured given{core::read_history(wanted), core::read_profiles(wanted)};
    const RunQuantities measured = quantities_of_run(given, sweep_.on);
    for (const auto& [id, mean] : measured.values) {
      sweep_.reference.value[id] = mean.mean;
      sweep_.reference.band[id] = mean.error.value_or(0);
    }
    for (auto& [id, band] : sweep_.reference.band) band /= scale_of(sweep_, id);
    sweep_.reference.floor = sweep_.reference.band;
    sweep_.reference.profile = measured.profile;
    sweep_.reference.kind = "directory";
    sweep_.reference.note = wanted;
    return;
  }
  if (sweep_.regime == "chaotic")
    statistical_reference();
  else
    additive_reference();
}

void Sweeper::exact_reference() {
  Row row{.kind = RowKind::reference, .note = "force balance", .order = {"force_balance", 1, {}}};
  const std::size_t n = run(std::move(row));
  const Row& found = sweep_.rows[n];
  if (scene_.species.size() > 1 || !found.done() || !found.measured.values.contains(sweep_.ranking()))
    return refuse(
        "no exact value of this quantity: one is known of the height and the pressure drop of a bed of one "
        "species that is carried");
  sweep_.reference.kind = "exact";
  sweep_.reference.note = "uniform expansion by the balance of forces";
  sweep_.reference.value = means_of(found);
}

RunOrder Sweeper::tight(const std::vector<std::string>& more) const {
  RunOrder order{sweep_.options.model, 1, {}};
  for (const Axis& a : sweep_.axes) {
    const bool numeric = a.kind == AxisKind::numerics;
    const Level* level = &a.levels[numeric ? centre_.at(a.name) : a.given];
    if (numeric && a.name != "grid" && !a.beyond.empty()) level = &a.beyond.back();
    order.overrides.insert(order.overrides.end(), level->overrides.begin(), level->overrides.end());
  }
  if (sweep_.options.model == "tfm" && axis("rtol") == nullptr) order.overrides.emplace_back("tfm.rtol=1e-7");
  order.overrides.insert(order.overrides.end(), more.begin(), more.end());
  return order;
}

/// An integrator of another family than the one that a run had.
std::vector<std::string> Sweeper::other_family(const Row& row) const {
  if (sweep_.options.model == "dem")
    return {scene_.dem.integrator == core::DemIntegrator::synchronised ? "dem.integrator=thesis"
                                                                       : "dem.integrator=synchronised"};
  const bool implicit = row.outcome.counters.contains("jacobian_products x unknowns");
  return {implicit ? "tfm.integrator=explicit" : "tfm.integrator=implicit"};
}

/// The longest and finest of what was run, and if it can be had a run three windows long on the finest grid.
void Sweeper::statistical_reference() {
  Row row{
      .kind = RowKind::reference, .settings = centre_, .note = "reference: finest and three windows long", .order = {}};
  if (const Axis* grid = axis("grid"); grid != nullptr) row.settings["grid"] = grid->levels.size() - 1;
  row.order = order_of(row.settings);
  row.order.overrides.push_back(fmt::format("run.until={:.17g}", 1.5 * scene_.run.until));
  std::size_t best = run(std::move(row), 0.6);
  if (!sweep_.rows[best].done() && axis("grid") != nullptr)
    for (std::size_t level = axis("grid")->levels.size(); level-- > 0 && !sweep_.rows[best].done();)
      if (const auto n = find(order_of(centre_with("grid", level)), RowKind::candidate)) best = *n;
  const Row& found = sweep_.rows[best];
  if (!found.done()) return;
  Reference& reference = sweep_.reference;
  reference.kind = "statistical";
  reference.note = settings_text(sweep_, found);
  reference.value = means_of(found);
  reference.profile = found.measured.profile;
  for (const auto& [id, mean] : found.measured.values)
    reference.band[id] = mean.error.value_or(0) / scale_of(sweep_, id);
  reference.floor = reference.band;
  if (found.kind == RowKind::candidate) sweep_.warnings.emplace_back("the reference is one of the runs that it ranks");
}

/// Time by a run two levels beyond and one of another family, on the coarsest grid, whose errors in time are those of
/// the others as far as errors add up; space by Richardson's value of the line of grids.
void Sweeper::additive_reference() {
  Reference& reference = sweep_.reference;
  const Row first{.kind = RowKind::reference, .note = "reference: two levels beyond", .order = tight({})};
  const std::size_t one = run(first);
  if (!sweep_.rows[one].done()) return;
  Row second{.kind = RowKind::reference, .note = "reference: of another family", .order = {}};
  second.order = tight(other_family(sweep_.rows[one]));
  const std::size_t two = run(std::move(second));
  if (!sweep_.rows[two].done())
    return refuse("no second family to check the reference by: " + sweep_.rows[two].outcome.reason);
  reference.kind = "self";
  reference.note = "two levels beyond the finest, and another family of integrators";
  reference.value = means_of(sweep_.rows[one]);
  reference.profile = sweep_.rows[one].measured.profile;
  for (const auto& [id, mean] : sweep_.rows[two].measured.values)
    if (reference.value.contains(id))
      reference.floor[id] = floor_factor * std::abs(mean.mean - reference.value[id]) / scale_of(sweep_, id);
  const double disagreement = reference.floor[sweep_.ranking()] / floor_factor;
  if (const Axis* grid = axis("grid"); grid != nullptr) add_space(*grid);
  if (sweep_.outcome != "done") return;
  std::vector<double> errors;
  for (Row& row : sweep_.rows) {
    measure_errors(sweep_, row);
    if (row.kind == RowKind::candidate && row.quantities.contains(sweep_.ranking()))
      errors.push_back(row.quantities[sweep_.ranking()].error);
  }
  if (!carries(disagreement, errors, sweep_.options.target))
    refuse(fmt::format("no trustworthy reference: two families of integrators differ by {:.2g} % in {}",
                       100 * disagreement, sweep_.ranking()));
}

/// Moves the reference from the grid it was run on to the limit of the line of grids.
void Sweeper::add_space(const Axis& grid) {
  std::vector<const Row*> line;  // from the coarsest, which the reference was run on, without a gap
  for (const Level& level : grid.levels) {
    const auto n = find(order_of(centre_with("grid", line.size())), RowKind::candidate);
    if (!n || !sweep_.rows[*n].done()) break;
    line.push_back(&sweep_.rows[*n]);
    if (!sweep_.rows[*n].outcome.invariants_held)
      sweep_.warnings.push_back(fmt::format(
          "grid {}: an invariant exceeded its limit, and it is one of the grids of the reference", level.label));
  }
  if (line.size() < 3)
    return refuse(
        "no trustworthy reference: fewer than three grids were run within the budget; a larger --budget, or "
        "--axes without grid for errors on one grid alone");
  Reference& reference = sweep_.reference;
  reference.kind = "extrapolated";
  const std::size_t finest = line.size() - 1;  // cells are whole: of 99 come 50, not 49.5
  const double ratio = std::sqrt(grid.levels[finest - 2].value / grid.levels[finest].value);
  for (auto& [id, value] : reference.value) {
    const auto at = [&](std::size_t n) { return line[line.size() - n]->measured.values.at(id).mean; };
    const auto has = [&](const Row* row) { return row->measured.values.contains(id); };
    if (!std::all_of(line.end() - 3, line.end(), has)) continue;
    const Refined refined = refine({at(3), at(2), at(1), ratio, formal_order});
    value += refined.limit - line.front()->measured.values.at(id).mean;
    reference.band[id] = refined.band;
    if (id == sweep_.ranking() && !refined.note.empty()) sweep_.warnings.push_back("grids: " + refined.note);
    if (id == sweep_.ranking() && refined.order)
      reference.note += fmt::format("; Richardson's value of {} grids, order {:.2f}", line.size(), *refined.order);
    if (id == sweep_.ranking() && !refined.order && refined.band > 0)
      reference.note += "; grids not in the asymptotic range: the finest, within three times half of their range";
  }
  for (auto& [id, band] : reference.band) band /= scale_of(sweep_, id);
  reference.profile = line.back()->measured.profile;
  const double band = reference.band[sweep_.ranking()];
  if (band > 5 * sweep_.options.target)
    refuse(fmt::format("not converging: the grids leave {} uncertain by {:.2g} %", sweep_.ranking(), 100 * band));
}

}  // namespace polybed::multiscale
