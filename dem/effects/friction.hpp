// Tangential forces that store a displacement (hdd, linear) or a force (mindlin) between steps, with Coulomb's limit.
#pragma once

#include <vector>

#include "dem/effects.hpp"

namespace polybed::dem {

/// F_t = -k_t xi - c_t v_t with the displacement xi as memory, T(2.14) and Di Renzo and Di Maio (2005). hdd: k_t =
/// (2/3) 8 G* a; linear: a constant. Above mu F_n the force is limited and xi is adjusted to it.
class SpringFriction final : public TangentialLaw {
 public:
  /// hdd. \param place  index of its memory in a batch
  SpringFriction(const Materials& materials, int place);
  /// Linear. \param normal_stiffness  k_n, N/m  \param ratio  k_t/k_n
  SpringFriction(const Materials& materials, double normal_stiffness, double ratio, int place);
  void act(ContactBatch& batch, double dt) const override;
  [[nodiscard]] int memory_size() const override { return 3; }
  void energy(const ContactBatch& batch, ContactBatch::Row& stored) const override;

 private:
  struct Constants {
    double friction;    ///< mu
    double per_radius;  ///< k_t/a, Pa
    double constant;    ///< the rest of k_t, N/m
    double dashpot;     ///< c_t/c_n
  };
  std::vector<Constants> constants_;
  int place_;
};

/// F_t -= 8 G* a v_t dt with F_t as memory, reduced in proportion to a when the overlap decreases, as it would
/// otherwise generate energy; plus a dashpot. The first step of a contact uses the mean of a over it, (2/3) a.
class MindlinFriction final : public TangentialLaw {
 public:
  MindlinFriction(const Materials& materials, int place);
  void act(ContactBatch& batch, double dt) const override;
  [[nodiscard]] int memory_size() const override { return 4; }  ///< F_t and the last a
  void energy(const ContactBatch& batch, ContactBatch::Row& stored) const override;

 private:
  struct Constants {
    double friction, per_radius, dashpot;  ///< mu, 8 G*, c_t/c_n
  };
  std::vector<Constants> constants_;
  int place_;
};

}  // namespace polybed::dem
