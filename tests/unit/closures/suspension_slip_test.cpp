#include "closures/suspension_slip.hpp"

#include <gtest/gtest.h>

#include <array>

namespace polybed::closures {
namespace {

// By hand, f = 1: 0.5 mm, 1200 kg/m3 and 0.4 mm, 2000 kg/m3 at fractions 0.2 and 0.1 in a liquid of 1000 kg/m3, 0.01
// Pa s. G = -(0.2 200 + 0.1 1000) 9.81 = -1373.4 Pa/m; (200 - 140) 9.81 0.25e-6/(18 0.01 0.7) and (1000 - 140) 9.81
// 0.16e-6/0.126.
TEST(SuspensionSlip, IsStokesVelocityOfWhatTheGradientLeaves) {
  const std::array share{2.0 / 3, 1.0 / 3}, diameter{0.5e-3, 0.4e-3}, excess{200.0, 1000.0};
  const std::vector<double> slip =
      suspension_slips(drag_law("stokes", Guard::on), 0.7, share, diameter, excess, 1000, 0.01, 9.81, -1373.4);
  EXPECT_NEAR(slip[0], 1.16785714e-3, 1e-11);
  EXPECT_NEAR(slip[1], 10.71314286e-3, 1e-11);
}

// A law with inertia: the drag of the slip found carries what it should, at Re of some hundred.
TEST(SuspensionSlip, BalancesAnyLaw) {
  const std::array share{1.0}, diameter{3e-3}, excess{1500.0};
  const DragLaw law = drag_law("wen_yu", Guard::on);
  const double gradient = -0.2 * 1500 * 9.81, voidage = 0.8;
  const std::vector<double> slip = suspension_slips(law, voidage, share, diameter, excess, 1000, 1e-3, 9.81, gradient);
  const double reynolds = 1000 * voidage * slip[0] * 3e-3 / 1e-3, f = pure_drag_at(law, voidage, reynolds);
  EXPECT_GT(reynolds, 100);
  EXPECT_NEAR(18 * 1e-3 * voidage * f / (3e-3 * 3e-3) * slip[0], 0.8 * 1500 * 9.81, 1e-8);
}

// What is lighter than the mixture rises.
TEST(SuspensionSlip, ALighterSpeciesRisesThroughTheFluid) {
  const std::array share{0.5, 0.5}, diameter{1e-3, 1e-3}, excess{1500.0, 100.0};
  const std::vector<double> slip = suspension_slips(drag_law("wen_yu", Guard::on), 0.6, share, diameter, excess, 1000,
                                                    1e-3, 9.81, -0.4 * 800 * 9.81);
  EXPECT_GT(slip[0], 0);
  EXPECT_LT(slip[1], 0);
}

}  // namespace
}  // namespace polybed::closures
