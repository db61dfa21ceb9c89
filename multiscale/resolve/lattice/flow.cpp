#include "multiscale/resolve/lattice/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace polybed::multiscale::lattice {

namespace {

/// Covered sites between two fluid sites in a row that a run still includes: cheaper than another run.
constexpr int bridge = 12;

Sites sites_of(const std::array<int, 3>& box) { return {box, std::size_t(box[2] + 2)}; }

/// Distance of two directions in memory. Nineteen streams at the same page offset would share one set of the cache.
template <class Real>
std::size_t stride_of(const Sites& sites) {
  constexpr std::size_t page = 4096 / sizeof(Real), line = 64 / sizeof(Real);
  return (sites.count() + page - 1) / page * page + 3 * line;
}

template <class Real, bool inertia>
void collide(std::array<Real*, directions> place, std::size_t length, const Relaxation<Real>& relaxation) {
  collide_row<Real, inertia>(place.data(), length, relaxation);
}

/// Bounces departing populations back along links, and returns the impulse. No link reads another's output.
/// \param last  end of all links: the four places of later links, which are scattered, are prefetched
template <bool second, class Link, class Real>
double bounced(Real* f, const Link* links, std::size_t count, const Link* last) {
  constexpr std::ptrdiff_t ahead = 12;
  double sum[2] = {0, 0};  // two, as each addition waits for the previous one
#pragma GCC ivdep
  for (std::size_t n = 0; n < count; ++n) {
    const Link& link = links[n];
    const Link& coming = last - &link > ahead ? (&link)[ahead] : *last;
    for (const std::uint32_t place : {coming.fluid, coming.covered, coming.here, coming.behind})
      __builtin_prefetch(f + place, 1);
    const Real leaving = f[second ? link.covered : link.fluid];
    const Real difference = f[second ? link.here : link.behind] - f[second ? link.behind : link.here];
    const Real back = leaving + link.part * difference;
    f[second ? link.fluid : link.covered] = back;
    sum[n % 2] += double(leaving) + double(back);
  }
  return sum[0] + sum[1];
}

}  // namespace

template <class Real>
Flow<Real>::Flow(const FlowSetup& setup, const Obstacles& obstacles)
    : setup_(setup), sites_(sites_of(setup.box)), stride_(stride_of<Real>(sites_)), halo_(sites_, stride_) {
  if (stride_ * directions > std::numeric_limits<std::uint32_t>::max())
    throw core::CaseError(
        fmt::format("a box of {} x {} x {} sites is too large", setup.box[0], setup.box[1], setup.box[2]));
  owner_ = obstacles.owners(sites_);
  on_obstacle_.resize(obstacles.count());
  find_runs();
  find_links(obstacles);
  populations_.assign(stride_ * directions, 0);
}

template <class Real>
void Flow<Real>::find_runs() {
  runs_.clear();
  fluid_sites_ = 0;
  layers_.assign(std::size_t(sites_.box[0]), {});
  for (int i = 1; i <= sites_.box[0]; ++i) {
    Span& runs = layers_[std::size_t(i - 1)].runs;
    runs.begin = runs_.size();
    for (int j = 1; j <= sites_.box[1]; ++j) {
      int last = -bridge - 2;  // previous fluid site
      for (int k = 1; k <= sites_.box[2]; ++k) {
        if (owner_[sites_.at(i, j, k)] != Obstacles::none) continue;
        ++fluid_sites_;
        if (k - last > bridge + 1)
          runs_.push_back({std::uint32_t(sites_.at(i, j, k)), 1});
        else
          runs_.back().length += std::uint32_t(k - last);
        last = k;
      }
    }
    runs.end = runs_.size();
  }
}

