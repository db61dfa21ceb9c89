#include "dem/coupling/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "closures/sphere.hpp"
#include "core/numerics/metric.hpp"
#include "core/vectors.hpp"

namespace polybed::dem {

using core::Field;

Scatter::Scatter(const core::Grid& grid, const core::Grid& block, const Materials& materials, bool added_mass,
                 double all, double speed)
    : grid_(grid),
      block_(block),
      weights_(grid),
      species_(materials.species()),
      count_(added_mass ? carry_flux + 1 : yield + 1),
      of_axis_(4 * fours(count_)),
      width_(std::size_t(grid.dimensions) * of_axis_ + species_.size()),
      round_(round_weights(grid)) {
  double lightest = species_.front().density, heaviest = lightest;
  for (const Species& s : species_) {
    lightest = std::min(lightest, s.density);
    heaviest = std::max(heaviest, s.density);
  }
  // Bounds each sum by all particles in one place, with this reserve for speeds above the expected ones.
  constexpr double reserve = 64;
  const double mass = all * heaviest;
  for (const double most :
       {all, all * speed * reserve, mass * speed * reserve, mass * reserve, all, all, all / lightest, mass, all})
    unit_.push_back(FixedPoint::for_sums_of(most, 1));
  sums_.resize(grid.padded_size() * width_);
}

void Scatter::collect(const Particles& particles, const std::vector<FluidLoad>& loads, double dt) {
  std::fill(sums_.begin(), sums_.end(), 0);
  with_count([&](const auto count, const auto round) {
    if (open_)
      core::in_vectors<add_moving<count(), true, round()>>(*this, particles, loads, dt);
    else
      core::in_vectors<add_moving<count(), false, round()>>(*this, particles, loads, dt);
  });
}

/// Calls act with the number of sums and whether the column is round, both compile-time constants.
template <class Act>
void Scatter::with_count(Act&& act) const {
  const auto counted = [&](const auto round) {
    count_ > yield + 1 ? act(std::integral_constant<std::size_t, carry_flux + 1>(), round)
                       : act(std::integral_constant<std::size_t, yield + 1>(), round);
  };
  round_ ? counted(std::true_type()) : counted(std::false_type());
}

template <std::size_t count, bool open, bool round>
void Scatter::add_moving(Scatter& sums, const Particles& particles, const std::vector<FluidLoad>& loads, double dt) {
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const Place& place = particles.place[i];
    const Motion& m = particles.motion[i];
    const FluidLoad& f = loads[i];
    const double v = closures::sphere_volume(place.radius), mass = 1 / m.inverse_mass, inertia = mass + f.added;
    const double x = f.drag * dt / inertia, s = mean_decay(x), g = x * s, a = f.added / inertia * s;
    const Given given{v,
                      {mass * (g + a), v * (g + a), v * (1 - mass / inertia * s), v * v * s / inertia, mass * a, v * a},
                      m.v,
                      f.impulse,
                      std::size_t(particles.species[i])};
    if constexpr (open) {
      if (sums.open_->cuts(place, particles.id[i])) {
        sums.add_cut<count, round>(place, particles.id[i], given);
        continue;
      }
    }
    sums.add<count>(sums.shares<round>(place.x), given);
  }
}

/// All contributions, times the share that is inside: the fluid beyond the face takes the rest.
template <std::size_t count, bool round>
void Scatter::add_cut(const Place& place, std::int64_t id, Given given) {
  const double share = open_->inside(place, id);
  given.volume *= share;
  for (double& amount : given.same) amount *= share;
  for (double& component : given.impulse) component *= share;
  auto kept = shares<round>(place.x);
  weaken_upright_faces(kept, open_->on_faces(place));
  add<count>(kept, given);
}

void Scatter::collect_held(const core::Ranks* ranks, const Particles& particles, const std::vector<FluidLoad>& loads,
                           double dt) {
  fit_units(ranks, loads, dt);
  std::fill(sums_.begin(), sums_.end(), 0);
  with_count([&](const auto count, const auto round) {
    for (std::size_t i = 0; i < particles.owned; ++i) {
      const Place& place = particles.place[i];
      add<count()>(shares<round()>(place.x), {closures::sphere_volume(place.radius),
                                              {loads[i].drag * dt, 0, 0, 0, 0, 0},
                                              {},
                                              loads[i].impulse,
                                              std::size_t(particles.species[i])});
    }
  });
}

/// The mass does not bound the impulse on held particles in a step: the units suit the greatest of each, times their
/// number, and are the same on any number of ranks.
void Scatter::fit_units(const core::Ranks* ranks, const std::vector<FluidLoad>& loads, double dt) {
  double most_drag = 0, most_impulse = 0;
  for (const FluidLoad& f : loads) {
    most_drag = std::max(most_drag, f.drag * dt);
    for (const double i : f.impulse) most_impulse = std::max(most_impulse, std::abs(i));
  }
  std::array<double, 1> number{double(loads.size())};
  core::add_over_ranks(ranks, number);
  most_drag = core::greatest_of_ranks(ranks, most_drag);
  most_impulse = core::greatest_of_ranks(ranks, most_impulse);
  if (most_drag > 0) unit_[Sum::drag] = FixedPoint::for_sums_of(most_drag, number[0]);
  if (most_impulse > 0) unit_[Sum::impulse] = FixedPoint::for_sums_of(most_impulse, number[0]);
}

