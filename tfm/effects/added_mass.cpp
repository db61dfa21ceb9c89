// Slot Inertia: added mass, closures/added_mass.hpp.
//
//   D_j U_j/Dt = a_j + (C_m rho_f/rho_j)(D_f U_f/Dt - D_j U_j/Dt),   and the opposite for the fluid, over its mass
//
// with a_j and a_f the accelerations of each phase alone from all other forces and the pressure. With k_j = C_m
// rho_f/(rho_j + C_m rho_f) the rows of a face have a closed solution:
//
//   D_f U_f/Dt = (eps rho_f a_f + sum_j phi_j k_j rho_j a_j) / M,   M = eps rho_f + sum_j phi_j k_j rho_j
//   D_j U_j/Dt = (1 - k_j) a_j + k_j D_f U_f/Dt
//
// The same for a unit gradient of the pressure: r_f = (s_f + sum_j phi_j k_j s_j)/M and r_j = (1 - k_j) s_j/rho_j +
// k_j r_f take the place of 1/rho_f and 1/rho_j in (2) and in B = eps r_f + sum_j phi_j r_j; s_j = 1 and s_f = eps in
// form A, 0 and 1 in form B. A D_j U_j/Dt from an earlier time would grow where C_m rho_f exceeds rho_j.
#include "closures/added_mass.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"
#include "fluid/density.hpp"
#include "relevance/effects/added_mass.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::tfm {

namespace {

using core::face_mean;
using core::Index;

struct Half {
  static double at(double) { return closures::added_mass_of_one; }
};
struct Zuber {
  static double at(double solids_fraction) { return closures::added_mass_zuber(solids_fraction); }
};

/// k_j on the faces where solids move.
template <class Coefficient, class Density>
void share_loops(const Density& density, const Constants& constants, const fluid::Boundaries& boundaries,
                 Fields& fields) {
  const double* eps = fields.fluid.voidage.data();
  for (int axis = 0; axis < constants.grid.dimensions; ++axis)
    for (std::size_t j = 0; j < constants.species(); ++j) {
      const Index s = constants.grid.stride(axis);
      double* share = fields.inertia.share[j][std::size_t(axis)].data();
      const double own = constants.density[j];
      core::for_each_row(constants.grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) {
          const double carried = Coefficient::at(1 - face_mean(eps, c, s)) * density.on_face(c, s);
          share[c] = carried / (own + carried);
        }
      });
    }
}

/// Solves the rows of each face: for the forces, and for a unit gradient of the pressure.
template <class Density>
void couple_loops(const Density& density, const Constants& constants, const fluid::Boundaries& boundaries,
                  Fields& fields) {
  const double* eps = fields.fluid.voidage.data();
  const std::size_t n = constants.species();
  const double on_solids = constants.form_b ? 0 : 1;
  for (int axis = 0; axis < constants.grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const Index s = constants.grid.stride(axis);
    const double* convected = fields.inertia.convection[n][a].data();
    double *fluid = fields.fluid_acceleration[a].data(), *to_fluid = fields.inertia.fluid_response[a].data();
    core::for_each_row(constants.grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
    // First the sums: the momentum of the fluid and its added mass, and their response to the pressure.
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) {
        const double voidage = std::max(face_mean(eps, c, s), fluid::voidage_floor);
        fluid[c] = voidage * density.on_face(c, s) * (fluid[c] - convected[c]);
        to_fluid[c] = on_solids > 0 ? voidage : 1.0;
      }
      for (std::size_t j = 0; j < n; ++j) {
        const double *phi = fields.solids.fraction[j].data(), *k = fields.inertia.share[j][a].data(),
                     *own = fields.solids.acceleration[j][a].data(), *along = fields.inertia.convection[j][a].data();
        const double rho = constants.density[j];
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) {
          const double carried = face_mean(phi, c, s) * k[c];
          fluid[c] += carried * rho * (own[c] - along[c]);
          to_fluid[c] += carried * on_solids;
        }
      }
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) {
        double mass = std::max(face_mean(eps, c, s), fluid::voidage_floor) * density.on_face(c, s);
        for (std::size_t j = 0; j < n; ++j)
          mass += face_mean(fields.solids.fraction[j].data(), c, s) * fields.inertia.share[j][a][std::size_t(c)] *
                  constants.density[j];
        fluid[c] /= mass;
        to_fluid[c] /= mass;
      }
      for (std::size_t j = 0; j < n; ++j) {
        const double *k = fields.inertia.share[j][a].data(), *along = fields.inertia.convection[j][a].data();
        double *own = fields.solids.acceleration[j][a].data(), *response = fields.inertia.response[j][a].data();
        const double pressed = on_solids / constants.density[j];
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) {
          own[c] = (1 - k[c]) * (own[c] - along[c]) + k[c] * fluid[c] + along[c];
          response[c] = (1 - k[c]) * pressed + k[c] * to_fluid[c];
        }
      }
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) fluid[c] += convected[c];
    });
  }
}