template <class Real>
void Flow<Real>::find_links(const Obstacles& obstacles) {
  struct Found {
    int layer;  // from 0; the rim comes after all layers
    std::int32_t owner, way;
    std::array<int, 3> at;
  };
  const auto layer_of = [&](const std::array<int, 3>& at, std::size_t way) {
    for (std::size_t k = 0; k < 3; ++k)
      if (ways[way][k] != 0 && (at[k] == 1 || at[k] == sites_.box[k])) return sites_.box[0];
    return at[0] - 1;
  };
  // From the covered sites, which are fewer than the fluid's.
  std::vector<Found> found;
  std::vector<std::uint64_t> order;  // by bundle, then in the order found
  for (int i = 0; i < sites_.box[0] + 2; ++i)
    for (int j = 0; j < sites_.box[1] + 2; ++j)
      for (int k = 0; k < sites_.box[2] + 2; ++k) {
        const std::int32_t owner = owner_[sites_.at(i, j, k)];
        if (owner == Obstacles::none) continue;
        for (std::size_t w = 1; w < directions; ++w) {
          const std::array<int, 3> fluid{i - ways[w][0], j - ways[w][1], k - ways[w][2]};
          if (!sites_.in_box(fluid) || owner_[sites_.at(fluid[0], fluid[1], fluid[2])] != Obstacles::none) continue;
          const std::size_t layer = std::size_t(layer_of(fluid, w));
          order.push_back(((layer * obstacles.count() + std::size_t(owner)) * directions + w) << 32 | found.size());
          found.push_back({int(layer), owner, std::int32_t(w), fluid});
        }
      }
  std::sort(order.begin(), order.end());
  rim_ = {};
  bundles_.clear();
  links_.clear();
  links_.reserve(found.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const Found& one = found[order[n] & 0xffffffff];
    Span& bundles = one.layer == sites_.box[0] ? rim_ : layers_[std::size_t(one.layer)].bundles;
    if (n == 0 || order[n - 1] >> 32 != order[n] >> 32) {
      if (bundles.end == 0) bundles.begin = bundles_.size();
      bundles_.push_back({std::uint32_t(n), 0, one.way, one.owner});
      bundles.end = bundles_.size();
    }
    links_.push_back(link_of(obstacles, one.at, std::size_t(one.way)));
    bundles_.back().end = std::uint32_t(n + 1);
  }
}

template <class Real>
auto Flow<Real>::link_of(const Obstacles& obstacles, const std::array<int, 3>& at, std::size_t way) const -> Link {
  const std::size_t site = sites_.at(at[0], at[1], at[2]), step = std::size_t(sites_.step(ways[way]));
  const std::size_t covered = site + step, back = site - step, here = place(way, site);
  Link link{std::uint32_t(place(opposite(way), site)), std::uint32_t(place(way, covered)), std::uint32_t(here),
            std::uint32_t(here), 0};
  // Between two walls one site apart, both equations together give the plain bounce.
  if (setup_.wall == Wall::half_way || owner_[back] != Obstacles::none) return link;
  const Point fluid{double(at[0] - 1), double(at[1] - 1), double(at[2] - 1)};
  const double q = obstacles.fraction(owner_[covered], fluid, ways[way]);
  link.behind = std::uint32_t(place(opposite(way), back));
  link.part = Real((1 - 2 * q) / (1 + 2 * q));
  return link;
}

template <class Real>
void Flow<Real>::collide(bool second, const Span& runs) {
  const double even = 1 / (0.5 + 3 * setup_.viscosity);
  const Relaxation<Real> relaxation{
      Real(even), Real(odd_rate(even)), {Real(force_[0]), Real(force_[1]), Real(force_[2])}};
  std::array<Real*, directions> origin;
  for (std::size_t i = 0; i < directions; ++i)
    origin[i] =
        populations_.data() + (second ? place(opposite(i), 0) : place(i, 0)) - (second ? sites_.step(ways[i]) : 0);
  for (std::size_t n = runs.begin; n < runs.end; ++n) {
    const Run& run = runs_[n];
    std::array<Real*, directions> at;
    for (std::size_t i = 0; i < directions; ++i) at[i] = origin[i] + run.begin;
    if (setup_.inertia)
      core::in_vectors<&lattice::collide<Real, true>>(at, run.length, relaxation);
    else
      core::in_vectors<&lattice::collide<Real, false>>(at, run.length, relaxation);
  }
}

/// Processes a layer's links as soon as the next layer is done, while both are in the cache: links reach one layer far,
/// and the collision of a covered site in a run must not overwrite their results.
template <class Real>
void Flow<Real>::collide_and_bounce(bool second) {
  for (std::size_t n = 0; n < layers_.size(); ++n) {
    collide(second, layers_[n].runs);
    if (n > 0) bounce(second, layers_[n - 1].bundles);
  }
  bounce(second, layers_.back().bundles);
}

template <class Real>
void Flow<Real>::bounce(bool second, const Span& bundles) {
  Real* const f = populations_.data();
  for (std::size_t n = bundles.begin; n < bundles.end; ++n) {
    const Bundle& bundle = bundles_[n];
    const Link* const begin = links_.data() + bundle.begin;
    const std::size_t count = bundle.end - bundle.begin;
    const double impulse =
        second ? bounced<true>(f, begin, count, &links_.back()) : bounced<false>(f, begin, count, &links_.back());
    const std::array<int, 3>& c = ways[std::size_t(bundle.way)];
    Point& on = on_obstacle_[std::size_t(bundle.owner)];
    for (std::size_t k = 0; k < 3; ++k) {
      on[k] += c[k] * impulse;
      on_all_[k] += c[k] * impulse;
    }
  }
}

