// Memory that this process uses and can still use, as the system reports it.
#pragma once

#include <string>
#include <string_view>

namespace polybed::core {

/// Memory that can still be allocated, and the limit that applies.
struct AvailableMemory {
  double bytes;       ///< infinite if unknown
  std::string limit;  ///< e.g. "the machine's free memory"
};

/// The minimum of the machine's free memory, the memory left in the process's control group (a container) and the
/// process's own address limit. Outside Linux the address limit alone.
[[nodiscard]] AvailableMemory available_memory();

/// The number in a line "name: N kB" or "name N" of a text, in bytes for kB; -1 if there is no such line.
[[nodiscard]] double number_of_line(std::string_view text, std::string_view name);

/// Current and peak memory of the process, bytes; 0 where the system does not report it.
struct ProcessMemory {
  double now, most;
};
[[nodiscard]] ProcessMemory process_memory();

/// Returns large arrays to the system when they are freed, from this call on. Libraries for fast networks, which Open
/// MPI loads, turn that off: a run then keeps memory that it needed only briefly.
void give_back_what_is_freed();

}  // namespace polybed::core
