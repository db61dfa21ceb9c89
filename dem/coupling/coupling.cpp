#include "dem/coupling/coupling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "closures/own_wake.hpp"
#include "closures/sphere.hpp"
#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "core/vectors.hpp"
#include "dem/coupling/kernel.hpp"
#include "dem/scene.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

using core::Field;
using core::Index;

namespace {

/// Relative residual of the pressure: sets the remaining div J in a step of the fluid.
constexpr double pressure_tolerance = 1e-8;

std::vector<double> diameters(const Materials& materials) {
  std::vector<double> d;
  for (const Species& s : materials.species()) d.push_back(2 * s.radius);
  return d;
}

int every_of(const core::Scene& scene) { return scene.dem.fluid_every.value_or(core::most_fluid_every); }

/// Full width of the kernel, m.
double width_of(const core::Scene& scene, const Materials& materials, std::int64_t count) {
  const double cell = core::grid_of(scene, nullptr).smallest_spacing();
  return kernel_of(scene, cell, materials.greatest_diameter(), count).width;
}

/// The wakes of few particles; none where the formula is invalid: in two dimensions, without viscous stress, where a
/// wake never decays, or in cells so small that a particle sees mostly itself.
std::optional<OwnWake> own_wake_of(const core::Scene& scene, const core::Grid& grid, double width, double diameter,
                                   std::int64_t count) {
  const bool bed = is_fed(scene) || count >= std::int64_t(fluid::fewest_of_a_bed);
  if (bed || grid.dimensions < 3 || !core::acts(scene, "fluid_stress")) return {};
  constexpr double most = 0.5;  // share of the slip
  double square = 0;
  for (const double h : grid.spacing) square += h * h / 3;
  const OwnWake wake{2 * 2 * fluid::smoothing_time(width), std::sqrt(square)};
  const Lines in_one_cell;
  const double creeping = closures::own_wake(1, 0, wake.spread(in_one_cell, {}), 0) * 3 * std::numbers::pi * diameter;
  return creeping < most ? std::optional(wake) : std::nullopt;
}

/// Whether each rank solves for a block of the fluid. The kernel's smoothing needs the whole column.
bool shares_fluid(const core::Scene& scene, const Materials& materials, std::int64_t count) {
  constexpr std::size_t worth_sharing = 20'000;  // cells: below it, messages cost more than they save
  const core::FluidRanks wish = scene.dem.fluid_ranks;
  const bool wide = width_of(scene, materials, count) > 0;
  if (wish == core::FluidRanks::shared && wide)  // for a list, whose particles no rule counts
    throw core::StartError(std::vector{scene.places.problem(
        {"dem.fluid_ranks"},
        "dem.fluid_ranks = \"shared\" does not go with a kernel of diffusion, which needs the whole column: use "
        "\"each\", or cells of at least 1.5 diameters with dem.kernel = \"bilinear\"")});
  if (wide || wish == core::FluidRanks::each) return false;
  return wish == core::FluidRanks::shared || core::grid_of(scene, nullptr).cell_count() >= worth_sharing;
}

std::optional<double> given_gradient_of(const core::Scene& scene) {
  const double* given = std::get_if<double>(&scene.column.pressure_gradient);
  return given != nullptr ? std::optional(*given) : std::nullopt;
}

/// Changes in a step of the fluid, on faces.
struct FluidChange {
  const core::FaceField &velocity, &gradient;  ///< m/s, Pa/m
  const core::FaceField* convected;            ///< of the velocity, m/s; null: no particle has added mass
};

/// The effect of the fluid's change on the particles over the step: see fluid::ParticlePhase.
template <bool round>
void push_by(FluidChange change, double dt, const Gather& gather, FluidMotion& motion, Particles& particles) {
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const FluidLoad& f = motion.load[i];
    Motion& m = particles.motion[i];
    const double volume = closures::sphere_volume(particles.place[i].radius);
    const double inertia = 1 / m.inverse_mass + f.added, x = f.drag * dt / inertia, s = mean_decay(x);
    const auto lines = gather.shares<round>(particles.place[i].x);
    const Vector du = gather.vector(lines, change.velocity), dg = gather.vector(lines, change.gradient);
    Vector dv;
    for (std::size_t k = 0; k < 3; ++k) dv[k] = x * s * du[k] - volume / inertia * s * dt * dg[k];
    if (change.convected != nullptr) {
      const Vector c = gather.vector(lines, *change.convected);
      for (std::size_t k = 0; k < 3; ++k) dv[k] += f.added / inertia * s * (du[k] + c[k]);
    }
    motion.account_coupling(m, dv);
    for (std::size_t k = 0; k < 3; ++k) m.v[k] += dv[k];
  }
}

}  // namespace

