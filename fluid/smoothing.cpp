#include "fluid/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "core/numerics/metric.hpp"

namespace polybed::fluid {

namespace {
/// For cells much smaller than w the kernel along an axis is higher than the Gaussian and narrower at half height: by
/// 5.0 and 7.3 % with 8 steps, 2.4 and 3.6 % with 16, 1.2 and 1.8 % with 32. The cells soon matter more: at w of 4
/// cells it is 9.2 % higher with 16, 7.5 % with 32. The cost is proportional: with 16, 15 ns per cell and field in 2-D.
constexpr int steps = 16;
static_assert(steps % 2 == 0);

/// The faces of an axis to be smoothed.
core::Box free_faces(const core::Grid& grid, int axis, bool closed) {
  core::Box box = core::interior_faces(grid, axis);
  if (axis == 1 && !closed) box.hi[1] = grid.faces(1);
  return box;
}

/// Copies `count` entries of some lines between a field and a tile of LineDiffusion::lanes lines.
template <class Copy>
void for_each_entry(int count, core::Index stride, const core::Index* starts, int lines, Copy&& copy) {
  constexpr int lanes = LineDiffusion::lanes;
  for (int i = 0; i < count; ++i)
    for (int l = 0; l < lines; ++l) copy(i * lanes + l, starts[l] + i * stride);
}

/// Open shares of the entries of a round column. Closed faces are held.
class OpenEntries {
 public:
  /// \param of  axis of faces; -1: cells
  OpenEntries(const core::Grid& grid, int of) : metric_(*grid.metric), of_(of), low_(of < 0 ? 0 : grid.stride(of)) {}

  [[nodiscard]] double volume(core::Index c) const {
    if (of_ >= 0 && !(metric_.open[std::size_t(of_)][std::size_t(c)] > 0)) return 0;
    return mean(metric_.volume, c);
  }
  /// Open share between an entry and the previous one along an axis, over their distance. \param stride  of the axis
  [[nodiscard]] double between(core::Index c, int axis, core::Index stride) const {
    if (!(volume(c) > 0 && volume(c - stride) > 0)) return 0;
    const double per_length = axis != 1  ? 1.0
                              : of_ == 1 ? metric_.per_length[1][std::size_t(c - stride)]
                                         : metric_.per_distance[1][std::size_t(c)];
    return per_length * mean(metric_.open[std::size_t(axis)], c);
  }

 private:
  [[nodiscard]] double mean(const core::Field& field, core::Index c) const {
    return 0.5 * (field[std::size_t(c - low_)] + field[std::size_t(c)]);
  }

  const core::Metric& metric_;
  int of_;
  core::Index low_;
};
}  // namespace

double smoothing_width(double smallest_cell, double largest, double mean, std::size_t particles) {
  const bool single = particles < fewest_of_a_bed;
  constexpr double plain = 1.5;
  // In cells of 2.5 diameters a single sphere disturbs the fluid in its own cell so much that it falls 4.7 % too fast,
  // with the wide kernel 0.6 %.
  if (smallest_cell >= (single ? 5 : plain) * largest) return 0;
  return single ? 6 * largest : std::max(4 * mean, plain * largest);
}

double smoothing_time(double width) { return width * width / (16 * std::numbers::ln2); }

LineDiffusion::LineDiffusion(int count, bool joined, double lambda, int steps) : steps_(steps) {
  const auto n = std::size_t(count);
  if (joined) {
    const double root = 2 / (1 + std::sqrt(1 + 4 * lambda));  // 1 - q, of lambda (1 - q)^2 = q
    const double q = lambda * root * root, rest = 1 - q;      // from the rounded q, or the sum would drift for q near 1
    gain_.assign(n, rest * rest);
    carry_.assign(n, q);
    back_ = carry_;
    around_ = -1 / std::expm1(count * std::log1p(-rest));
    return;
  }
  double excess = 1;  // of the pivot over lambda: 1 + lambda (1 - lambda/previous pivot)
  for (std::size_t i = 0; i < n; ++i) {
    const double pivot = i + 1 < n ? lambda + excess : excess;
    gain_.push_back(1 / pivot);
    carry_.push_back(lambda / pivot);
    excess = 1 + lambda * (excess / pivot);
  }
  back_ = carry_;
}

LineDiffusion::LineDiffusion(const std::vector<double>& volume, const std::vector<double>& open, double lambda,
                             int steps)
    : steps_(steps) {
  double passed_on = 0;  // contribution to the pivot from the coupling with the previous entry
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const double below = lambda * open[i], above = i + 1 < volume.size() ? lambda * open[i + 1] : 0;
    const double excess = volume[i] + passed_on, pivot = volume[i] > 0 ? excess + above : 1;
    gain_.push_back(volume[i] > 0 ? volume[i] / pivot : 1);
    carry_.push_back(below / pivot);
    back_.push_back(above / pivot);
    passed_on = above * (excess / pivot);
  }
}

template <bool forward>
void LineDiffusion::pass(double* tile) const {
  const int n = count();
  double value[lanes] = {};
  const auto sweep = [&](auto&& store) {
    for (int m = 0; m < n; ++m) {
      const int i = forward ? m : n - 1 - m;
      const double gain = forward ? gain_[std::size_t(i)] : 1.0, carry = (forward ? carry_ : back_)[std::size_t(i)];
      double* entry = tile + i * lanes;
      for (int l = 0; l < lanes; ++l) value[l] = gain * entry[l] + carry * value[l];
      store(entry);
    }
  };
  if (around_ > 0) {
    sweep([](double*) {});
    for (double& v : value) v *= around_;
  }
  sweep([&](double* entry) { std::copy(value, value + lanes, entry); });
}

