#include "hard/naive/equations.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "closures/added_mass.hpp"
#include "closures/drag.hpp"
#include "tfm/pressure_coupling.hpp"

namespace polybed::hard::naive {

using core::Field;
using core::Index;

namespace {

tfm::Discretisation discretisation_of(const core::Tfm& options, const tfm::Model& model) {
  const auto scheme = [](bool limited) { return limited ? tfm::Scheme::limited : tfm::Scheme::upwind; };
  return {scheme(options.flux == core::FractionFlux::limited),
          scheme(model.momentum() == core::Momentum::conservative_limited), fluid::WallSlip::free_slip};
}

/// dphi_j/dt = -div(U_j at(phi_j)) with other values on faces.
template <class Face>
void set_continuity(const tfm::RightHandSide& equations, tfm::Fields& fields, core::FaceField& flux, Face&& at) {
  const core::Grid& grid = equations.constants().grid;
  for (std::size_t j = 0; j < fields.solids.species(); ++j) {
    for (int axis = 0; axis < grid.dimensions; ++axis) {
      const auto a = std::size_t(axis);
      const double *phi = fields.solids.fraction[j].data(), *u = fields.solids.velocity[j][a].data();
      core::for_each_row(grid, equations.boundaries().moving_faces(axis, false), [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) flux[a][std::size_t(c)] = u[c] * at(phi, c, grid.stride(axis), u[c]);
      });
    }
    equations.boundaries().join(flux);
    core::divergence(grid, flux, fields.solids.fraction_rate[j]);
    for (double& rate : fields.solids.fraction_rate[j]) rate = -rate;
    equations.boundaries().fill_cells(fields.solids.fraction_rate[j]);
  }
}

}  // namespace

Equations::Equations(const core::Scene& scene, const tfm::Model& model, const tfm::StateLayout& layout, Terms terms,
                     core::Timers& timers)
    : layout_(layout),
      equations_(scene, model.constants(), model.boundaries(), model.inlet(), discretisation_of(scene.tfm, model),
                 timers),
      terms_(std::move(terms)),
      pressure_(model.constants().grid, scene.tfm.pressure_tolerance.value_or(std::min(1e-4, 0.1 * scene.tfm.rtol))) {}

bool Equations::evaluate(double t, std::span<const double> y) {
  if (!equations_.evaluate(t, layout_, y)) return false;
  if (!terms_) return true;
  tfm::Fields& fields = equations_.fields();
  const tfm::Constants& constants = equations_.constants();
  terms_(equations_, fields);
  fluid::flux_rate(constants.grid, equations_.boundaries(), fields.solids, fields.fluid, constants.fluid.density,
                   fields.fluid_acceleration, fields.flux_rate);
  if (!equations_.boundaries().closed()) equations_.inlet().set_rate(t, fields.flux_rate.free);
  return true;
}

core::Rate Equations::rates(double t, std::span<const double> y, std::span<double> dydt) {
  if (!evaluate(t, y)) return core::Rate::recoverable;
  tfm::Fields& fields = equations_.fields();
  ++solves_;
  if (!pressure_.solve(fields.flux_rate, fields.fluid.flux, correction_rate_, fields.fluid.pressure).converged)
    return core::Rate::recoverable;
  tfm::subtract_pressure_gradient(equations_.constants(), equations_.boundaries(), fields);
  tfm::pack_rates(layout_, fields, dydt);
  return core::Rate::ok;
}

Terms hard_packing(const tfm::Model& model) {
  const double packing = model.effects().solids_stress->max_packing();
  auto flux = std::make_shared<core::FaceField>(core::make_face_field(model.constants().grid));
  return [packing, flux](const tfm::RightHandSide& equations, tfm::Fields& fields) {
    const double* total = fields.solids_fraction.data();
    set_continuity(equations, fields, *flux, [&](const double* phi, Index c, Index s, double u) {
      const bool full = (u > 0 ? total[c] : total[c - s]) >= packing;
      return full ? 0.0 : core::UpwindFace::at(phi, c, s, u);
    });
  };
}

Terms raw_drag(const core::Scene& scene, const tfm::Model& model, bool plain_shares) {
  const auto law =
      closures::drag_law(scene.effects.at("drag"), plain_shares ? closures::Guard::on : closures::Guard::off);
  const std::size_t species = model.constants().species();
  return [=](const tfm::RightHandSide& equations, tfm::Fields& fields) {
    const tfm::Constants& constants = equations.constants();
    if (plain_shares)
      for (std::size_t j = 0; j < species; ++j)
        for (std::size_t c = 0; c < fields.solids_fraction.size(); ++c)
          fields.share[j][c] = fields.solids.fraction[j][c] / fields.solids_fraction[c];
    std::vector<double> share(species), slip(species), f(species), slope(species);
    core::for_each_row(constants.grid, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        for (std::size_t j = 0; j < species; ++j) {
          share[j] = fields.share[j][c];
          slip[j] = fields.slip_superficial[j][c];
        }
        const double eps = fields.fluid.voidage[c];
        closures::drag_of_mixture(law, eps, share, constants.diameter, slip, constants.fluid.density,
                                  constants.fluid.viscosity, f, slope);
        for (std::size_t j = 0; j < species; ++j)
          fields.solids.exchange[j][c] =
              18 * constants.fluid.viscosity * eps * f[j] / (constants.diameter[j] * constants.diameter[j]);
      }
    });
    for (Field& b : fields.solids.exchange) equations.boundaries().fill_cells(b);
    tfm::add_exchange(constants, equations.boundaries(), fields);
    fluid::subtract_exchange(constants.grid, equations.boundaries(), fields.solids, fields.fluid,
                             constants.fluid.density, fields.fluid_acceleration);
  };
}