Coupling::Coupling(const core::Scene& scene, const Materials& materials, std::shared_ptr<const core::Ranks> ranks,
                   core::Timers& timers, Units units, double dt, double speed, double volume, std::int64_t count)
    : ranks_(ranks),
      timers_(timers),
      flow_(scene, core::grid_of(scene, shares_fluid(scene, materials, count) ? ranks : nullptr), pressure_tolerance),
      fraction_(materials.species().size(), core::make_field(flow_.grid())),
      at_ends_(core::make_field(flow_.grid())),
      given_gradient_(given_gradient_of(scene)),
      width_(width_of(scene, materials, count)),
      smoothing_(core::whole_column(flow_.grid()), width_, !flow_.boundaries().has_outlet()),
      forces_(scene, materials, flow_.constants().density, flow_.constants().viscosity),
      sides_(scene, materials, flow_.constants().density, flow_.constants().viscosity, dt, every_of(scene) * dt),
      phase_(flow_.grid(), has_inertia()),
      scatter_(core::whole_column(flow_.grid()), flow_.grid(), materials, has_inertia(), volume, speed),
      gather_(core::whole_column(flow_.grid()), diameters(materials), scatter_.round()),
      motion_(materials, flow_.constants().density, gravity_of(scene), units.force, units.energy, scene.dem.ledger),
      every_(every_of(scene)),
      held_(scene.bed.held),
      dt_(dt),
      // The greatest force has 2^62 units: its square 2^32 of these, and a sum has room for a thousand million of them.
      per_square_(std::ldexp(units.force.per_unit * units.force.per_unit, -92)) {
  if (const auto wake =
          own_wake_of(scene, core::whole_column(flow_.grid()), width_, materials.greatest_diameter(), count))
    forces_.see_past_own_wake(*wake);
  if (const Box box = box_of(scene); !box.openings.empty() || is_fed(scene)) scatter_.open(box);
  if (scene.dem.own_share == core::OwnShare::removed)
    own_.emplace(core::whole_column(flow_.grid()), smoothing_, diameters(materials), forces_.needs_squares(),
                 scatter_.open_faces());
  for (Field& component : vorticity_)
    if (sides_.needs_vorticity()) component = core::make_field(flow_.grid());
  if (!flow_.grid().ranks) return;
  const core::Grid column = core::whole_column(flow_.grid());
  exchange_.emplace(column, flow_.grid(), ranks_);
  fraction_here_.assign(fraction_.size(), core::make_field(column));
  velocity_here_ = gradient_here_ = core::make_face_field(column);
}

Coupling::~Coupling() = default;

void Coupling::begin(Particles& particles) {
  motion_.load.assign(particles.owned, FluidLoad{});
  drive(particles);
  take_fields();
  collect(particles);
  flow_.begin(0, phase_);
  if (frame_) frame_->momentum = frame_->now = momentum_of(particles);
  take_fields();
  forces_.find(particles, gather_, motion_.load, own());
  sides_.begin(particles, gather_, motion_.load);
  relax(particles);
}

