// The whole state of a run, to the bit, in one file.
//
// The file is HDF5, then 32 bytes: "polybed complete", the length of the HDF5 part and its CRC-64, both 64
// bits, low byte first. HDF5 readers do not look beyond their part. So a file that was cut short or changed
// anywhere is told before HDF5 interprets it. What ranks share is one dataset for each field of the column, which each
// rank writes and reads its block of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/output/blocks.hpp"
#include "core/output/file.hpp"

namespace polybed::core {

class Ranks;

/// One dataset of an array that the ranks of a column share, and what this rank has of it.
struct CheckpointPart {
  std::string name;
  Slab slab;

  bool operator==(const CheckpointPart&) const = default;
};

/// The parts of such an array; this rank's numbers stand one part after the other, each in C order.
using CheckpointParts = std::map<std::string, std::vector<CheckpointPart>>;

struct Checkpoint {
  std::map<std::string, std::vector<double>>
      arrays;  ///< those named in `parts`: what this rank has; else the same on all
  CheckpointParts parts;
  std::map<std::string, double> numbers;
  std::map<std::string, std::int64_t> integers;
  std::map<std::string, std::string> texts;

  bool operator==(const Checkpoint&) const = default;

  /// What stands under a name; each throws FileError if there is none.
  [[nodiscard]] const std::vector<double>& array(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;
  [[nodiscard]] std::int64_t integer(const std::string& name) const;
  /// The same for a time or a length of time, s: also throws for one that no run has.
  [[nodiscard]] double time(const std::string& name) const;
  /// The same for how often something was done: also throws for less than nothing.
  [[nodiscard]] std::int64_t count(const std::string& name) const;
};

/// What a checkpoint says that cannot be, though it is whole: FileError with the reason.
[[noreturn]] void refuse_checkpoint(const std::string& reason);

/// Runs what takes up the contents of a checkpoint: a FileError that does not name its file yet does so afterwards.
void name_checkpoint(const std::filesystem::path& path, const std::function<void()>& take_up);

/// Throws FileError for numbers that no state of a run has: not finite, or beyond 1e30 in SI units.
void require_numbers(const Checkpoint& checkpoint);

/// Where the checkpoint before `path` is kept: checkpoint.h5 -> checkpoint.previous.h5.
[[nodiscard]] std::filesystem::path previous_checkpoint(const std::filesystem::path& path);

/// Writes a checkpoint: temporary name, flushed, renamed; the one before stays as previous_checkpoint(path).
/// At no moment is there no whole checkpoint. Throws FileError (disk full, no permission; a name with '/').
/// \param ranks  that share the column; what is in no part is taken from the first. Collective.
/// \param more  arrays beside those of the checkpoint, by their names in it, made while they are written; what read_parts
/// shall find by "array/part"
void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint, const Ranks* ranks = nullptr,
                      std::vector<BlockData> more = {});

/// Reads a checkpoint without what is in parts, to the bit. Throws FileError if the file is missing, cut short, damaged
/// or of another version; the message names the previous checkpoint if that one is whole.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Name of the array that says how many particles of each species a checkpoint has.
inline constexpr const char* particle_numbers = "particle_numbers";

/// One array that is in no part, without the others; empty if there is none. Throws FileError as read_checkpoint().
[[nodiscard]] std::vector<double> read_array(const std::filesystem::path& path, const std::string& name);

/// Reads what this rank has of arrays in parts, however many ranks have written them; an array of which the file has no
/// part is left out. Throws FileError if a part is missing or has another shape. Not collective.
void read_parts(const std::filesystem::path& path, const CheckpointParts& parts, Checkpoint& checkpoint);

}  // namespace polybed::core
