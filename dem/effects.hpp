// The effects of particle pairs, by their slot. Effects that a scene does not need are not created: they have no memory
// in a contact, no loop and no range.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/contacts/batch.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/effects/maker.hpp"

namespace polybed::dem {

/// Slot Pair, normal force of a contact.
class NormalLaw {
 public:
  virtual ~NormalLaw() = default;
  /// From overlap and speed: contact_radius, normal, elastic and dashpot.
  virtual void act(ContactBatch& batch) const = 0;
  /// Stored energy at an overlap, J.
  [[nodiscard]] virtual double energy(int kind, double overlap) const = 0;
  /// Elastic force at an overlap, N.
  [[nodiscard]] virtual double force_at(int kind, double overlap) const = 0;
  /// Duration of an impact at a speed, s.
  [[nodiscard]] virtual double contact_time(int kind, double speed) const = 0;
  /// Greatest overlap of an impact at a speed, m.
  [[nodiscard]] virtual double overlap_of_impact(int kind, double speed) const = 0;
  /// dF_n/d(overlap) at an overlap, N/m, and the damping ratio (both constants of the linear law).
  [[nodiscard]] virtual double stiffness_at(int kind, double overlap) const = 0;
  [[nodiscard]] virtual double damping_ratio(int kind) const = 0;
  [[nodiscard]] virtual int memory_size() const { return 0; }
};

/// Slot Pair, friction: stores a displacement or a force between steps.
class TangentialLaw {
 public:
  virtual ~TangentialLaw() = default;
  /// Computes tangential from the normal force and v_t; advances the memory by dt, s.
  virtual void act(ContactBatch& batch, double dt) const = 0;
  [[nodiscard]] virtual int memory_size() const = 0;
  /// Stored energy of the tangential springs, J.
  virtual void energy(const ContactBatch& batch, ContactBatch::Row& stored) const = 0;
};

/// Slot Pair, resistance to rolling: fills moment.
class RollingLaw {
 public:
  virtual ~RollingLaw() = default;
  virtual void act(ContactBatch& batch, double dt) const = 0;
  [[nodiscard]] virtual int memory_size() const = 0;
  /// Adds the stored energy of the rotational springs, J.
  virtual void add_energy(const ContactBatch& batch, ContactBatch::Row& stored) const = 0;
  /// Stiffness of the rotational spring, N m, for a given normal one, N/m; 0 without a spring.
  [[nodiscard]] virtual double stiffness(int kind, double normal_stiffness) const = 0;
};

/// Slot Pair, attraction of surfaces or by a liquid bridge: adds to normal; can act beyond contact. Friction and
/// rolling ignore it: their limits follow from the repulsion alone.
class CohesionLaw {
 public:
  virtual ~CohesionLaw() = default;
  /// \param dt  s, of the last step; 0: no step yet
  virtual void act(ContactBatch& batch, double dt) const = 0;
  [[nodiscard]] virtual int memory_size() const = 0;
  /// Adds the attraction's energy after a step of dt, J; 0 far apart.
  virtual void add_energy(const ContactBatch& batch, ContactBatch::Row& stored, double dt) const = 0;
  /// Adds the loss in the next act(), for example when surfaces jump into contact, J.
  virtual void add_loss(const ContactBatch& batch, ContactBatch::Row& lost) const = 0;
  /// Range beyond contact, m.
  [[nodiscard]] virtual double reach() const = 0;
  /// Greatest attraction, N.
  [[nodiscard]] virtual double pull_off(int kind) const = 0;
};

/// Slot Pair, resistance of the fluid between surfaces in near contact, along n; it stores no energy.
class FilmLaw {
 public:
  virtual ~FilmLaw() = default;
  /// Sets the step for which it must be stable, s; call it before the first act().
  virtual void set_step(double dt) = 0;
  /// The force on the first of each pair, N.
  virtual void act(const ContactBatch& batch, ContactBatch::Row& force) const = 0;
  /// Range beyond contact, m.
  [[nodiscard]] virtual double reach() const = 0;
};

struct PairLaws {
  std::unique_ptr<NormalLaw> normal;  ///< never null
  std::unique_ptr<TangentialLaw> tangential;
  std::unique_ptr<RollingLaw> rolling;
  std::unique_ptr<CohesionLaw> cohesion, bridge;
  std::unique_ptr<FilmLaw> film;

  /// Calls act(law) for each attraction that exists.
  template <class Act>
  void each_attraction(Act&& act) const {
    for (const CohesionLaw* law : {cohesion.get(), bridge.get()})
      if (law != nullptr) act(*law);
  }
  [[nodiscard]] double reach() const {
    double most = film ? film->reach() : 0;
    each_attraction([&](const CohesionLaw& law) { most = std::max(most, law.reach()); });
    return most;
  }
  /// Memory of laws that end with the overlap; it comes first in a contact's.
  [[nodiscard]] int contact_memory() const {
    return (normal ? normal->memory_size() : 0) + (tangential ? tangential->memory_size() : 0) +
           (rolling ? rolling->memory_size() : 0);
  }
  [[nodiscard]] int memory_size() const {
    int size = contact_memory();
    each_attraction([&](const CohesionLaw& law) { size += law.memory_size(); });
    return size;
  }
};

/// Greatest relative displacement of a contact's surfaces in one step, m. Attractions that jump as they end extend the
/// range by as much.
[[nodiscard]] double longest_step(const core::Scene& scene, const Materials& materials);

/// The laws in a scene; throws core::CaseError for a scene that breaks a rule of the effects. The laws have consecutive
/// places in a contact's memory: normal force, friction, rolling, cohesion, bridge.
/// \param resolved_gap  m, gap above which a fluid resolves the films, which then add only the rest; 0: it resolves
/// none
[[nodiscard]] PairLaws make_pair_laws(const core::Scene& scene, const Materials& materials,
                                      const std::vector<const Maker*>& list = effects(), double resolved_gap = 0);

}  // namespace polybed::dem
