// The whole state of a run, to the bit, in one file.
//
// The file is HDF5, then 32 bytes: "polybed complete", the length of the HDF5 part and its CRC-64, both 64
// bits, low byte first. HDF5 readers do not look beyond their part. So a file that was cut short or changed
// anywhere is told before HDF5 interprets it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace polybed::core {

struct Checkpoint {
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, double> numbers;
  std::map<std::string, std::int64_t> integers;
  std::map<std::string, std::string> texts;

  bool operator==(const Checkpoint&) const = default;
};

/// Where the checkpoint before `path` is kept: checkpoint.h5 -> checkpoint.previous.h5.
[[nodiscard]] std::filesystem::path previous_checkpoint(const std::filesystem::path& path);

/// Writes a checkpoint: temporary name, flushed, renamed; the one before stays as previous_checkpoint(path).
/// At no moment is there no whole checkpoint. Throws FileError (disk full, no permission; a name with '/').
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads a checkpoint to the bit. Throws FileError if the file is missing, cut short, damaged or of another
/// version; the message names the previous checkpoint if that one is whole.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace polybed::core
