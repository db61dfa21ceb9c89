// Lubrication as a lower restitution, closures/lubrication.hpp: e exp(-35/St*), a law of the normal force around
// another.
#pragma once

#include <memory>
#include <vector>

#include "dem/effects.hpp"
#include "dem/effects/damping_table.hpp"

namespace polybed::dem {

/// The speed at which the surfaces first touch decides on the damping of a whole contact, which is kept in its memory.
/// A contact that begins without approach is damped most. Friction keeps the dashpot of dry contacts. Below e = 0.05 a
/// clipped tail rebounds with 0.05.
class WetContact final : public NormalLaw {
 public:
  struct Fluid {
    double density, viscosity;  ///< kg/m3, Pa s
  };
  /// \param whole  the law of dry contacts with a damping ratio of 1 and its tail kept  \param tail  as of HertzContact
  /// \param place  of its memory in a batch
  WetContact(std::unique_ptr<NormalLaw> whole, const Materials& materials, const Fluid& fluid, core::Tail tail,
             int place);
  void act(ContactBatch& batch) const override;
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
  /// The greatest of any contact: steps have to bear it.
  [[nodiscard]] double damping_ratio(int kind) const override {
    return whole_->damping_ratio(kind) * table_.greatest();
  }

 private:
  struct Constants {
    double log;     ///< -ln e of dry contacts
    double stokes;  ///< St* over the speed, s/m
    double dry;     ///< beta of dry contacts
  };
  [[nodiscard]] double damping_at_touch(int kind, double speed) const;

  std::unique_ptr<NormalLaw> whole_;
  DampingTable table_;
  std::vector<Constants> constants_;
  double least_force_;  ///< N: 0, or none
  int place_;
};

}  // namespace polybed::dem
