// Files as bytes: read whole, or replaced whole. Every failure is a FileError with path and reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace polybed::core {

using Bytes = std::vector<std::byte>;

/// Replaces the file `path` by `bytes`: written under a temporary name in the same directory, flushed to the
/// disk, renamed. Whatever interrupts it, `path` holds either all of the old or all of the new content; on
/// failure (disk full, no permission) the temporary file is removed and FileError thrown.
void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// All bytes of a file; throws FileError if it cannot be read.
[[nodiscard]] Bytes read_whole_file(const std::filesystem::path& path);

/// Makes a directory and those above it; throws FileError.
void make_directories(const std::filesystem::path& path);

/// CRC-64 (ECMA-182 polynomial, reflected, as in xz): differs for any two inputs of one length that differ in
/// one run of up to 64 bits, and for others with probability 1 - 2^-64.
[[nodiscard]] std::uint64_t crc64(std::span<const std::byte> bytes);

}  // namespace polybed::core
