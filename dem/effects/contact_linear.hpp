// A linear spring and dashpot along the normal.
#pragma once

#include <vector>

#include "dem/effects.hpp"

namespace polybed::dem {

class LinearContact final : public NormalLaw {
 public:
  /// \param stiffness  N/m  \param tail  as of HertzContact
  LinearContact(const Materials& materials, double stiffness, core::Tail tail);
  void act(ContactBatch& batch) const override;
  [[nodiscard]] double energy(int, double overlap) const override;
  [[nodiscard]] double force_at(int, double overlap) const override { return stiffness_ * overlap; }
  [[nodiscard]] double contact_time(int kind, double speed) const override;
  [[nodiscard]] double overlap_of_impact(int kind, double speed) const override;
  [[nodiscard]] double stiffness_at(int, double) const override { return stiffness_; }
  [[nodiscard]] double damping_ratio(int kind) const override { return constants_[std::size_t(kind)].damping; }

 private:
  struct Constants {
    double mass, dashpot, damping;  ///< m*, c, beta
  };
  std::vector<Constants> constants_;
  double stiffness_, least_force_;  ///< N/m; N: 0, or none
};

}  // namespace polybed::dem