void mobility_loops(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields) {
  const double* eps = fields.fluid.voidage.data();
  for (int axis = 0; axis < constants.grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const Index s = constants.grid.stride(axis);
    const double* to_fluid = fields.inertia.fluid_response[a].data();
    double* mobility = fields.flux_rate.mobility[a].data();
    core::for_each_row(constants.grid, boundaries.moving_faces(axis, false), [&](Index begin, Index end) {
#pragma GCC ivdep
      for (Index c = begin; c < end; ++c) mobility[c] = face_mean(eps, c, s) * to_fluid[c];
      for (std::size_t j = 0; j < constants.species(); ++j) {
        const double *phi = fields.solids.fraction[j].data(), *response = fields.inertia.response[j][a].data();
#pragma GCC ivdep
        for (Index c = begin; c < end; ++c) mobility[c] += face_mean(phi, c, s) * response[c];
      }
    });
  }
}

/// Where the solids are held, and on faces through which they are fed, the fluid has no added mass.
template <class Coefficient>
class AddedMass final : public InertiaEffect {
 public:
  AddedMass(const Constants& constants, const fluid::Boundaries& boundaries)
      : constants_(constants), boundaries_(boundaries) {}

  void keep_convection(Fields& fields) override {
    for (std::size_t j = 0; j < constants_.species(); ++j) fields.inertia.convection[j] = fields.solids.acceleration[j];
    fields.inertia.convection.back() = fields.fluid_acceleration;
  }

  void couple(Fields& fields) override {
    fluid::with_density(fields.fluid, constants_.fluid.density, [&]<class Density>(const Density& local) {
      core::in_vectors<share_loops<Coefficient, Density>>(local, constants_, boundaries_, fields);
      clear_where_fed(fields.inertia.share);
      core::in_vectors<couple_loops<Density>>(local, constants_, boundaries_, fields);
    });
    clear_where_fed(fields.inertia.response);
  }

  void set_mobility(Fields& fields) override {
    core::in_vectors<mobility_loops>(constants_, boundaries_, fields);
    boundaries_.join(fields.flux_rate.mobility);
  }

 private:
  void clear_where_fed(std::vector<core::FaceField>& of_species) const {
    if (!constants_.openings.present() || !boundaries_.open()) return;
    fluid::for_each_boundary_row(constants_.grid, 1, 1, [&](Index begin, Index end) {
      for (std::size_t j = 0; j < constants_.species(); ++j)
        for (Index c = begin; c < end; ++c)
          if (constants_.openings.holds(j, 1, c)) of_species[j][1][std::size_t(c)] = 0;
    });
  }

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
};

template <class Coefficient>
std::unique_ptr<InertiaEffect> made(const Constants& constants, const fluid::Boundaries& boundaries) {
  return std::make_unique<AddedMass<Coefficient>>(constants, boundaries);
}

const std::map<std::string, std::unique_ptr<InertiaEffect> (*)(const Constants&, const fluid::Boundaries&)> laws{
    {"half", made<Half>}, {"zuber", made<Zuber>}};

void make_added_mass(const Making& m) {
  const core::FaceField none = core::make_face_field(m.constants.grid);
  Inertia& inertia = m.fields.inertia;
  inertia.convection.assign(m.constants.species() + 1, none);
  inertia.share.assign(m.constants.species(), none);
  inertia.response = inertia.share;
  inertia.fluid_response = none;
  m.effects.inertia = laws.at(m.law)(m.constants, m.boundaries);
}

}  // namespace

namespace makers {

extern const Maker added_mass;
const Maker added_mass{&relevance::effects::added_mass, "Inertia", make_added_mass};

}  // namespace makers

}  // namespace polybed::tfm
