// The effects of pairs of particles, by the slot they fill. What a scene does not call for is not made: it has no
// memory in a contact, no loop and no reach.
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
  /// Energy stored at an overlap, J.
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

/// Slot Pair, friction: keeps a displacement or a force from step to step.
class TangentialLaw {
 public:
  virtual ~TangentialLaw() = default;
  /// From the normal force and v_t: tangential; moves the memory on by dt, s.
  virtual void act(ContactBatch& batch, double dt) const = 0;
  [[nodiscard]] virtual int memory_size() const = 0;
  /// Energy stored in the tangential springs, J.
  virtual void energy(const ContactBatch& batch, ContactBatch::Row& stored) const = 0;
};

/// Slot Pair, resistance to rolling: fills moment.
class RollingLaw {
 public:
  virtual ~RollingLaw() = default;
  virtual void act(ContactBatch& batch, double dt) const = 0;
  [[nodiscard]] virtual int memory_size() const = 0;
  /// Adds the energy in the springs of rotation, J.
  virtual void add_energy(const ContactBatch& batch, ContactBatch::Row& stored) const = 0;
  /// Stiffness of the spring of rotation, N m, where the normal one is a given, N/m; 0 without a spring.
  [[nodiscard]] virtual double stiffness(int kind, double normal_stiffness) const = 0;
};

/// Slot Pair, attraction of surfaces or by a liquid bridge: adds to normal; may reach beyond contact. Friction and
/// rolling do not feel it: their limits are those of the repulsion alone.
class CohesionLaw {
 public:
  virtual ~CohesionLaw() = default;
  /// \param dt  s, of the step that led here; 0: none did
  virtual void act(ContactBatch& batch, double dt) const = 0;
  [[nodiscard]] virtual int memory_size() const = 0;
  /// Adds the energy of the attraction after a step of dt, J; 0 far apart.
  virtual void add_energy(const ContactBatch& batch, ContactBatch::Row& stored, double dt) const = 0;
  /// Adds what the next act() loses, as when surfaces jump into contact, J.
  virtual void add_loss(const ContactBatch& batch, ContactBatch::Row& lost) const = 0;
  /// m, beyond contact.
  [[nodiscard]] virtual double reach() const = 0;
  /// Greatest attraction, N.
  [[nodiscard]] virtual double pull_off(int kind) const = 0;
};

/// Slot Pair, resistance of the fluid between surfaces that nearly touch, along n; no energy is stored.
class FilmLaw {
 public:
  virtual ~FilmLaw() = default;
  /// Step for which it has to be stable, s; before the first act().
  virtual void set_step(double dt) = 0;
  /// The force on the first of each pair, N.
  virtual void act(const ContactBatch& batch, ContactBatch::Row& force) const = 0;
  /// m, beyond contact.
  [[nodiscard]] virtual double reach() const = 0;
};

struct PairLaws {
  std::unique_ptr<NormalLaw> normal;  ///< the one that always is
  std::unique_ptr<TangentialLaw> tangential;
  std::unique_ptr<RollingLaw> rolling;
  std::unique_ptr<CohesionLaw> cohesion, bridge;
  std::unique_ptr<FilmLaw> film;

  /// Calls act(law) for those attractions that there are.
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
  /// Of what ends with the overlap, the first in a contact's memory.
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

/// How far the surfaces of a contact move against each other in one step at most, m: attractions that jump as they end
/// reach as much further.
[[nodiscard]] double longest_step(const core::Scene& scene, const Materials& materials);

/// The laws that a scene names; throws core::CaseError for a scene that breaks a rule of the effects. Each law is given
/// its place in the memory of a contact: that of the normal force first, then friction's, rolling's, cohesion's, the
/// bridge's.
/// \param resolved_gap  m, from which on a fluid resolves the films, which have only the rest; 0: none does
[[nodiscard]] PairLaws make_pair_laws(const core::Scene& scene, const Materials& materials,
                                      const std::vector<const Maker*>& list = effects(), double resolved_gap = 0);

}  // namespace polybed::dem
