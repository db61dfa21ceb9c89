// Lubrication: the force of the film, or a lower restitution, closures/lubrication.hpp.
#include "relevance/effects/lubrication.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "closures/lubrication.hpp"
#include "core/vectors.hpp"
#include "dem/effects.hpp"
#include "dem/effects/damping_table.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/rows.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

namespace {

using Row = ContactBatch::Row;

/// Range of a film over R*.
constexpr double reach_over_radius = 0.1;
/// Represents all films of a particle, see Film.
constexpr double films = 6;

struct Squeezed {
  double viscosity, roughness;
  double resolved;  ///< gap above which the fluid resolves films, m; 0: it does not
};

void squeeze(const ContactBatch& b, const Row& radius, const Row& per_mass, const Squeezed& film, Row& force) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double gap = -b.overlap[c];
    const double whole =
        film.resolved > 0
            ? closures::unresolved_film_resistance(film.viscosity, radius[c], gap, film.resolved, film.roughness)
            : closures::film_resistance(film.viscosity, radius[c], gap, reach_over_radius * radius[c], film.roughness);
    force[c] = gap > 0 ? -b.speed[c] * whole / (1 + whole * per_mass[c]) : 0;
  }
}

/// -c v_n with c = 6 pi mu R*^2/h from a gap of 0.1 R* until the surfaces touch, h at least the roughness. It
/// dissipates energy on approach and on separation; friction and rolling ignore it.
///
/// Implicit in v_n: c/(1 + 6 c dt/m*). The 6 is for particles with many films: the greatest rate in a close packing, 8
/// c/m with films along all its bonds, is then at most (2/3)/dt for any thickness; the stability limit is 2/dt, or 1/dt
/// with the synchronised integrator. It is equivalent to a greater h, by 36 pi mu R*^2 dt/m*: thinner films need
/// correspondingly shorter steps to be resolved. With a fluid that resolves wider gaps it is
/// unresolved_film_resistance().
class Film final : public FilmLaw {
 public:
  /// Pa s and m
  Film(const Materials& materials, const Squeezed& film) : film_(film) {
    for (const PairMaterial& m : materials.kinds()) constants_.push_back({m.radius, m.mass, 0});
  }
  void set_step(double dt) override {
    for (Constants& k : constants_) k.per_mass = films * dt / k.mass;
  }
  void act(const ContactBatch& batch, Row& force) const override {
    alignas(64) Row radius = {}, per_mass = {};
    for (int c = 0; c < batch.count; ++c) {
      const Constants& k = constants_[std::size_t(batch.kind[c])];
      radius[c] = k.radius;
      per_mass[c] = k.per_mass;
    }
    core::in_vectors<squeeze>(batch, radius, per_mass, film_, force);
  }

  [[nodiscard]] double reach() const override {
    double reach = film_.resolved;
    if (reach > 0) return reach;
    for (const Constants& k : constants_) reach = std::max(reach, reach_over_radius * k.radius);
    return reach;
  }

 private:
  struct Constants {
    double radius, mass;  ///< R*, m*
    double per_mass;      ///< 6 dt/m*, s/kg
  };
  std::vector<Constants> constants_;
  Squeezed film_;
};

void damp(ContactBatch& b, int place, const Row& dry, double least_force) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double whole = b.dashpot[c], force = b.elastic[c] - b.memory[place][c] * whole * b.speed[c];
    b.normal[c] = force > least_force ? force : least_force;
    b.dashpot[c] = dry[c] * whole;
  }
}