template <class Real>
void Flow<Real>::advance(const Point& force) {
  force_ = force;
  on_all_ = {};
  steps_ += 2;
  collide_and_bounce(false);
  halo_.fill(populations_.data());
  bounce(false, rim_);
  if (!moving_links_.empty()) push_walls(false);
  collide_and_bounce(true);
  halo_.fold(populations_.data());
  bounce(true, rim_);
  if (!moving_links_.empty()) push_walls(true);
}

template <class Real>
std::vector<Point> Flow<Real>::forces() const {
  std::vector<Point> sum = on_obstacle_;
  for (Point& on : sum)
    for (double& component : on) component /= double(steps_);
  return sum;
}

template <class Real>
void Flow<Real>::forget_forces() {
  std::fill(on_obstacle_.begin(), on_obstacle_.end(), Point{});
  std::fill(torque_.begin(), torque_.end(), Point{});
  steps_ = 0;
}

template <class Real>
Point Flow<Real>::force() const {
  return {on_all_[0] / 2, on_all_[1] / 2, on_all_[2] / 2};
}

/// Between two steps, without the velocity's half force.
template <class Real>
Point Flow<Real>::momentum_at(std::size_t site) const {
  Point sum{};
  for (std::size_t w = 1; w < directions; ++w)
    for (std::size_t a = 0; a < 3; ++a) sum[a] += ways[w][a] * double(populations_[place(w, site)]);
  return sum;
}

template <class Real>
Point Flow<Real>::velocity_at(int i, int j, int k) const {
  const std::size_t site = sites_.at(i + 1, j + 1, k + 1);
  if (owner_[site] != Obstacles::none) return {};
  Point u = momentum_at(site);
  for (std::size_t a = 0; a < 3; ++a) u[a] += force_[a] / 2;
  return u;
}

template <class Real>
Point Flow<Real>::velocity() const {
  Point sum{};
  for (int i = 0; i < sites_.box[0]; ++i)
    for (int j = 0; j < sites_.box[1]; ++j)
      for (int k = 0; k < sites_.box[2]; ++k) {
        const Point u = velocity_at(i, j, k);
        for (std::size_t a = 0; a < 3; ++a) sum[a] += u[a];
      }
  for (double& component : sum) component /= double(sites_.box[0]) * sites_.box[1] * sites_.box[2];
  return sum;
}

template <class Real>
void Flow<Real>::level_density() {
  double sum = 0;
  for (std::size_t site = 0; site < owner_.size(); ++site) {
    if (owner_[site] != Obstacles::none || !sites_.in_box(sites_.place(site))) continue;
    for (std::size_t w = 0; w < directions; ++w) sum += double(populations_[place(w, site)]);
  }
  for (std::size_t w = 0; w < directions; ++w)
    for (std::size_t site = 0; site < owner_.size(); ++site)
      populations_[place(w, site)] -= Real(weight(w) * sum / fluid_sites_);
}

template <class Real>
std::vector<double> Flow<Real>::populations(std::size_t way) const {
  std::vector<double> values;
  values.reserve(std::size_t(sites_.box[0]) * sites_.box[1] * sites_.box[2]);
  for (int i = 1; i <= sites_.box[0]; ++i)
    for (int j = 1; j <= sites_.box[1]; ++j)
      for (int k = 1; k <= sites_.box[2]; ++k) values.push_back(double(populations_[place(way, sites_.at(i, j, k))]));
  return values;
}

template <class Real>
void Flow<Real>::restore_populations(std::size_t way, const std::vector<double>& populations) {
  std::size_t n = 0;
  for (int i = 1; i <= sites_.box[0]; ++i)
    for (int j = 1; j <= sites_.box[1]; ++j)
      for (int k = 1; k <= sites_.box[2]; ++k) populations_[place(way, sites_.at(i, j, k))] = Real(populations.at(n++));
}

template <class Real>
std::size_t Flow<Real>::memory_bytes() const {
  return populations_.size() * sizeof(Real) + owner_.size() * sizeof(owner_[0]) + links_.size() * sizeof(Link) +
         bundles_.size() * sizeof(Bundle) + runs_.size() * sizeof(Run) + moving_links_.size() * sizeof(MovingLink);
}

template class Flow<float>;
template class Flow<double>;

}  // namespace polybed::multiscale::lattice
