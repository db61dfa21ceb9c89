// Cube root from + - * / alone: the same bits on every machine, and a loop over it is vectorised.
#pragma once

namespace polybed::closures {

/// x^(1/3) for x in [0, 1], to 1.5e-16 relative for x >= 2^-96 (root 2e-10), which is less than std::cbrt's own error;
/// below to 1e-10 absolute; 0 gives 0. Beyond [0, 1] clamps. Scaled by powers of 8 into [1/8, 1], then four Newton
/// steps from a parabola that is right to 2 %.
[[nodiscard]] inline double cube_root_of_share(double x) {
  double y = x < 1 ? x : 1, scale = 1;
  const auto reduce = [&](double below, double root) {
    const bool small = y < below;
    scale = small ? scale * root : scale;
    y = small ? y / below : y;
  };
  reduce(0x1p-48, 0x1p-16);
  reduce(0x1p-24, 0x1p-8);
  reduce(0x1p-12, 0x1p-4);
  reduce(0x1p-6, 0x1p-2);
  reduce(0x1p-3, 0x1p-1);
  double root = 0.385 + y * (1.0375 - 0.4275 * y);
  for (int n = 0; n < 4; ++n) root -= (root - y / (root * root)) / 3;
  return x > 0 ? scale * root : 0;
}

}  // namespace polybed::closures