/// Sets the mean gradient of the pressure between joined ends: as given, or the one that carries all particles.
void Coupling::drive(const Particles& particles) {
  if (!flow_.grid().periodic[1]) return;
  if (given_gradient_) return flow_.drive(*given_gradient_);
  const std::vector<Species>& species = scatter_.species();
  std::vector<std::int64_t> number(species.size(), 0);
  for (std::size_t i = 0; i < particles.owned; ++i) ++number[std::size_t(particles.species[i])];
  core::add_over_ranks(ranks_.get(), number);
  const double box = double(flow_.grid().column_cell_count()) * flow_.grid().cell_volume();
  double weight = 0, mass = flow_.constants().density * box;  // net_gravity() is times 1 - rho_f/rho_p
  for (std::size_t j = 0; j < species.size(); ++j) {
    weight += double(number[j]) * species[j].mass * motion_.net_gravity(std::int32_t(j))[1];
    mass += double(number[j]) * species[j].mass * (1 - flow_.constants().density / species[j].density);
  }
  flow_.drive(weight / box);
  const auto& joined = flow_.grid().periodic;
  if (joined[0] && (joined[2] || flow_.grid().dimensions == 2) && !held_) frame_ = Frame{{}, {}, {}, mass};
}

/// Of particles and fluid, kg m/s. Collective. \pre the sums over particles are those of the fluid's last step
Vector Coupling::momentum_of(const Particles& particles) const {
  const core::Grid& grid = flow_.grid();
  Vector sum{};
  for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a) {
    std::vector<double> solids, fluid;
    for (std::size_t i = 0; i < particles.owned; ++i)
      solids.push_back(particles.motion[i].v[a] / particles.motion[i].inverse_mass);
    const double face = flow_.constants().density * grid.cell_volume();
    core::for_each_row(grid, core::owned_faces(grid, int(a)), [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        fluid.push_back(face * phase_.voidage_on[a][c] * flow_.state().velocity[a][c]);
    });
    sum[a] = core::sum_of_ranks(ranks_.get(), solids) + core::sum_of_ranks(grid, fluid);
  }
  return sum;
}

/// The voidage on faces changes a little otherwise than by what crosses them, as averages over particles are not exact,
/// and its momentum with it. Nothing would take that up again in a box without walls: all is moved by one velocity.
void Coupling::keep_momentum(Particles& particles) {
  Frame& frame = *frame_;
  const Vector found = momentum_of(particles);
  Vector back{};
  for (std::size_t a = 0; a < std::size_t(flow_.grid().dimensions); ++a)
    back[a] = (frame.momentum[a] - found[a]) / frame.mass;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    motion_.account_coupling(particles.motion[i], back);
    for (std::size_t a = 0; a < 3; ++a) particles.motion[i].v[a] += back[a];
  }
  flow_.shift(back);
  for (std::size_t a = 0; a < 3; ++a) frame.velocity[a] += back[a];
  frame.now = momentum_of(particles);
}

void Coupling::find_forces(const Particles& particles, std::uint64_t timed) {
  if (stand()) return;
  const auto scope = timers_.scope("fluid forces", timed);
  forces_.find(particles, gather_, motion_.load, own());
  sides_.find(particles, gather_, motion_.load);
  relax(particles);
}

void Coupling::hold(const Particles& particles) {
  for (std::size_t i = 0; i < particles.owned; ++i) {
    FluidLoad& f = motion_.load[i];
    for (std::size_t k = 0; k < 3; ++k) f.impulse[k] += f.drag * dt_ * f.velocity[k];
  }
  sides_.hold(motion_.load);
}

/// Recomputes the loads at the end of a fluid step and applies the correction for their change.
void Coupling::correct(Particles& particles) {
  before_ = motion_.load;
  forces_.find(particles, gather_, motion_.load, own());
  const double dt = interval();
  for (std::size_t i = 0; i < particles.owned; ++i) {
    Motion& m = particles.motion[i];
    const LoadChange change = change_of(before_[i], motion_.load[i], m, dt);
    motion_.account_coupling(m, change.dv);
    motion_.load[i].impulse = before_[i].impulse;
    for (std::size_t k = 0; k < 3; ++k) {
      motion_.load[i].impulse[k] += change.impulse[k];
      m.v[k] += change.dv[k];
    }
    changes_.change.add(change.square * per_square_);
    changes_.force.add(change.force_square * per_square_);
  }
}

