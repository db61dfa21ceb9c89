// Result of a drag law, and the use and count of its guard.
#pragma once

#include <cstdint>

namespace polybed::closures {

/// Pure drag over Stokes, F_d / (3 pi mu D u), and its derivative along the slip.
struct DragValue {
  double f;         ///< T(1.46)
  double re_dfdre;  ///< Re df/dRe: dF_d/du is 3 pi mu D (f + Re df/dRe)
};

/// Whether a law uses its guard beyond its range, or the bare published formula.
enum class Guard { on, off };

/// Number of evaluations of a law, and of those outside its stated range (there its guard applies).
struct GuardCount {
  std::uint64_t evaluations = 0, guarded = 0;
};

}  // namespace polybed::closures
