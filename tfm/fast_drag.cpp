#include "tfm/fast_drag.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "fluid/momentum.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Index;

FastDrag::FastDrag(const Constants& constants, const fluid::Boundaries& boundaries, const StateLayout& layout)
    : constants_(constants), boundaries_(boundaries), layout_(layout), axes_(std::size_t(constants.grid.dimensions)) {
  using Kind = StateLayout::Entry::Kind;
  for (const StateLayout::Entry& entry : layout.entries()) {
    if (entry.kind == Kind::velocity) axes_[std::size_t(entry.axis)].velocity.push_back(entry.begin);
    if (entry.kind != Kind::flux) continue;
    Faces& faces = axes_[std::size_t(entry.axis)];
    faces.begin = entry.begin;
    faces.size = entry.size;
    faces.phi.assign(constants.species(), std::vector<double>(entry.size));
    faces.b = faces.phi;
    faces.voidage.assign(entry.size, 1.0);
    faces.mobility.assign(entry.size, 1 / constants.fluid.density);
  }
  for (const double density : constants.density) lighter_.push_back(1 / density - 1 / constants.fluid.density);
}

void FastDrag::hold(const Fields& fields) {
  const core::Grid& grid = constants_.grid;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    Faces& faces = axes_[a];
    const core::Box all = core::owned_faces(grid, axis);
    const core::Box box = boundaries_.moving_faces(axis, false);
    faces.runs.clear();
    for (std::vector<double>& b : faces.b) std::fill(b.begin(), b.end(), 0.0);
    const Index s = grid.stride(axis), row = all.hi[0] - all.lo[0], layer = row * (all.hi[1] - all.lo[1]);
    const double *eps = fields.fluid.voidage.data(), *u = fields.fluid.velocity[a].data();
    for (int k = box.lo[2]; k < box.hi[2]; ++k) {
      faces.runs.emplace_back(std::size_t(row * box.lo[1] + layer * k), std::size_t(row * box.hi[1] + layer * k));
      for (int j = box.lo[1]; j < box.hi[1]; ++j) {
        const Index from = grid.index(box.lo[0], j, k), count = box.hi[0] - box.lo[0];
        const auto to = std::size_t(box.lo[0] + row * j + layer * k);
        double *voidage = faces.voidage.data() + to, *mobility = faces.mobility.data() + to;
        for (Index f = 0; f < count; ++f) {
          voidage[f] = std::max(face_mean(eps, from + f, s), fluid::voidage_floor);
          mobility[f] = voidage[f] / constants_.fluid.density;
        }
        for (std::size_t n = 0; n < constants_.species(); ++n) {
          const double *phi = fields.solids.fraction[n].data(), *b = fields.solids.exchange[n].data(),
                       *v = fields.solids.velocity[n][a].data();
          double *phi_on = faces.phi[n].data() + to, *b_on = faces.b[n].data() + to;
          const double per_density = 1 / constants_.density[n];
          for (Index f = 0; f < count; ++f) {
            const Index c = from + f;
            phi_on[f] = face_mean(phi, c, s);
            b_on[f] = fluid::exchange_on_face(b, c, s, u[c] - v[c]);
            mobility[f] += phi_on[f] * per_density;
          }
        }
      }
    }
  }
}

void FastDrag::add(double factor, std::span<const double> y, std::span<double> rates) const {
  const std::size_t species = constants_.species();
  constexpr std::size_t block = 64;
  const auto add_some = [&](const Faces& faces, std::size_t begin, std::size_t count) {
    double fluid[block], gradient[block];
    const double* eps = faces.voidage.data() + begin;
    for (std::size_t f = 0; f < count; ++f) fluid[f] = y[faces.begin + begin + f];
    for (std::size_t n = 0; n < species; ++n) {
      const double *phi = faces.phi[n].data() + begin, *v = y.data() + faces.velocity[n] + begin;
      for (std::size_t f = 0; f < count; ++f) fluid[f] -= phi[f] * v[f];
    }
    for (std::size_t f = 0; f < count; ++f) {
      fluid[f] /= eps[f];
      gradient[f] = 0;
    }
    for (std::size_t n = 0; n < species; ++n) {
      const double *phi = faces.phi[n].data() + begin, *b = faces.b[n].data() + begin,
                   *v = y.data() + faces.velocity[n] + begin;
      for (std::size_t f = 0; f < count; ++f) gradient[f] += lighter_[n] * phi[f] * b[f] * (fluid[f] - v[f]);
    }
    for (std::size_t f = 0; f < count; ++f) gradient[f] /= faces.mobility[begin + f];
    for (std::size_t n = 0; n < species; ++n) {
      const double *b = faces.b[n].data() + begin, *v = y.data() + faces.velocity[n] + begin;
      double* rate = rates.data() + faces.velocity[n] + begin;
      const double scale = factor / constants_.density[n];
      for (std::size_t f = 0; f < count; ++f)
        rate[f] += b[f] > 0 ? scale * (b[f] * (fluid[f] - v[f]) - gradient[f]) : 0.0;
    }
  };
  for (const Faces& faces : axes_)
    for (const auto& [first, last] : faces.runs)
      for (std::size_t begin = first; begin < last; begin += block)
        add_some(faces, begin, std::min(block, last - begin));
}

void FastDrag::solve(double gamma, std::span<const double> r, std::span<double> x) const {
  if (x.data() != r.data()) std::copy(r.begin(), r.end(), x.begin());
  const std::size_t species = constants_.species();
  for (const Faces& faces : axes_)
    for (const auto& [first, last] : faces.runs)
      for (std::size_t f = first; f < last; ++f) {
        // eps u + sum phi_k x_k = r_J and B G = sum phi_k b_k (1/rho_k - 1/rho_f) (u - x_k), where
        // x_k = (r_k + gamma (b_k u - G)/rho_k) / (1 + gamma b_k/rho_k)
        double uu = faces.voidage[f], ug = 0, ur = r[faces.begin + f];
        double gu = 0, gg = faces.mobility[f], gr = 0;
        for (std::size_t n = 0; n < species; ++n) {
          const double b = faces.b[n][f], phi = faces.phi[n][f], c = gamma / constants_.density[n];
          const double own = 1 / (1 + c * b), value = r[faces.velocity[n] + f] * own;
          const double pull = lighter_[n] * phi * b;
          uu += phi * c * b * own;
          ug -= phi * c * own;
          ur -= phi * value;
          gu -= pull * own;
          gg -= pull * c * own;
          gr -= pull * value;
        }
        const double det = uu * gg - ug * gu;
        const double u = (ur * gg - ug * gr) / det, g = (uu * gr - gu * ur) / det;
        for (std::size_t n = 0; n < species; ++n) {
          const double b = faces.b[n][f], c = gamma / constants_.density[n];
          if (b > 0) x[faces.velocity[n] + f] = (r[faces.velocity[n] + f] + c * (b * u - g)) / (1 + c * b);
        }
      }
}

}  // namespace polybed::tfm