void LineDiffusion::apply(double* tile) const {
  for (int step = 0; step < steps_; ++step) {
    pass<true>(tile);
    pass<false>(tile);
  }
}

Smoothing::Sweeps Smoothing::sweeps(const core::Grid& grid, const core::Box& box, double time) {
  Sweeps result;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const int count = box.hi[a] - box.lo[a];
    if (count < 2) continue;
    const double lambda = time / steps / (grid.spacing[a] * grid.spacing[a]);
    Sweep sweep{axis, {count, grid.periodic[a], lambda, steps}, grid.stride(axis), {}};
    core::Box first = box;
    first.hi[a] = first.lo[a] + 1;
    core::for_each_row(grid, first, [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c) sweep.starts.push_back(c);
    });
    result.push_back(std::move(sweep));
  }
  return result;
}

/// Lines with the same coefficients, up to round-off, are smoothed together. Half of x comes before the others and half
/// after; in a tapered column half of y likewise within that.
Smoothing::Sweeps Smoothing::open_sweeps(const core::Grid& grid, int of, const core::Box& box, double time) {
  const OpenEntries entries(grid, of);
  Sweeps result;
  const auto add = [&](int axis, int share_of_steps) {
    const auto a = std::size_t(axis);
    const int count = box.hi[a] - box.lo[a];
    if (count < 2) return;
    const double lambda = time / steps / (grid.spacing[a] * grid.spacing[a]);
    const core::Index s = grid.stride(axis);
    std::map<std::vector<std::int64_t>, std::size_t> alike;
    core::Box first = box;
    first.hi[a] = first.lo[a] + 1;
    core::for_each_row(grid, first, [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c) {
        std::vector<double> volume, open{0};
        for (int i = 0; i < count; ++i) volume.push_back(entries.volume(c + i * s));
        for (int i = 1; i < count; ++i) open.push_back(entries.between(c + i * s, axis, s));
        std::vector<std::int64_t> key;
        for (const auto* part : {&volume, &open})
          for (const double share : *part) key.push_back(std::llround(share * 1e14));
        const auto [known, is_new] = alike.try_emplace(std::move(key), result.size());
        if (is_new) result.push_back({axis, LineDiffusion(volume, open, lambda, share_of_steps), s, {}});
        result[known->second].starts.push_back(c);
      }
    });
  };
  if (!grid.metric->cut() && !grid.metric->around_axis) {  // a graded box: even across, also over joined sides
    for (Sweep& even : sweeps(grid, box, time))
      if (even.axis == 1)
        add(1, steps);
      else
        result.push_back(std::move(even));
    return result;
  }
  const bool tapered = grid.metric->tapered();
  add(0, steps / 2);
  if (tapered) add(1, steps / 2);
  if (grid.layers && !tapered) add(1, steps);
  for (Sweep& upright : sweeps(grid, box, time))
    if (upright.axis == 1 && !tapered && !grid.layers) result.push_back(std::move(upright));
  add(2, steps);
  if (tapered) add(1, steps / 2);
  add(0, steps / 2);
  return result;
}

Smoothing::Smoothing(const core::Grid& grid, double width, bool closed) {
  if (!(width > 0)) return;
  const double time = smoothing_time(width);
  const auto of = [&](int axis, const core::Box& box) {
    return grid.metric ? open_sweeps(grid, axis, box, time) : sweeps(grid, box, time);
  };
  cells_ = of(-1, core::owned_cells(grid));
  for (int axis = 0; axis < grid.dimensions; ++axis)
    faces_[std::size_t(axis)] = of(axis, free_faces(grid, axis, closed));
  const int longest = 1 + *std::max_element(grid.cells.begin(), grid.cells.end());
  work_.assign(std::size_t(longest * LineDiffusion::lanes), 0);
}

std::vector<std::array<double, 2>> Smoothing::nearest(int axis, int count) const {
  std::vector<std::array<double, 2>> near(std::size_t(count), {1, 0});
  for (const Sweep& sweep : cells_) {
    if (sweep.axis != axis) continue;
    constexpr int lanes = LineDiffusion::lanes;
    for (int first = 0; first < count; first += lanes) {
      std::vector<double> tile(std::size_t(count * lanes), 0.0);
      const int lines = std::min(lanes, count - first);
      for (int l = 0; l < lines; ++l) tile[std::size_t((first + l) * lanes + l)] = 1;
      sweep.line.apply(tile.data());
      for (int l = 0; l < lines; ++l) {
        const int here = first + l, next = (here + 1) % count;
        near[std::size_t(here)] = {tile[std::size_t(here * lanes + l)], tile[std::size_t(next * lanes + l)]};
      }
    }
  }
  return near;
}

void Smoothing::smooth(const Sweeps& sweeps, core::Field& field) const {
  double* tile = work_.data();
  double* values = field.data();
  for (const Sweep& sweep : sweeps)
    for (std::size_t first = 0; first < sweep.starts.size(); first += LineDiffusion::lanes) {
      const int lines = int(std::min(sweep.starts.size() - first, std::size_t(LineDiffusion::lanes)));
      const core::Index* starts = sweep.starts.data() + first;
      const int count = sweep.line.count();
      for_each_entry(count, sweep.stride, starts, lines, [&](int t, core::Index c) { tile[t] = values[c]; });
      sweep.line.apply(tile);
      for_each_entry(count, sweep.stride, starts, lines, [&](int t, core::Index c) { values[c] = tile[t]; });
    }
}

}  // namespace polybed::fluid
