// A program of ours as a process: preparation, and how it ends.
#pragma once

#include <functional>
#include <string>

#include "app/studies.hpp"
#include "core/error.hpp"

namespace polybed::app {

struct Ending {
  int code = 0;
  std::string message;  ///< empty: no error
};

/// Does the work of the whole process and returns how it ended: every exception becomes its exit code and its text.
/// First it handles closed standard streams, signals for full disks and closed readers, and relative folders on the
/// search path.
[[nodiscard]] Ending guarded(const std::function<core::ExitCode()>& work);

}  // namespace polybed::app