/// A lower restitution, e exp(-35/St*): a law that wraps another normal force. The speed at first contact sets the
/// damping of the whole contact, which is stored in its memory. A contact that begins without approach has the greatest
/// damping. Friction keeps the dashpot of dry contacts. Below e = 0.05 a clipped tail rebounds with 0.05.
class WetContact final : public NormalLaw {
 public:
  struct Fluid {
    double density, viscosity;  ///< kg/m3, Pa s
  };
  /// \param whole  the law of dry contacts with a damping ratio of 1 and its tail kept  \param tail  as in HertzContact
  /// \param place  index of its memory in a batch
  WetContact(std::unique_ptr<NormalLaw> whole, const Materials& materials, const Fluid& fluid, core::Tail tail,
             int place)
      : whole_(std::move(whole)),
        table_(tail == core::Tail::clip),
        least_force_(tail == core::Tail::clip ? 0 : -std::numeric_limits<double>::infinity()),
        place_(place) {
    for (const PairMaterial& m : materials.kinds()) {
      const double log = -std::log(std::min(m.restitution, 1.0));
      constants_.push_back({log, closures::stokes_of_pair(m.mass, 1, fluid.viscosity, m.radius), table_(log)});
    }
    for (std::size_t a = 0; a < materials.species().size(); ++a) {
      const Species& s = materials.species()[a];
      const double stokes = closures::stokes_of_impact(s.density, fluid.density, 2 * s.radius, 1, fluid.viscosity);
      materials.each_wall_kind(std::int32_t(a),
                               [&](std::int32_t kind) { constants_[std::size_t(kind)].stokes = stokes; });
    }
  }

  void act(ContactBatch& batch) const override {
    whole_->act(batch);
    Row& damping = batch.memory[place_];
    alignas(64) Row dry = {};
    for (int c = 0; c < batch.count; ++c) {
      if (damping[c] == 0 && batch.overlap[c] > 0) damping[c] = damping_at_touch(batch.kind[c], batch.speed[c]);
      dry[c] = constants_[std::size_t(batch.kind[c])].dry;
    }
    core::in_vectors<damp>(batch, place_, dry, least_force_);
  }

  [[nodiscard]] int memory_size() const override { return 1; }
  [[nodiscard]] double energy(int kind, double overlap) const override { return whole_->energy(kind, overlap); }
  [[nodiscard]] double force_at(int kind, double overlap) const override { return whole_->force_at(kind, overlap); }
  [[nodiscard]] double contact_time(int kind, double speed) const override { return whole_->contact_time(kind, speed); }
  [[nodiscard]] double overlap_of_impact(int kind, double speed) const override {
    return whole_->overlap_of_impact(kind, speed);
  }
  [[nodiscard]] double stiffness_at(int kind, double overlap) const override {
    return whole_->stiffness_at(kind, overlap);
  }
  /// The greatest in any contact, as a limit for steps.
  [[nodiscard]] double damping_ratio(int kind) const override {
    return whole_->damping_ratio(kind) * table_.greatest();
  }

 private:
  struct Constants {
    double log;     ///< -ln e, dry
    double stokes;  ///< St* over the speed, s/m
    double dry;     ///< beta, dry
  };
  [[nodiscard]] double damping_at_touch(int kind, double speed) const {
    const Constants& k = constants_[std::size_t(kind)];
    const double wet = closures::wet_restitution(1, k.stokes * -speed);  // 0 without approach
    // Zero represents a contact that has not begun.
    return std::max(table_(wet > 0 ? k.log - std::log(wet) : std::numeric_limits<double>::infinity()), tiny);
  }

  std::unique_ptr<NormalLaw> whole_;
  DampingTable table_;
  std::vector<Constants> constants_;
  double least_force_;  ///< N: 0, or no limit
  int place_;
};

}  // namespace

namespace makers {

namespace {

void make_film(const PairMaking& m) {
  const double viscosity = relevance::fluid_constants(m.scene.fluid).viscosity;
  m.laws.film = std::make_unique<Film>(m.materials, Squeezed{viscosity, m.scene.material.roughness, m.resolved_gap});
}

void make_wet_restitution(const PairMaking& m) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(m.scene.fluid);
  // Its memory comes first in a contact's. The wrapped law has a damping ratio of 1, and its tail kept.
  m.around_normal = [&materials = m.materials, fluid, tail = m.scene.dem.tail](const MakeNormal& make) {
    return std::make_unique<WetContact>(make(materials.with_restitution(0), core::Tail::keep), materials,
                                        WetContact::Fluid{fluid.density, fluid.viscosity}, tail, 0);
  };
}

const PairMakers films{{"wet_restitution", make_wet_restitution}, {"film", make_film}};

}  // namespace

extern const Maker lubrication;
const Maker lubrication{&relevance::effects::lubrication, "Pair",
                        MakePair([](const PairMaking& m) { films.at(m.law)(m); })};

}  // namespace makers

}  // namespace polybed::dem
