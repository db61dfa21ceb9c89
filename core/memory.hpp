// How much memory this process takes and may still take, as the system tells it.
#pragma once

#include <string>
#include <string_view>

namespace polybed::core {

/// Memory that may still be taken, and what sets the limit.
struct AvailableMemory {
  double bytes;       ///< infinite where nothing is known
  std::string limit;  ///< e.g. "the machine's free memory"
};

/// The least of what the machine has free, of what the process's control group (a container) leaves and of the
/// process's own limit on its addresses. Linux; elsewhere the last alone.
[[nodiscard]] AvailableMemory available_memory();

/// The number in a line "name: N kB" or "name N" of a text of such lines, in bytes where it says kB; -1 if there is
/// none.
[[nodiscard]] double number_of_line(std::string_view text, std::string_view name);

/// Memory that the process holds now and at most ever held, bytes; 0 where the system does not tell.
struct ProcessMemory {
  double now, most;
};
[[nodiscard]] ProcessMemory process_memory();

/// From here on the system gets large arrays back as they are freed. Libraries for fast networks, which Open MPI loads,
/// switch that off, and a run then keeps what it needed for a moment only.
void give_back_what_is_freed();

}  // namespace polybed::core