Terms central_flux(const tfm::Model& model) {
  auto flux = std::make_shared<core::FaceField>(core::make_face_field(model.constants().grid));
  return [flux](const tfm::RightHandSide& equations, tfm::Fields& fields) {
    set_continuity(equations, fields, *flux,
                   [](const double* phi, Index c, Index s, double) { return core::face_mean(phi, c, s); });
  };
}

Terms advective_momentum(const core::Scene& scene, const tfm::Model& model) {
  const auto carried = std::make_shared<tfm::Fields>(model.constants());
  const tfm::Scheme scheme = discretisation_of(scene.tfm, model).flux;
  return [=](const tfm::RightHandSide& equations, tfm::Fields& fields) {
    const tfm::Constants& constants = equations.constants();
    tfm::ConservativeConvection conservative(constants, equations.boundaries(), false, *carried);
    *carried = fields;
    tfm::continuity(constants, equations.boundaries(), scheme, 0, *carried, nullptr);
    conservative.set();
    const auto replace = [&](bool of_fluid, const core::FaceField& velocity, const core::FaceField& by,
                             core::FaceField& acceleration) {
      for (int axis = 0; axis < constants.grid.dimensions; ++axis) {
        const auto a = std::size_t(axis);
        for (std::size_t f = 0; f < by[a].size(); ++f) acceleration[a][f] -= by[a][f];
        core::subtract_convection(constants.grid, velocity, axis, equations.boundaries().moving_faces(axis, of_fluid),
                                  acceleration[a]);
      }
    };
    replace(true, fields.fluid.velocity, carried->fluid_acceleration, fields.fluid_acceleration);
    for (std::size_t j = 0; j < fields.solids.species(); ++j)
      replace(false, fields.solids.velocity[j], carried->solids.acceleration[j], fields.solids.acceleration[j]);
  };
}

Terms unbalanced_gravity(const tfm::Model&) {
  return [](const tfm::RightHandSide& equations, tfm::Fields& fields) {
    const tfm::Constants& constants = equations.constants();
    const double* phi = fields.solids_fraction.data();
    const Index s = constants.grid.stride(1);
    for (std::size_t j = 0; j < fields.solids.species(); ++j) {
      const double weight = -(1 - constants.fluid.density / constants.density[j]) * constants.gravity;
      double* a = fields.solids.acceleration[j][1].data();
      core::for_each_row(constants.grid, equations.boundaries().moving_faces(1, false), [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c)
          a[c] += weight * (phi[c] / std::max(core::face_mean(phi, c, s), tfm::stress_fraction_floor) - 1);
      });
    }
  };
}

Terms hidden_unit(const tfm::Model&) {
  return [](const tfm::RightHandSide& equations, tfm::Fields& fields) {
    constexpr double small = 1e-3;
    for (std::size_t j = 0; j < fields.solids.species(); ++j)
      for (std::size_t axis = 0; axis < std::size_t(equations.constants().grid.dimensions); ++axis)
        core::for_each_row(equations.constants().grid, equations.boundaries().moving_faces(int(axis), false),
                           [&](Index begin, Index end) {
                             for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
                               fields.solids.acceleration[j][axis][c] +=
                                   small * (fields.fluid.velocity[axis][c] - fields.solids.velocity[j][axis][c]) /
                                   equations.constants().density[j];
                           });
  };
}

Terms added_mass_lagged(const tfm::Model& model) {
  struct Before {
    core::FaceField fluid;
    std::vector<core::FaceField> solids;
  };
  const auto before = std::make_shared<Before>();
  before->fluid = core::make_face_field(model.constants().grid);
  before->solids.assign(model.constants().species(), before->fluid);
  return [before](const tfm::RightHandSide& equations, tfm::Fields& fields) {
    const tfm::Constants& constants = equations.constants();
    const core::Grid& grid = constants.grid;
    const double *eps = fields.fluid.voidage.data(), *p = fields.fluid.pressure.data();
    const double fluid_density = constants.fluid.density;
    for (int axis = 0; axis < grid.dimensions; ++axis) {
      const auto a = std::size_t(axis);
      const Index s = grid.stride(axis);
      for (std::size_t j = 0; j < fields.solids.species(); ++j) {
        const double *phi = fields.solids.fraction[j].data(), density = constants.density[j];
        core::for_each_row(grid, equations.boundaries().moving_faces(axis, false), [&](Index begin, Index end) {
          for (Index c = begin; c < end; ++c) {
            const auto f = std::size_t(c);
            const double slope = (p[c] - p[c - s]) / grid.spacing[a], voidage = core::face_mean(eps, c, s);
            const double force = closures::added_mass_zuber(1 - voidage) * fluid_density *
                                 (before->fluid[a][f] - before->solids[j][a][f] -
                                  slope * (1 / fluid_density - 1 / density));  // of one volume of solids, N/m3
            fields.solids.acceleration[j][a][f] += force / density;
            fields.fluid_acceleration[a][f] -= core::face_mean(phi, c, s) * force / (voidage * fluid_density);
          }
        });
      }
    }
    before->fluid = fields.fluid_acceleration;
    before->solids = fields.solids.acceleration;
  };
}

}  // namespace polybed::hard::naive
