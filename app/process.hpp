// A program of ours as a process: what surrounds its work, and how it ends.
#pragma once

#include <functional>
#include <string>

#include "app/studies.hpp"
#include "core/error.hpp"

namespace polybed::app {

struct Ending {
  int code = 0;
  std::string message;  ///< empty: nothing is wrong
};

/// Does the work of the whole process and returns how it ended: every exception becomes its exit code and its text.
/// Before, it sees to standard streams that are closed, to signals of full disks and of readers that have gone, and to
/// relative folders on the search path.
[[nodiscard]] Ending guarded(const std::function<core::ExitCode()>& work);

}  // namespace polybed::app
