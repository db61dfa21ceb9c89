#include "tfm/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/ranks.hpp"
#include "fluid/pressure.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"
#include "tfm/initial.hpp"
#include "tfm/parts.hpp"
#include "tfm/rules.hpp"
#include "tfm/step_estimate.hpp"
#include "tfm/tolerances.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

Constants make_constants(const core::Scene& scene, const std::shared_ptr<const core::Ranks>& ranks) {
  Constants constants;
  constants.grid = core::grid_of(scene, ranks);
  constants.gravity = scene.column.gravity;
  constants.down = scene.column.down;
  constants.fluid = relevance::fluid_constants(scene.fluid);
  constants.bed_share = scene.bed.volume_share;
  if (const double* given = std::get_if<double>(&scene.column.pressure_gradient)) constants.given_gradient = *given;
  constants.form_b = scene.tfm.form == core::PressureForm::B;
  for (const core::Species& species : scene.species) {
    constants.diameter.push_back(species.diameter);
    constants.density.push_back(species.density);
    constants.name.push_back(species.name);
  }
  for (std::size_t j = 0; j < scene.species.size() && core::acts(scene, "shape"); ++j)
    constants.shape.push_back(relevance::shape_of(scene, scene.species[j]));
  constants.openings = fluid::Openings(constants.grid, scene);
  return constants;
}

/// Automatic momentum convection is first order.
core::Momentum momentum_of(const core::Scene& scene) {
  return scene.scheme.momentum == core::Momentum::automatic ? core::Momentum::conservative : scene.scheme.momentum;
}

Discretisation make_discretisation(const core::Tfm& options, core::Momentum momentum) {
  const auto scheme = [](bool limited) { return limited ? Scheme::limited : Scheme::upwind; };
  return {scheme(options.flux == core::FractionFlux::limited), scheme(momentum == core::Momentum::conservative_limited),
          options.solids_wall == core::SolidsWall::no_slip ? fluid::WallSlip::no_slip : fluid::WallSlip::free_slip};
}

}  // namespace

Model::Model(const core::Scene& scene, core::Timers& timers, const std::shared_ptr<const core::Ranks>& ranks)
    : timers_(timers),
      options_(scene.tfm),
      momentum_(momentum_of(continuum_scene(scene))),
      has_open_sides_(fluid::has_open_sides(scene)),
      equations_(scene, make_constants(scene, ranks),
                 fluid::Boundaries(core::grid_of(scene, ranks), fluid::ends_of(scene),
                                   scene.column.outlet == core::Outlet::open, fluid::crossed_sides(scene),
                                   fluid::open_faces(core::grid_of(scene, ranks), scene)),
                 fluid::Inlet(core::grid_of(scene, ranks), scene), make_discretisation(scene.tfm, momentum_), timers),
      exits_(constants().grid, scene),
      integrator_(choose_integrator(scene, constants(), effects(), inlet().greatest())),
      layout_(constants().grid, int(constants().species()),
              integrator_.kind == core::TfmIntegrator::implicit_steps || compressible(), transports_temperature(),
              constants().openings.passages()),
      pressure_scale_(scene.fluid.outlet_pressure * (100.0 / 101325)) {
  column_size_ = layout_of_column().size();
  constexpr double least_scale = 1e-6;  // m/s, without fall and inflow: a tolerance cannot be 0
  // No solids fall faster than in free fall through the whole column, which limits the terminal velocity.
  const double terminal =
      std::min(greatest_terminal_velocity(constants()), std::sqrt(2 * constants().gravity * scene.column.size[1]));
  velocity_scale_ = std::max({0.1 * terminal, inlet().greatest(), constants().openings.greatest(), least_scale});
  fill_state(scene);
  make_parts();
  for (const auto& part : parts_) part->start(time_, y_);
  stepping_ = make_stepping(integrator_.kind, equations_, layout_, options_,
                            tolerances_of(equations_, layout_, kept_tolerance(integrator_.kind, options_.rtol),
                                          velocity_scale_, pressure_scale_),
                            timers);
  begin_integration();
}

Model::~Model() = default;

/// The bed at rest, in the flow from the inlet.
void Model::fill_state(const core::Scene& scene) {
  const core::Grid& grid = constants().grid;
  Fields& fields = equations_.fields();
  fill_bed(scene, constants(), effects().solids_stress.get(), fields.solids);
  constants().openings.set_velocities(time_, fields.solids);
  // In a column with changing diameter the flow adjusts around solids at rest, as after a jump.
  const bool tapered = grid.metric && grid.metric->tapered();
  const double inflow = tapered ? 0 : inlet().mean_velocity(0);
  core::for_each_row(grid, core::owned_faces(grid, 1), [&](Index begin, Index end) {
    std::fill(fields.fluid.flux[1].begin() + begin, fields.fluid.flux[1].begin() + end, inflow);
  });
  core::FaceField even = core::make_face_field(grid);  // inflow before jets and sides have their own velocities
  for (const int side : {0, 1}) {
    if (side == 1 && boundaries().has_outlet()) continue;
    fluid::for_each_boundary_row(grid, 1, side, [&](Index begin, Index end) {
      std::fill(even[1].begin() + begin, even[1].begin() + end, inflow);
    });
  }
  y_.resize(layout_.size());
  dydt_.assign(layout_.size(), 0.0);
  layout_.pack(fields.solids, fields.fluid, y_);
  project_jump(equations_, layout_, velocity_scale_, time_, even, y_);
  if (!tapered) return;
  for (core::FaceField& velocity : fields.solids.velocity)
    for (core::Field& u : velocity) std::fill(u.begin(), u.end(), 0.0);
  layout_.pack(fields.solids, fields.fluid, y_);
}

