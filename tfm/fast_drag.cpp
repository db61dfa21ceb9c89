#include "tfm/fast_drag.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "fluid/momentum.hpp"

namespace polybed::tfm {

using core::face_mean;
using core::Index;

namespace {

constexpr std::size_t block = 64;  ///< faces computed together, so that their sums stay in the first-level cache

}  // namespace

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
  for (const double density : constants.density)
    lighter_.push_back(constants.form_b ? 0 : 1 / density - 1 / constants.fluid.density);
}

void FastDrag::hold(const Fields& fields) {
  const core::Grid& grid = constants_.grid;
  inertia_ = fields.inertia.present();
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    Faces& faces = axes_[a];
    const core::Box all = core::owned_faces(grid, axis);
    const core::Box box = boundaries_.moving_faces(axis, false);
    faces.runs.clear();
    for (std::vector<double>& b : faces.b) std::fill(b.begin(), b.end(), 0.0);
    if (inertia_ && faces.share.empty()) faces.share = faces.b;
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
          fluid::with_form(fields.solids, [&]<class Form>(Form) {
            for (Index f = 0; f < count; ++f) {
              const Index c = from + f;
              phi_on[f] = face_mean(phi, c, s);
              b_on[f] = Form::at(b, eps, c, s, u[c] - v[c]);
              mobility[f] += phi_on[f] * per_density;
            }
          });
          if (inertia_) std::copy_n(fields.inertia.share[n][a].data() + from, count, faces.share[n].data() + to);
        }
      }
    }
  }
}

template <class Kernel>
void FastDrag::in_blocks(Kernel&& kernel) const {
  for (const Faces& faces : axes_)
    for (const auto& [first, last] : faces.runs)
      for (std::size_t begin = first; begin < last; begin += block) kernel(faces, begin, std::min(block, last - begin));
}

void FastDrag::add_in_block(const Faces& faces, std::size_t begin, std::size_t count, double factor, const double* y,
                            double* rates) const {
  const std::size_t species = constants_.species();
  double fluid[block], gradient[block];
  const double* eps = faces.voidage.data() + begin;
  for (std::size_t f = 0; f < count; ++f) fluid[f] = y[faces.begin + begin + f];
  for (std::size_t n = 0; n < species; ++n) {
    const double *phi = faces.phi[n].data() + begin, *v = y + faces.velocity[n] + begin;
    for (std::size_t f = 0; f < count; ++f) fluid[f] -= phi[f] * v[f];
  }
  for (std::size_t f = 0; f < count; ++f) {
    fluid[f] /= eps[f];
    gradient[f] = 0;
  }
  for (std::size_t n = 0; n < species; ++n) {
    const double *phi = faces.phi[n].data() + begin, *b = faces.b[n].data() + begin, *v = y + faces.velocity[n] + begin;
    for (std::size_t f = 0; f < count; ++f) gradient[f] += lighter_[n] * phi[f] * b[f] * (fluid[f] - v[f]);
  }
  for (std::size_t f = 0; f < count; ++f) gradient[f] /= faces.mobility[begin + f];
  for (std::size_t n = 0; n < species; ++n) {
    const double *b = faces.b[n].data() + begin, *v = y + faces.velocity[n] + begin;
    double* rate = rates + faces.velocity[n] + begin;
    const double scale = factor / constants_.density[n];
    for (std::size_t f = 0; f < count; ++f)
      rate[f] += b[f] > 0 ? scale * (b[f] * (fluid[f] - v[f]) - gradient[f]) : 0.0;
  }
}

// eps u + sum phi_k x_k = r_J and B G = sum phi_k b_k (1/rho_k - 1/rho_f) (u - x_k), where
// x_k = (r_k + gamma (b_k u - G)/rho_k) / (1 + gamma b_k/rho_k): uu u + ug G = ur and gu u + gg G = gr.
void FastDrag::solve_in_block(const Faces& faces, std::size_t begin, std::size_t count, double gamma, double* x) const {
  const std::size_t species = constants_.species();
  double uu[block], ug[block], ur[block], gu[block], gg[block], gr[block];
  for (std::size_t f = 0; f < count; ++f) {
    uu[f] = faces.voidage[begin + f];
    gg[f] = faces.mobility[begin + f];
    ur[f] = x[faces.begin + begin + f];
    ug[f] = gu[f] = gr[f] = 0;
  }
  for (std::size_t n = 0; n < species; ++n) {
    const double *b = faces.b[n].data() + begin, *phi = faces.phi[n].data() + begin, *r = x + faces.velocity[n] + begin;
    const double c = gamma / constants_.density[n], lighter = lighter_[n];
    for (std::size_t f = 0; f < count; ++f) {
      const double own = 1 / (1 + c * b[f]), value = r[f] * own, pull = lighter * phi[f] * b[f];
      uu[f] += phi[f] * c * b[f] * own;
      ug[f] -= phi[f] * c * own;
      ur[f] -= phi[f] * value;
      gu[f] -= pull * own;
      gg[f] -= pull * c * own;
      gr[f] -= pull * value;
    }
  }
  for (std::size_t f = 0; f < count; ++f) {
    const double det = uu[f] * gg[f] - ug[f] * gu[f];
    const double u = (ur[f] * gg[f] - ug[f] * gr[f]) / det, g = (uu[f] * gr[f] - gu[f] * ur[f]) / det;
    ur[f] = u;
    gr[f] = g;
  }
  for (std::size_t n = 0; n < species; ++n) {
    const double* b = faces.b[n].data() + begin;
    double* v = x + faces.velocity[n] + begin;
    const double c = gamma / constants_.density[n];
    for (std::size_t f = 0; f < count; ++f)
      v[f] = b[f] > 0 ? (v[f] + c * (b[f] * ur[f] - gr[f])) / (1 + c * b[f]) : v[f];
  }
}

