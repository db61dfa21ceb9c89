// What a drag law returns, and how its guard is asked for and counted.
#pragma once

#include <cstdint>

namespace polybed::closures {

/// Pure drag over Stokes, F_d / (3 pi mu D u), and its derivative along the slip.
struct DragValue {
  double f;         ///< T(1.46)
  double re_dfdre;  ///< Re df/dRe: dF_d/du is 3 pi mu D (f + Re df/dRe)
};

/// Whether a law answers beyond its range by its guard, or by the bare published formula.
enum class Guard { on, off };

/// How often a law was asked, and how often outside the range it is stated for (there its guard answers).
struct GuardCount {
  std::uint64_t evaluations = 0, guarded = 0;
};

}  // namespace polybed::closures
