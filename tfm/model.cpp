#include "tfm/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/ranks.hpp"
#include "core/start_error.hpp"
#include "relevance/fluid_properties.hpp"
#include "tfm/initial.hpp"
#include "tfm/packing_limit.hpp"
#include "tfm/particle_scene.hpp"
#include "tfm/resting_tolerances.hpp"
#include "tfm/rules.hpp"
#include "tfm/step_estimate.hpp"

namespace polybed::tfm {

using core::Index;
using Kind = StateLayout::Entry::Kind;

namespace {

Constants make_constants(const core::Scene& scene, const std::shared_ptr<const core::Ranks>& ranks) {
  refuse_particle_scene(scene);
  Constants constants;
  constants.grid = core::grid_of(scene.column, ranks);
  constants.gravity = scene.column.gravity;
  constants.down = scene.column.down;
  constants.fluid = relevance::fluid_constants(scene.fluid);
  constants.bed_share = scene.bed.volume_share;
  for (const core::Species& species : scene.species) {
    constants.diameter.push_back(species.diameter);
    constants.density.push_back(species.density);
    constants.name.push_back(species.name);
  }
  constants.openings = fluid::Openings(constants.grid, scene);
  return constants;
}

/// Absolute tolerance of the fractions.
double fraction_tolerance(double rtol) { return 0.1 * rtol; }

Discretisation make_discretisation(const core::Tfm& options, core::Momentum momentum) {
  const auto scheme = [](bool limited) { return limited ? Scheme::limited : Scheme::upwind; };
  const bool both = momentum == core::Momentum::conservative_limited;
  return {scheme(options.flux == core::FractionFlux::limited), scheme(both || momentum == core::Momentum::limited),
          options.solids_wall == core::SolidsWall::no_slip ? fluid::WallSlip::no_slip : fluid::WallSlip::free_slip,
          both || momentum == core::Momentum::conservative};
}

}  // namespace

Model::Model(const core::Scene& scene, core::Timers& timers, const std::shared_ptr<const core::Ranks>& ranks)
    : timers_(timers),
      options_(scene.tfm),
      momentum_((refuse_particle_scene(scene), momentum_form(scene))),
      equations_(scene, make_constants(scene, ranks),
                 fluid::Boundaries(core::grid_of(scene.column, ranks), scene.column.closed,
                                   scene.column.outlet == core::Outlet::open),
                 fluid::Inlet(core::grid_of(scene.column, ranks), scene),
                 make_discretisation(scene.tfm, momentum_.form), timers) {
  choose_integrator(scene);
  const Constants& constants = equations_.constants();
  layout_ = StateLayout(constants.grid, int(constants.species()),
                        integrator_kind_ == core::TfmIntegrator::implicit_steps || compressible(),
                        transports_temperature(), constants.openings.passages());
  column_size_ = layout_of_column().size();
  constexpr double least_scale = 1e-6;  // m/s, where nothing falls and nothing flows in: a tolerance of 0 is none
  velocity_scale_ = std::max(
      {0.1 * greatest_terminal_velocity(constants), inlet().greatest(), constants.openings.greatest(), least_scale});
  pressure_scale_ = scene.fluid.outlet_pressure * (100.0 / 101325);
  Fields& fields = equations_.fields();
  fill_bed(scene.bed, constants, effects().solids_stress.get(), fields.solids);
  constants.openings.set_velocities(fields.solids);
  core::for_each_row(constants.grid, core::owned_faces(constants.grid, 1), [&](Index begin, Index end) {
    std::fill(fields.fluid.flux[1].begin() + begin, fields.fluid.flux[1].begin() + end, inlet().mean_velocity(0));
  });
  core::Field even = core::make_field(constants.grid);  // what flows in before the jets have their own velocities
  fluid::for_each_boundary_row(constants.grid, 1, 0, [&](Index begin, Index end) {
    std::fill(even.begin() + begin, even.begin() + end, inlet().mean_velocity(0));
  });
  follows_solids_ = options_.follow_bed && integrator_kind_ != core::TfmIntegrator::implicit_steps && !compressible() &&
                    !transports_temperature() && !constants.openings.present();
  y_.resize(layout_.size());
  dydt_.assign(layout_.size(), 0.0);
  layout_.pack(fields.solids, fields.fluid, y_);
  project_jump(even);
  if (options_.flux == core::FractionFlux::limited)
    fallback_.emplace(constants, boundaries(), fraction_tolerance(options_.rtol));
  if (compressible()) start_compressible();
  make_integrator();
  begin_integration();
}

Model::~Model() = default;

/// The rule rests on measured costs, docs/record/cost.md: a liquid bed is cheaper with steps that take the drag alone
/// implicitly, unless a wholly implicit one replaces more than 1.5 of them, because the solids' pressure binds them;
/// one that settles or is fluidised by a gas is cheaper with wholly implicit ones.
void Model::choose_integrator(const core::Scene& scene) {
  integrator_kind_ = options_.integrator;
  integrator_reason_ = "as the case says";
  if (integrator_kind_ == core::TfmIntegrator::automatic) {
    const bool gas = equations_.constants().fluid.density < 100;
    const bool still = scene.column.closed || inlet().greatest() == 0;
    constexpr double dear_above = 1.5;
    const double replaced = split_steps_per_implicit(scene, equations_.constants(), effects(), inlet().greatest());
    integrator_kind_ = compressible() || gas || still || replaced > dear_above ? core::TfmIntegrator::implicit_steps
                       : effects().drag                                        ? core::TfmIntegrator::split_steps
                                                                               : core::TfmIntegrator::explicit_steps;
    integrator_reason_ = compressible() ? "compressible: sound is faster than anything that matters"
                         : gas          ? "gas: drag relaxes faster than anything moves"
                         : still        ? "nothing flows in: the bed settles"
                                        : fmt::format("in a liquid, an implicit step for {:.1f} others", replaced);
  }
  if (integrator_kind_ == core::TfmIntegrator::split_steps && (compressible() || !effects().drag))
    throw core::StartError(fmt::format("tfm.integrator = \"imex\" takes the drag implicitly: it needs {}",
                                       compressible() ? "an incompressible fluid" : "a drag law"));
  const std::string wrong = wrong_with_implicit_tolerance(options_.rtol);
  if (integrator_kind_ == core::TfmIntegrator::implicit_steps && !wrong.empty())
    throw core::StartError(fmt::format("tfm.rtol = {} with the implicit integrator: {}", options_.rtol, wrong));
}

std::vector<double> Model::absolute_tolerances() const {
  std::vector<double> atol(layout_.size());
  constexpr double not_tested = 1e9;  // m: sums of fluxes follow from the rest and need no error test of their own
  for (const StateLayout::Entry& entry : layout_.entries()) {
    const double value = entry.kind == Kind::fraction      ? fraction_tolerance(options_.rtol)
                         : entry.kind == Kind::passed      ? not_tested
                         : entry.kind == Kind::pressure    ? pressure_scale_ * options_.rtol
                         : entry.kind == Kind::temperature ? options_.rtol * velocity_scale_ * velocity_scale_
                                                           : options_.rtol * velocity_scale_;
    std::fill_n(atol.begin() + std::ptrdiff_t(entry.begin), entry.size, value);
  }
  return atol;
}

/// Where nothing flows in at times; empty elsewhere.
core::TolerancesAt Model::tolerances_at() const {
  if (!boundaries().closed() && !inlet().shuts()) return {};
  return RestingTolerances(constants().grid, boundaries(), layout_, absolute_tolerances(), velocity_scale_,
                           constants().gravity);
}

void Model::make_integrator() {
  if (integrator_kind_ == core::TfmIntegrator::implicit_steps) {
    implicit_ = std::make_unique<ImplicitProblem>(equations_, layout_, timers_);
    core::ImplicitOptions options;
    options.rtol = options_.rtol;
    options.atol = absolute_tolerances();
    options.ranks = constants().grid.ranks;
    options.atol_at = tolerances_at();
    options.id.assign(layout_.size(), 1.0);
    // Of a compressible fluid p is differential, but left out of the error test all the same: sound that carries
    // nothing must not set the step.
    for (const StateLayout::Entry& entry : layout_.entries())
      if (entry.kind == Kind::pressure || entry.kind == Kind::passed)
        std::fill_n(options.id.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
    integrator_ = core::make_implicit(*implicit_, std::move(options));
  } else {
    core::OdeProblem* problem = nullptr;
    if (compressible()) {
      acoustic_ = std::make_unique<CompressibleProblem>(equations_, layout_);
      problem = acoustic_.get();
    } else {
      const double tolerance = options_.pressure_tolerance.value_or(std::min(1e-4, 0.1 * options_.rtol));
      explicit_ = std::make_unique<ExplicitProblem>(equations_, layout_, tolerance, timers_,
                                                    integrator_kind_ == core::TfmIntegrator::split_steps);
      problem = explicit_.get();
    }
    core::ExplicitOptions options;
    options.rtol = options_.rtol;
    options.atol = absolute_tolerances();
    options.fixed_step = options_.fixed_step.value_or(0);
    options.ranks = constants().grid.ranks;
    options.atol_at = tolerances_at();
    integrator_ = integrator_kind_ == core::TfmIntegrator::split_steps
                      ? core::make_split(*explicit_, std::move(options))
                      : core::make_explicit(*problem, std::move(options));
  }
}

/// Starts the integrator at (time_, y_). The implicit one needs consistent rates and pressure: one projected
/// right-hand side gives both.
void Model::begin_integration() {
  equations_.begin(time_);
  follow_solids(y_);
  if (explicit_) {
    explicit_->begin();
    explicit_->begin_step(step_);
  }
  if (compressible()) {
    begin_compressible();
  } else if (implicit_) {
    // The pressure is found from zero, so that what follows depends on the other unknowns alone and a resumed
    // run gives the same bits.
    for (const StateLayout::Entry& entry : layout_.entries())
      if (entry.kind == Kind::pressure) std::fill_n(y_.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
    ExplicitProblem projected(equations_, layout_, 1e-8, timers_);
    if (projected.rates(time_, y_, dydt_) != core::Rate::ok)
      throw core::NumericsError("the state at the start has no rates: check the bed's solids fraction");
    for (const StateLayout::Entry& entry : layout_.entries())
      if (entry.kind == Kind::pressure) layout_.pack(entry, fields().fluid.pressure, y_);
  }
  integrator_->restart(time_, y_, dydt_, step_);
}

void Model::step(double stop) {
  follow_solids(integrator_->state());
  if (explicit_) explicit_->begin_step(step_);
  const core::StepReport report = integrator_->step(stop);
  time_ = report.time;
  step_ = report.next_step;
  if (compressible()) count_fluid(integrator_->state());
  last_step_ = {report.time, report.step, report.error_norm, ""};
  if (effects().solids_stress && !goes_on_above_packing_) require_sound_state();
  if (fallback_) {
    fallback_->see(layout_, integrator_->state(), effects().solids_stress.get());
    use_fallback();
  }
  last_step_.limited_by = report.time >= stop && report.step < 0.99 * report.next_step ? "event" : what_limited(report);
}

/// The solids' equations are asked below the highest row that holds any, and in some rows above, where their velocities
/// have time to become those of the flow before solids arrive. It depends on the state alone, as a restart needs.
void Model::follow_solids(std::span<const double> y) {
  if (!follows_solids_) return;
  constexpr double trace = 1e-12;  // of the fraction: it stays where it is
  constexpr int margin = 8;
  const core::Grid& grid = constants().grid;
  const auto holds_solids = [&](int row) {
    const auto nx = std::size_t(grid.cells[0]);
    for (const StateLayout::Entry& entry : layout_.entries())
      for (int k = 0; k < grid.cells[2] && entry.kind == Kind::fraction; ++k) {
        const auto cells =
            y.subspan(entry.begin + (std::size_t(k) * std::size_t(grid.cells[1]) + std::size_t(row)) * nx, nx);
        if (std::any_of(cells.begin(), cells.end(), [](double phi) { return std::abs(phi) > trace; })) return true;
      }
    return false;
  };
  int rows = grid.cells[1];
  while (rows > 0 && !holds_solids(rows - 1)) --rows;
  const int held = int(core::greatest_of_ranks(grid, rows > 0 ? grid.before[1] + rows : 0)) + margin;
  equations_.hold_solids_above(held < grid.column_cells(1) ? held : std::numeric_limits<int>::max());
}

/// Throws where no bed can be so dense; the state is then the one before the step.
void Model::require_sound_state() {
  try {
    require_packing(constants(), layout_, integrator_->state(), time_, *effects().solids_stress);
  } catch (const core::NumericsError&) {
    time_ -= last_step_.step;
    integrator_->interpolate(time_, y_);
    throw;
  }
}

/// In the words of the rank where the limit is.
std::string Model::what_limited(const core::StepReport& report) const {
  const core::Grid& grid = constants().grid;
  const double viscosity = effects().fluid_stress ? effects().fluid_stress->kinematic_viscosity() : 0;
  std::vector<TimeScale> scales =
      time_scales(constants(), fields(), viscosity, integrator_kind_ == core::TfmIntegrator::split_steps);
  if (acoustic_) {
    const auto [seconds, cell] = effects().compressible->sound_time(fields().fluid);
    scales.push_back({"sound", seconds, cell});
  }
  const TimeScale nearest = nearest_of(scales);
  const int rank = core::rank_of_greatest(grid, -nearest.seconds);
  if (report.step >= limiting_share * core::least_of_ranks(grid, nearest.seconds))
    return core::said_by(grid, rank, place_of(nearest, grid));
  const int worst = core::rank_of_greatest(grid, report.worst_error);
  return core::said_by(grid, worst, "error test: " + layout_.describe(report.worst_entry, constants().name));
}

void Model::use_fallback() {
  equations_.take_first_order_on(fallback_->steps_left().empty() ? nullptr : &fallback_->faces());
}

void Model::show(double t) {
  if (t != time_ || y_.empty())
    integrator_->interpolate(t, y_);
  else
    std::copy(integrator_->state().begin(), integrator_->state().end(), y_.begin());
  Fields& fields = equations_.fields();
  const core::Field pressure = fields.fluid.pressure;
  if (!equations_.evaluate(t, layout_, y_))
    throw core::NumericsError(fmt::format("t = {:.6g} s: the state cannot be evaluated", t));
  if (!layout_.with_pressure()) fields.fluid.pressure = pressure;
  fluid::set_outlet_pressure(constants().grid, boundaries(), fields.fluid.pressure);
}

void Model::restart() {
  const auto state = integrator_->state();
  std::copy(state.begin(), state.end(), y_.begin());
  // A compressible fluid hears of a jump by sound.
  if (!compressible()) project_jump(inlet_velocity(std::nextafter(time_, -INFINITY)));
  begin_integration();
}

/// The inlet's velocity on the bottom faces of a field that is 0 elsewhere.
core::Field Model::inlet_velocity(double t) const {
  core::Field bottom = core::make_field(constants().grid);
  inlet().set_velocity(t, bottom);
  return bottom;
}

/// Where the inlet jumps from `before`, an impulse brings the fluxes and velocities to the new value at once, with the
/// operator that the pressure uses.
void Model::project_jump(const core::Field& before) {
  if (boundaries().closed()) return;
  core::Field jump = inlet_velocity(std::nextafter(time_, INFINITY));
  double most = 0;
  for (std::size_t f = 0; f < jump.size(); ++f) most = std::max(most, std::abs(jump[f] -= before[f]));
  if (core::greatest_of_ranks(constants().grid, most) <= 1e-9 * velocity_scale_) return;
  if (!equations_.evaluate(time_, layout_, y_)) return;
  Fields& fields = equations_.fields();
  const core::Field pressure = fields.fluid.pressure;
  for (core::Field& rate : fields.flux_rate.free) std::fill(rate.begin(), rate.end(), 0.0);
  for (core::FaceField& a : fields.solids.acceleration)
    for (core::Field& rate : a) std::fill(rate.begin(), rate.end(), 0.0);
  fields.flux_rate.free[1] = jump;
  fluid::Pressure impulse(constants().grid, 1e-10);
  std::fill(fields.fluid.pressure.begin(), fields.fluid.pressure.end(), 0.0);
  impulse.solve(fields.flux_rate, fields.fluid.flux, 0.0, fields.fluid.pressure);
  subtract_pressure_gradient(constants(), boundaries(), fields);
  for (std::size_t j = 0; j < constants().species(); ++j)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t f = 0; f < fields.solids.velocity[j][a].size(); ++f)
        fields.solids.velocity[j][a][f] += fields.solids.acceleration[j][a][f];
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t f = 0; f < fields.fluid.flux[a].size(); ++f)
      fields.fluid.flux[a][f] += fields.flux_rate.free[a][f];
  fields.fluid.pressure = pressure;
  layout_.pack(fields.solids, fields.fluid, y_);
}

std::vector<double> Model::breakpoints() const {
  std::vector<double> times = inlet().breakpoints();
  const std::vector<double> of_feeds = constants().openings.breakpoints();
  times.insert(times.end(), of_feeds.begin(), of_feeds.end());
  return times;
}

Work Model::work() const {
  const core::IntegratorStatistics s = integrator_->statistics();
  Work done = before_;
  done.steps += s.steps;
  done.rejected_steps += s.error_failures;
  done.newton_iterations += s.newton_iterations;
  done.krylov_iterations += s.linear_iterations;
  if (fallback_) done.first_order_cells = fallback_->count();
  if (implicit_) done.right_hand_sides += implicit_->residuals();
  if (acoustic_) done.right_hand_sides += acoustic_->evaluations();
  if (explicit_) {
    done.right_hand_sides += explicit_->solves();
    done.pressure_solves += explicit_->solves();
    done.pressure_iterations += explicit_->iterations();
  }
  return done;
}

}  // namespace polybed::tfm