void Coupling::advance(Particles& particles, double t, Arrivals arrivals) {
  const double dt = interval();
  {
    const auto scope = timers_.scope("fluid forces");
    if (stand()) correct(particles);
  }
  see(std::move(arrivals));
  {
    const auto scope = timers_.scope("fluid: particles' sums");
    collect(particles);
  }
  {
    const auto scope = timers_.scope("fluid");
    last_ = flow_.advance(t - dt, dt, phase_);
    weigh();
  }
  ++steps_;
  const auto scope = timers_.scope("fluid: two-way coupling");
  if (!held_) couple_two_way(particles);
  if (frame_) keep_momentum(particles);
  for (FluidLoad& load : motion_.load) load.impulse = {};
  take_fields();
  forces_.find(particles, gather_, motion_.load, own());
  sides_.refresh(particles, gather_, motion_.load);
  relax(particles);
}

void Coupling::take_in(const Particles& particles, std::int64_t first) {
  collect(particles);
  take_fields();
  const std::vector<FluidLoad> loads = motion_.load;
  const SideRows rows = sides_.rows();
  forces_.find(particles, gather_, motion_.load, own());
  sides_.begin(particles, gather_, motion_.load);
  for (std::size_t i = 0; i < particles.owned; ++i) {
    if (particles.id[i] >= first) continue;
    motion_.load[i] = loads[i];
    std::copy_n(rows.of(i), rows.width, sides_.rows().of(i));
  }
  relax(particles);
}

void Coupling::collect(const Particles& particles) {
  if (held_)
    scatter_.collect_held(ranks_.get(), particles, motion_.load, interval());
  else
    scatter_.collect(particles, motion_.load, interval());
  if (exchange_) exchange_->choose(particles);
  scatter_.give(ranks_.get(), exchange_ ? &*exchange_ : nullptr, flow_.boundaries().has_outlet(), phase_, fraction_);
  if (smoothing_.present()) smooth_sums();
  require_voidage();
}

/// \pre the voidage is up to date
void Coupling::require_voidage() const {
  const core::Grid& grid = flow_.grid();
  double least = 1;
  std::array<int, 3> at{};
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i)
        if (const double eps = phase_.voidage[std::size_t(grid.index(i, j, k))]; eps < least) {
          least = eps;
          at = {i, j, k};
        }
  const int worst = core::rank_of_greatest(grid, -least);
  if (core::least_of_ranks(grid, least) > fluid::voidage_floor) return;
  const char* remedy =
      smoothing_.present() ? "a wider dem.kernel_width" : "dem.kernel = \"diffusion\", or larger cells";
  const auto centre = [&](std::size_t a) { return grid.centre(int(a), at[a]); };
  const std::string text = fmt::format(
      "the cell near ({:.6g}, {:.6g}, {:.6g}) m has a voidage of {:.3g}: its particles do not fit into it; use {}",
      centre(0), centre(1), centre(2), least, remedy);
  throw core::NumericsError(core::said_by(grid, worst, text));
}

void Coupling::couple_two_way(Particles& particles) {
  core::FaceField change = flow_.velocity_change(), push = flow_.gradient_change(), carried;
  if (phase_.added_mass()) carried = flow_.convected();
  for (core::FaceField* field : {&change, &push, &carried}) smooth(*field);
  slip(change);
  if (exchange_) here({&change, &push, &carried});
  const FluidChange all{change, push, phase_.added_mass() ? &carried : nullptr};
  if (gather_.round())
    core::in_vectors<push_by<true>>(all, interval(), gather_, motion_, particles);
  else
    core::in_vectors<push_by<false>>(all, interval(), gather_, motion_, particles);
}

}  // namespace polybed::dem
