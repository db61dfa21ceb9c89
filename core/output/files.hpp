// Files as bytes: read as a whole, or replaced as a whole. Every failure is a FileError with path and reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/output/descriptor.hpp"

namespace polybed::core {

using Bytes = std::vector<std::byte>;

/// What must survive a power cut when a file is put in place; a killed program loses nothing either way. Each flush
/// waits for the disk, so a file is flushed only as far as its loss matters.
enum class Flush {
  nothing,  ///< for a file that can be made again from others: after a power cut it can be empty
  content,  ///< the old or the new content is there, complete: for files that are replaced repeatedly
  all       ///< the new content is there, under its name
};

/// Replaces the file `path` by `bytes`: written under a temporary name in the same directory, flushed to the disk,
/// renamed. After any interruption `path` contains all of the old or all of the new content. On failure (disk full, no
/// permission) the temporary file is removed and FileError thrown.
/// \param more  bytes to append
void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes,
                      std::span<const std::byte> more = {}, Flush flush = Flush::all);
void write_atomically(const std::filesystem::path& path, std::string_view text, Flush flush = Flush::all);

/// Claims room on the disk for the next write_atomically() to a file, under its temporary name, so that a disk that
/// fills up in between does not prevent the write. Throws FileError.
void claim_room(const std::filesystem::path& path, std::size_t size);
/// The same as far as there is room.
void keep_room(const std::filesystem::path& path, std::size_t size);

/// Writes the last content of a file atomically or, if the disk is too full for two versions, in place of the old one:
/// an interruption then loses both. Throws FileError.
void write_last(const std::filesystem::path& path, std::string_view text);

/// Renames a complete file within its directory: flushed to the disk, renamed. On failure the other name is removed and
/// FileError thrown.
void put_in_place(const std::filesystem::path& written, const std::filesystem::path& path, Flush flush = Flush::all);

/// Makes renames in a directory survive a power cut. Some file systems cannot do that; the call then has no effect.
void flush_directory(const std::filesystem::path& directory);

/// A new, empty file, open for writing. An existing file of its name is removed first, and no link is ever followed: in
/// a directory that others can write, such a link could lead to any file of the user. Throws FileError.
[[nodiscard]] Descriptor new_file(const std::filesystem::path& path);

/// A file of lines that grows. Each line goes to the operating system at once and complete: a killed program loses
/// none. If somebody removes, moves or replaces the file, it is restored with all its lines, with a warning.
class LineFile {
 public:
  /// Replaces the file by `text` and appends after it. Throws FileError.
  LineFile(std::filesystem::path path, std::string_view text);
  /// Throws FileError.
  void append(std::string_view line);
  /// Makes the lines survive a power cut. Throws FileError.
  void flush();

 private:
  void put_back();
  std::filesystem::path path_;
  Descriptor file_;
  std::int64_t size_;  ///< bytes written
};

/// Creates a file of a size, its blocks on the disk claimed, that begins with `bytes`; the rest is zero. Not flushed.
/// Throws FileError.
void claim_file(const std::filesystem::path& path, std::span<const std::byte> bytes, std::size_t size);

/// Appends to a file without flushing it; throws FileError.
void append_to_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Longest file that is read as a whole unless a reader gives another limit.
inline constexpr std::size_t longest_file = 4'000'000'000;

/// Size of a file, bytes. Throws FileError if it does not exist, is a pipe or a device, which can be endless, or is
/// longer than `most`. Every reader of a file that a user names calls this first.
[[nodiscard]] std::size_t bytes_of_file(const std::filesystem::path& path, std::size_t most = SIZE_MAX);

/// Throws the FileError of a system call on a file that failed. \param deed  as in "read"; \param reason  errno
[[noreturn]] void cannot(const std::string& deed, const std::filesystem::path& path, int reason);

/// Calls `see` with the bytes of a file from `begin` to `end`, piece by piece, without memory for the whole.
void read_pieces(const std::filesystem::path& path, std::size_t begin, std::size_t end,
                 const std::function<void(std::span<const std::byte>)>& see);

/// All bytes of a file; throws FileError if it cannot be read, as bytes_of_file() does.
[[nodiscard]] Bytes read_whole_file(const std::filesystem::path& path, std::size_t most = longest_file);

/// The same as text.
[[nodiscard]] std::string read_text(const std::filesystem::path& path, std::size_t most = longest_file);

/// Makes a directory and those above it; throws FileError.
void make_directories(const std::filesystem::path& path);

/// Creates a folder in a directory that the program writes, if it does not exist. Throws FileError on failure, also if
/// a link has its name: files written through it would land elsewhere.
void make_folder(const std::filesystem::path& path);

/// Throws FileError if a symbolic link has this name.
void refuse_link(const std::filesystem::path& path);

/// CRC-64/XZ, from liblzma: differs for any two inputs of one length that differ in one run of up to 64 bits, and for
/// others with probability 1 - 2^-64.
/// \param before  checksum of the bytes before these
[[nodiscard]] std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t before = 0);

/// CRC-32 as zlib and Python compute it, for files that others write too. \param before  as for crc64()
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace polybed::core