template <class Made, class... Args>
Made* Model::add_part(Args&&... args) {
  auto part = std::make_unique<Made>(std::forward<Args>(args)...);
  Made* made = part.get();
  parts_.push_back(std::move(part));
  return made;
}

void Model::make_parts() {
  const bool implicit = integrator_.kind == core::TfmIntegrator::implicit_steps;
  if (options_.follow_bed && !implicit && !constants().grid.periodic[1] && !compressible() &&
      !transports_temperature() && !constants().openings.present())
    add_part<FollowBed>(equations_, layout_);
  if (compressible())
    compressible_fluid_ = add_part<CompressibleFluid>(equations_, layout_, timers_);
  else
    add_part<InletJump>(equations_, layout_, velocity_scale_);
  packing_check_ = add_part<PackingCheck>(constants(), layout_, effects().solids_stress.get());
  if (options_.flux == core::FractionFlux::limited)
    add_part<FirstOrder>(equations_, layout_, fraction_tolerance(options_.rtol));
}

void Model::go_on_above_packing(bool go_on) { packing_check_->go_on_above_packing(go_on); }

std::optional<fluid::MassAccount> Model::fluid_account(double t) const {
  if (compressible_fluid_ == nullptr) return std::nullopt;
  return compressible_fluid_->account(t);
}

/// Starts the integrator at (time_, y_).
void Model::begin_integration() {
  equations_.begin(time_);
  equations_.drive(layout_, y_);
  prepare(y_);
  stepping_->find_rates(time_, y_, dydt_);
  for (const auto& part : parts_) part->begin(time_);
  integrator().restart(time_, y_, dydt_, step_ > 0 ? step_ : stepping_->first_step(y_, dydt_));
}

void Model::prepare(std::span<const double> y) {
  for (const auto& part : parts_) part->prepare(y);
  stepping_->begin_step(step_);
}

void Model::step(double stop) {
  prepare(integrator().state());
  const core::StepReport report = integrator().step(stop);
  accept(report);
  for (const auto& part : parts_) part->end_step(integrator().state());
  last_step_.limited_by = report.time >= stop && report.step < 0.99 * report.next_step ? "event" : what_limited(report);
}

/// If a part rejects the step, the state is the one before it.
void Model::accept(const core::StepReport& report) {
  time_ = report.time;
  step_ = report.next_step;
  last_step_ = {report.time, report.step, report.error_norm, ""};
  try {
    for (const auto& part : parts_) part->accept(time_, integrator().state());
  } catch (const core::NumericsError&) {
    time_ -= report.step;
    integrator().interpolate(time_, y_);
    throw;
  }
}

/// The text of the rank that has the limit.
std::string Model::what_limited(const core::StepReport& report) const {
  const core::Grid& grid = constants().grid;
  const TimeScale nearest = nearest_of(stepping_->time_scales());
  const int rank = core::rank_of_greatest(grid, -nearest.seconds);
  if (report.step >= limiting_share * core::least_of_ranks(grid, nearest.seconds))
    return core::said_by(grid, rank, place_of(nearest, grid));
  const int worst = core::rank_of_greatest(grid, report.worst_error);
  return core::said_by(grid, worst, "error test: " + layout_.describe(report.worst_entry, constants().name));
}

void Model::show(double t) {
  if (t != time_ || y_.empty())
    integrator().interpolate(t, y_);
  else
    std::copy(integrator().state().begin(), integrator().state().end(), y_.begin());
  Fields& fields = equations_.fields();
  const core::Field pressure = fields.fluid.pressure;
  if (!equations_.evaluate(t, layout_, y_))
    throw core::NumericsError(fmt::format("t = {:.6g} s: the state cannot be evaluated", t));
  if (!layout_.with_pressure()) fields.fluid.pressure = pressure;
  fluid::set_outlet_pressure(constants().grid, boundaries(), fields.fluid.pressure);
}

void Model::restart() {
  const auto state = integrator().state();
  std::copy(state.begin(), state.end(), y_.begin());
  for (const auto& part : parts_) part->restart(time_, y_);
  begin_integration();
}

std::vector<double> Model::breakpoints() const {
  std::vector<double> times = inlet().breakpoints();
  const std::vector<double> of_feeds = constants().openings.breakpoints();
  times.insert(times.end(), of_feeds.begin(), of_feeds.end());
  return times;
}

Work Model::work() const {
  Work done = before_;
  stepping_->count(done);
  for (const auto& part : parts_) part->count(done);
  return done;
}

}  // namespace polybed::tfm
