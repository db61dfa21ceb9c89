// Files as bytes: read whole, or replaced whole. Every failure is a FileError with path and reason.
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

/// What of a file that is put in place has to survive a power cut; a killed program loses nothing either way.
/// Each flush waits for the disk, so a file has no more of it than its loss is worth.
enum class Flush {
  nothing,  ///< of a file that is made again from others: after a power cut it may be empty
  content,  ///< the old or the new content is there, whole: of files that are replaced again and again
  all       ///< and it is the new one, under its name
};

/// Replaces the file `path` by `bytes`: written under a temporary name in the same directory, flushed to the
/// disk, renamed. Whatever interrupts it, `path` holds either all of the old or all of the new content; on
/// failure (disk full, no permission) the temporary file is removed and FileError thrown.
/// \param more  what follows the bytes
void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes,
                      std::span<const std::byte> more = {}, Flush flush = Flush::all);
void write_atomically(const std::filesystem::path& path, std::string_view text, Flush flush = Flush::all);

/// Claims room on the disk for the next write_atomically() of a file, under the temporary name that it replaces first:
/// a disk that has become full meanwhile does not keep that content out. Throws FileError.
void claim_room(const std::filesystem::path& path, std::size_t size);
/// The same as far as there is room.
void keep_room(const std::filesystem::path& path, std::size_t size);

/// The last content of a file, atomically or, if the disk is too full for the old and the new one, in place of the old
/// one: what interrupts it then leaves neither. Throws FileError.
void write_last(const std::filesystem::path& path, std::string_view text);

/// Puts a file that lies complete under another name of the same directory in place: flushed to the disk, renamed. On
/// failure the other name is removed and FileError thrown.
void put_in_place(const std::filesystem::path& written, const std::filesystem::path& path, Flush flush = Flush::all);

/// Makes the names in a directory, as renames have left them, survive a power cut. Some file systems cannot, which
/// costs nothing but that.
void flush_directory(const std::filesystem::path& directory);

/// A new, empty file, open for writing. What had its name is removed first, and no link is ever followed: in a
/// directory that others may write, such a link could lead to any file of the user. Throws FileError.
[[nodiscard]] Descriptor new_file(const std::filesystem::path& path);

/// A file of lines that grows. Each line goes to the operating system at once and whole: a killed program loses none. A
/// file that somebody has removed, moved or replaced meanwhile is put back with all its lines, with a warning.
class LineFile {
 public:
  /// Replaces the file by `text` and goes on behind it. Throws FileError.
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

/// Makes a file of a size, its blocks on the disk claimed, that begins with `bytes`; the rest is zero. Not flushed.
/// Throws FileError.
void claim_file(const std::filesystem::path& path, std::span<const std::byte> bytes, std::size_t size);

/// Appends to a file without flushing it; throws FileError.
void append_to_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Longest file that is read whole unless a reader says otherwise.
inline constexpr std::size_t longest_file = 4'000'000'000;

/// Bytes of a file. Throws FileError if there is none, if it is a pipe or a device, which may never end, or if it is
/// longer than `most`. Whoever opens a file that a user names asks this before.
[[nodiscard]] std::size_t bytes_of_file(const std::filesystem::path& path, std::size_t most = SIZE_MAX);

/// Throws the FileError of a system call on a file that failed. \param deed  as in "read"; \param reason  errno
[[noreturn]] void cannot(const std::string& deed, const std::filesystem::path& path, int reason);

/// Calls `see` with the bytes of a file from `begin` to `end`, piece by piece: no memory for the whole is needed.
void read_pieces(const std::filesystem::path& path, std::size_t begin, std::size_t end,
                 const std::function<void(std::span<const std::byte>)>& see);

/// All bytes of a file; throws FileError if it cannot be read, as bytes_of_file() does.
[[nodiscard]] Bytes read_whole_file(const std::filesystem::path& path, std::size_t most = longest_file);

/// The same as text.
[[nodiscard]] std::string read_text(const std::filesystem::path& path, std::size_t most = longest_file);

/// Makes a directory and those above it; throws FileError.
void make_directories(const std::filesystem::path& path);

/// Makes a folder in a directory that the program writes, if there is none. Throws FileError if it cannot, also if a
/// link has its name: files written through it would land elsewhere.
void make_folder(const std::filesystem::path& path);

/// Throws FileError if a symbolic link has this name.
void refuse_link(const std::filesystem::path& path);

/// CRC-64/XZ, by liblzma: differs for any two inputs of one length that differ in
/// one run of up to 64 bits, and for others with probability 1 - 2^-64.
/// \param before  the sum of what stands before these bytes
[[nodiscard]] std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t before = 0);

/// CRC-32 as zlib and Python compute it, for files that others write too. \param before  as of crc64()
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

}  // namespace polybed::core