void FastDrag::add_with_inertia(const Faces& faces, std::size_t begin, std::size_t count, double factor,
                                const double* y, double* rates) const {
  const std::size_t species = constants_.species();
  const double on_solids = constants_.form_b ? 0 : 1;
  for (std::size_t f = begin; f < begin + count; ++f) {
    const double eps = faces.voidage[f];
    double fluid = y[faces.begin + f], mass = eps * constants_.fluid.density, push = 0,
           pressed = constants_.form_b ? 1 : eps;
    for (std::size_t n = 0; n < species; ++n) fluid -= faces.phi[n][f] * y[faces.velocity[n] + f];
    fluid /= eps;
    for (std::size_t n = 0; n < species; ++n) {
      const double phi = faces.phi[n][f], k = faces.share[n][f];
      mass += phi * k * constants_.density[n];
      push -= phi * (1 - k) * faces.b[n][f] * (fluid - y[faces.velocity[n] + f]);
      pressed += phi * k * on_solids;
    }
    // Effect of drag, and of a unit gradient of pressure, on the total flux: the gradient keeps it constant.
    double flux = eps * push / mass, mobility = eps * pressed / mass;
    for (std::size_t n = 0; n < species; ++n) {
      const double phi = faces.phi[n][f], k = faces.share[n][f], free = (1 - k) / constants_.density[n];
      flux += phi * (free * faces.b[n][f] * (fluid - y[faces.velocity[n] + f]) + k * push / mass);
      mobility += phi * (free * on_solids + k * pressed / mass);
    }
    const double gradient = flux / mobility, of_fluid = (push - pressed * gradient) / mass;
    for (std::size_t n = 0; n < species; ++n) {
      const double k = faces.share[n][f], free = (1 - k) / constants_.density[n];
      rates[faces.velocity[n] + f] +=
          factor * (free * (faces.b[n][f] * (fluid - y[faces.velocity[n] + f]) - on_solids * gradient) + k * of_fluid);
    }
  }
}

// With gamma a_f = u - u_r, u_r = (r_J - sum phi_k r_k)/eps, and g = gamma G:
// x_k = [r_k - k_k u_r + (c_k b_k + k_k) u - (1 - k_k) s_k g/rho_k] / (1 + c_k b_k),  c_k = gamma (1 - k_k)/rho_k,
// in eps u + sum phi_k x_k = r_J and in the fluid's equation: uu u + ug g = ur and gu u + gg g = gr.
void FastDrag::solve_with_inertia(const Faces& faces, std::size_t begin, std::size_t count, double gamma,
                                  double* x) const {
  const std::size_t species = constants_.species();
  const double on_solids = constants_.form_b ? 0 : 1;
  for (std::size_t f = begin; f < begin + count; ++f) {
    const double eps = faces.voidage[f];
    double rest = x[faces.begin + f], mass = eps * constants_.fluid.density;
    for (std::size_t n = 0; n < species; ++n) {
      rest -= faces.phi[n][f] * x[faces.velocity[n] + f];
      mass += faces.phi[n][f] * faces.share[n][f] * constants_.density[n];
    }
    rest /= eps;
    double uu = eps, ug = 0, ur = x[faces.begin + f], gu = mass, gg = constants_.form_b ? 1 : eps, gr = mass * rest;
    for (std::size_t n = 0; n < species; ++n) {
      const double phi = faces.phi[n][f], k = faces.share[n][f], b = faces.b[n][f];
      const double free = (1 - k) / constants_.density[n], c = gamma * free, own = 1 / (1 + c * b);
      const double known = own * (x[faces.velocity[n] + f] - k * rest), pull = phi * (1 - k) * b * own;
      uu += phi * own * (c * b + k);
      ug -= phi * own * free * on_solids;
      ur -= phi * known;
      gu += gamma * pull * (1 - k);
      gg += phi * k * on_solids + pull * c * on_solids;
      gr += gamma * phi * (1 - k) * b * known;
    }
    const double det = uu * gg - ug * gu;
    const double u = (ur * gg - ug * gr) / det, g = (uu * gr - gu * ur) / det;
    for (std::size_t n = 0; n < species; ++n) {
      const double k = faces.share[n][f], b = faces.b[n][f], free = (1 - k) / constants_.density[n], c = gamma * free;
      double& v = x[faces.velocity[n] + f];
      v = (v - k * rest + (c * b + k) * u - free * on_solids * g) / (1 + c * b);
    }
  }
}

void FastDrag::add_loops(const FastDrag& drag, double factor, const double* y, double* rates) {
  drag.in_blocks([&](const Faces& faces, std::size_t begin, std::size_t count) {
    drag.inertia_ ? drag.add_with_inertia(faces, begin, count, factor, y, rates)
                  : drag.add_in_block(faces, begin, count, factor, y, rates);
  });
}

void FastDrag::solve_loops(const FastDrag& drag, double gamma, double* x) {
  drag.in_blocks([&](const Faces& faces, std::size_t begin, std::size_t count) {
    drag.inertia_ ? drag.solve_with_inertia(faces, begin, count, gamma, x)
                  : drag.solve_in_block(faces, begin, count, gamma, x);
  });
}

void FastDrag::add(double factor, std::span<const double> y, std::span<double> rates) const {
  core::in_vectors<add_loops>(*this, factor, y.data(), rates.data());
}

void FastDrag::solve(double gamma, std::span<double> x) const { core::in_vectors<solve_loops>(*this, gamma, x.data()); }

}  // namespace polybed::tfm
