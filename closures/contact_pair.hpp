// Two bodies in contact as one: reduced radius, mass and moduli.
#pragma once

namespace polybed::closures {

struct Elastic {
  double youngs_modulus;  ///< E, Pa
  double poisson_ratio;   ///< nu
};

/// R* = R_i R_j/(R_i + R_j), m; a wall has an infinite radius.
[[nodiscard]] constexpr double reduced_radius(double ri, double rj) { return 1 / (1 / ri + 1 / rj); }

/// m* likewise, kg.
[[nodiscard]] constexpr double reduced_mass(double mi, double mj) { return 1 / (1 / mi + 1 / mj); }

/// E* of 1/E* = sum (1 - nu^2)/E, Pa (Hertz).
[[nodiscard]] constexpr double reduced_youngs_modulus(Elastic a, Elastic b) {
  return 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus +
              (1 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus);
}

/// G* of 1/G* = sum (2 - nu)/G with G = E/(2 (1 + nu)), Pa (Mindlin).
[[nodiscard]] constexpr double reduced_shear_modulus(Elastic a, Elastic b) {
  const auto part = [](Elastic e) { return (2 - e.poisson_ratio) * 2 * (1 + e.poisson_ratio) / e.youngs_modulus; };
  return 1 / (part(a) + part(b));
}

}  // namespace polybed::closures
