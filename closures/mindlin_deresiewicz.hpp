// Tangential force with partial slip in steps, after Mindlin and Deresiewicz (J. Appl. Mech. 20, 1953, 327) as reduced
// by Thornton and Yin (Powder Technol. 65, 1991, 153) and Thornton, Cummins and Cleary (Powder Technol. 210, 2011,
// 189): along one line,
//   dF = 8 G* a theta dxi + (-1)^k mu (1 - theta) dF_n,
//   theta^3 = 1 - (F + mu dF_n)/(mu F_n) loading (k = 0),
//   theta^3 = 1 - [(-1)^k (F - F_k) + 2 mu dF_n]/(2 mu F_n) unloading (k = 1) and reloading (k = 2),
// theta = 1 while |dF| < mu dF_n. F_k, the force at the last reversal, follows the normal force: F_k -= (-1)^k mu dF_n.
//
// F is opposite to the displacement: the force on i is -F. The law stores one reversal on each side. Unloading past
// minus its reversal is loading in the other direction; reloading up to the reversal at which unloading began is
// loading again. Deeper loops within loops are not stored.
#pragma once

namespace polybed::closures {

/// Cube root from + - * / alone: the same bits on every machine, and a loop over it is vectorised. x^(1/3) for x in [0,
/// 1], to 1.5e-16 relative for x >= 2^-96 (root 2e-10), less than std::cbrt's own error; below to 1e-10 absolute; 0
/// gives 0. Clamps outside [0, 1]. Scales by powers of 8 into [1/8, 1], then takes four Newton steps from a parabola
/// accurate to 2 %.
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

/// A contact starts with zeros and side 1.
struct MindlinDeresiewicz {
  double force = 0;        ///< F, N
  double unloaded_at = 0;  ///< F_1 times side: at the last reversal of loading
  double reloaded_at = 0;  ///< F_2 times side
  double branch = 0;       ///< k = 0, 1, 2
  double side = 1;         ///< 1 or -1: the direction of loading in branch 0
};

/// Input of a step: radius a and F_n at its end; the change of F_n over it.
struct MindlinDeresiewiczStep {
  double stiffness;      ///< 8 G* a, N/m
  double displacement;   ///< dxi, m
  double friction;       ///< mu
  double normal_force;   ///< F_n >= 0, N
  double normal_change;  ///< dF_n, N
};

/// The branch of this step, from the direction of dxi: a reversal stores the present force.
[[nodiscard]] inline MindlinDeresiewicz branch_of_step(MindlinDeresiewicz state, double displacement) {
  // Without a force, or with a vanished one on a loading branch: load in the direction of motion. Flags are numbers, as
  // g++ 12 does not vectorise a select between conditions.
  const double loading = state.branch == 0 ? 1.0 : 0.0, unloading = state.branch == 1 ? 1.0 : 0.0;
  const double fresh = state.side * state.force <= 0 ? loading : 0.0;
  state.side = fresh > 0 ? (displacement < 0 ? -1.0 : 1.0) : state.side;
  const double force = state.side * state.force, move = state.side * displacement;
  const double unloads = move < 0 ? (1 - fresh) * (1 - unloading) : 0.0, reloads = move > 0 ? unloading : 0.0;
  state.unloaded_at += unloads * (force - state.unloaded_at);
  state.reloaded_at += reloads * (force - state.reloaded_at);
  state.branch += unloads * (1 - state.branch) + reloads;
  return state;
}

/// theta in [0, 1]: share of the contact's stiffness that has not slipped. Force, displacement and k relative to the
/// state's side.
[[nodiscard]] inline double stick_share(const MindlinDeresiewicz& state, const MindlinDeresiewiczStep& step) {
  const double force = state.side * state.force, limit = step.friction * step.normal_force;
  const double change = step.friction * step.normal_change;
  const double used = state.branch == 0   ? force + change
                      : state.branch == 1 ? 0.5 * (state.unloaded_at - force) + change
                                          : 0.5 * (force - state.reloaded_at) + change;
  const double theta = limit > 0 ? cube_root_of_share(1 - used / (limit > 0 ? limit : 1.0)) : 0;
  const double stuck = step.stiffness * (step.displacement < 0 ? -step.displacement : step.displacement);
  return stuck < change ? 1 : theta;
}

/// Force and state after one step, |F| <= mu F_n. Explicit: first order in the size of the step.
[[nodiscard]] inline MindlinDeresiewicz mindlin_deresiewicz(const MindlinDeresiewicz& before,
                                                            const MindlinDeresiewiczStep& step) {
  MindlinDeresiewicz state = branch_of_step(before, step.displacement);
  const double theta = stick_share(state, step), sense = state.branch == 1 ? -1.0 : 1.0;
  const double change = step.friction * step.normal_change;
  double force = state.side * (state.force + step.stiffness * theta * step.displacement) + sense * (1 - theta) * change;
  const double bound = step.friction * step.normal_force, limit = bound > 0 ? bound : 0;
  force = force > limit ? limit : force < -limit ? -limit : force;
  state.unloaded_at += state.branch == 0 ? 0 : change;
  state.reloaded_at -= state.branch == 2 ? change : 0;
  const double crossed = force <= -state.unloaded_at ? (state.branch == 1 ? 1.0 : 0.0) : 0.0;
  const double rejoined = force >= state.unloaded_at ? (state.branch == 2 ? 1.0 : 0.0) : 0.0;
  state.force = state.side * force;
  state.side -= 2 * crossed * state.side;
  state.branch -= (crossed + rejoined) * state.branch;
  return state;
}

}  // namespace polybed::closures