template <std::size_t count, class Shares>
void Scatter::add(const Shares& shares, const Given& given) {
  const double v = given.volume;
  // Copies, as the compiler must assume that a written sum could be a member.
  std::int64_t* const sums = sums_.data();
  const std::size_t width = width_;
  const int dimensions = grid_.dimensions;
  constexpr std::size_t many = fours(count);
  Four units[many] = {};  // for the sums on a face; the last ones can be unused
  const auto set = [&](std::size_t q, double amount) { units[q / 4][q % 4] = amount * unit_[q].per_unit; };
  set(Sum::volume, v);
  for (std::size_t q = drag; q < count; ++q) set(q, given.same[q - drag]);
  for (int axis = 0; axis < dimensions; ++axis) {
    const auto a = std::size_t(axis);
    set(flux, v * given.velocity[a]);
    set(Sum::impulse, given.impulse[a]);
    for_each_face(dimensions, shares, axis, [&](std::size_t at, double w) {
      std::int64_t* sum = sums + at * width + a * 4 * many;
      for (std::size_t n = 0; n < many; ++n) add_whole(w * units[n], sum + 4 * n);
    });
  }
  const std::size_t cell = std::size_t(dimensions) * 4 * many + given.species;
  for_each_cell(dimensions, shares,
                [&](std::size_t at, double w) { sums[at * width + cell] += std::int64_t(w * units[0][0]); });  // volume
}

/// Sums over all ranks. A column is mostly empty above its bed: sends only the range of entries that any rank has
/// filled.
void Scatter::add_up(const core::Ranks* ranks) {
  if (ranks == nullptr) return;
  const auto filled = [](std::int64_t sum) { return sum != 0; };
  const auto first = std::find_if(sums_.begin(), sums_.end(), filled);
  const auto last = std::find_if(sums_.rbegin(), sums_.rend(), filled).base();
  const auto begin = std::size_t(-core::greatest_of_ranks(ranks, -double(first - sums_.begin())));
  const auto end = std::size_t(core::greatest_of_ranks(ranks, double(last - sums_.begin())));
  if (begin < end) core::add_over_ranks(ranks, std::span(sums_).subspan(begin, end - begin));
}

void Scatter::give(const core::Ranks* ranks, const GridExchange* exchange, bool open_top, fluid::ParticlePhase& phase,
                   std::vector<Field>& fraction) {
  if (exchange != nullptr) {
    shared_.resize(block_.padded_size() * width_);
    exchange->add(width_, sums_, shared_);
  } else {
    add_up(ranks);
  }
  const std::span<const std::int64_t> sums = exchange != nullptr ? shared_ : sums_;
  const double per_cell = 1 / grid_.cell_volume(), unit = unit_[volume].unit * per_cell;
  std::fill(phase.voidage.begin(), phase.voidage.end(), 1.0);
  for (std::size_t j = 0; j < species_.size(); ++j) {
    const std::size_t cell = std::size_t(grid_.dimensions) * of_axis_ + j;
    core::with_metric(block_, [&](const auto& metric) {
      for (std::size_t c = 0; c < block_.padded_size(); ++c) {
        fraction[j][c] = double(sums[c * width_ + cell]) * unit * metric.per_volume(core::Index(c));
        phase.voidage[c] -= fraction[j][c];
      }
    });
  }
  give_faces(sums, open_top, phase);
}

void Scatter::give_faces(std::span<const std::int64_t> sums, bool open_top, fluid::ParticlePhase& phase) const {
  const double per_cell = 1 / grid_.cell_volume();
  const std::array<core::FaceField*, 9> fields{&phase.voidage_on, &phase.flux,   &phase.impulse,
                                               &phase.drag,       &phase.follow, &phase.slide,
                                               &phase.yield,      &phase.carry,  &phase.carry_flux};
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    std::array<double*, 9> field{};
    std::array<double, 9> unit{};
    for (std::size_t q = 0; q < count_; ++q) {
      field[q] = (*fields[q])[a].data();
      unit[q] = unit_[q].unit * per_cell;
    }
    core::with_metric(block_, [&](const auto& metric) {
      for (std::size_t c = 0; c < block_.padded_size(); ++c)
        for (std::size_t q = 0; q < count_; ++q)
          field[q][c] = double(sums[c * width_ + a * of_axis_ + q]) * unit[q] * metric.per_volume_on(a, core::Index(c));
    });
    // The faces of the outlet represent half a cell.
    if (axis == 1 && open_top && block_.ends(1, 1))
      core::for_each_row(block_, {0, block_.cells[1], 0}, {block_.cells[0], block_.cells[1] + 1, block_.cells[2]},
                         [&](core::Index begin, core::Index end) {
                           for (std::size_t q = 0; q < count_; ++q)
                             for (auto c = std::size_t(begin); c < std::size_t(end); ++c) (*fields[q])[1][c] *= 2;
                         });
  }
  for (std::size_t q = 0; q < count_; ++q) core::hold_closed(block_, *fields[q]);
  for (Field& component : phase.voidage_on)
    for (double& eps : component) eps = 1 - eps;
}

}  // namespace polybed::dem
