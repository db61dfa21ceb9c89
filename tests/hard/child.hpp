// Pieces of work in child processes, so that one that crashes or hangs is told and is not the end of the others.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace polybed::hard {

/// How a piece of work ended.
struct ChildEnd {
  bool answered = false;  ///< it came to its end and gave `text`
  std::string text;       ///< its answer; else how it ended: the signal, or the time that it had
};

/// Limits of the pieces, and how many run at once.
struct ChildLimits {
  int jobs = 1;
  double seconds = 60;  ///< each, of the clock
  double cpu = 0;       ///< s, each, of computing; 0: as much as it likes
  double bytes = 0;     ///< each, of its memory; 0: as much as there is
};

/// Calls work(n) for n = 0 ... count - 1, each in a process of its own, and `done` here as they end. What a piece
/// prints is lost; processes that it started end with it, and all pieces if `done` throws.
void in_children(std::size_t count, const ChildLimits& limits, const std::function<std::string(std::size_t)>& work,
                 const std::function<void(std::size_t, const ChildEnd&)>& done);

}  // namespace polybed::hard
