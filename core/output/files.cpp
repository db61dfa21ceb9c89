#include "core/output/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <lzma.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/error.hpp"
#include "core/output/descriptor.hpp"
#include "core/print.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

/// Throws for anything other than a regular file, as others can be endless.
void require_regular(const std::string& deed, const fs::path& path, const struct stat& status) {
  if (S_ISDIR(status.st_mode)) cannot(deed, path, EISDIR);
  if (!S_ISREG(status.st_mode))
    throw FileError(fmt::format("cannot {} {}: it is no regular file, but a pipe or a device", deed, path.string()));
}

/// Opens an existing regular file; does not wait for a pipe. \param deed  as in "read"
Descriptor opened(const std::string& deed, const fs::path& path, int way) {
  Descriptor file(::open(path.c_str(), way | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) cannot(deed, path, errno);
  require_regular(deed, path, status);
  return file;
}

/// 0 or the reason why not all bytes were written.
int write_all(const Descriptor& file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes = bytes.subspan(std::size_t(written));
  }
  return 0;
}

/// 0 or the reason why not all bytes were written or, if flushed, did not reach the disk.
int write_and_close(Descriptor& file, std::span<const std::byte> bytes, std::span<const std::byte> more, Flush flush) {
  for (const auto& part : {bytes, more})
    if (const int reason = write_all(file, part); reason != 0) return reason;
  if (flush != Flush::nothing && ::fsync(file.number()) != 0) return errno;
  return file.close();
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

Descriptor opened_to_append(const fs::path& path) { return opened("write", path, O_WRONLY | O_APPEND | O_NOFOLLOW); }

Descriptor begun(const fs::path& path, std::string_view text) {
  write_atomically(path, text, Flush::content);
  return opened_to_append(path);
}

/// Renames a file; 0 or the reason why not.
int rename_and_flush(const fs::path& written, const fs::path& path, Flush flush) {
  if (std::rename(written.c_str(), path.c_str()) != 0) return errno;
  if (flush == Flush::all) flush_directory(path.has_parent_path() ? path.parent_path() : fs::path("."));
  return 0;
}

/// Claims the blocks of the first bytes of a file; 0 or the reason why not.
int claim(const Descriptor& file, std::size_t size) {
  int reason = EINTR;
  while (reason == EINTR) reason = ::posix_fallocate(file.number(), 0, off_t(size));
  return reason;
}

/// Replaces the content of a file in place if the disk has room for all of it; false if it has not, or if the file is
/// not regular with one name.
bool overwritten(const fs::path& path, std::span<const std::byte> bytes) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) return false;
  if (!S_ISREG(status.st_mode) || status.st_nlink != 1 || claim(file, bytes.size()) != 0) return false;
  return write_all(file, bytes) == 0 && ::ftruncate(file.number(), off_t(bytes.size())) == 0 &&
         ::fsync(file.number()) == 0;
}

}  // namespace

void cannot(const std::string& deed, const fs::path& path, int reason) {
  throw FileError(fmt::format("cannot {} {}: {}", deed, path.string(), std::system_category().message(reason)));
}

Descriptor new_file(const fs::path& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) cannot("write", path, errno);
  const int number = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (number < 0) cannot("write", path, errno);
  return Descriptor(number);
}

namespace {

/// Creates a file of a size with its blocks claimed; 0 or the reason why not.
int claimed(const fs::path& path, std::span<const std::byte> bytes, std::size_t size) {
  Descriptor file = new_file(path);
  int reason = claim(file, std::max(size, bytes.size()));
  if (reason == 0) reason = write_and_close(file, bytes, {}, Flush::nothing);
  if (reason != 0) ::unlink(path.c_str());
  return reason;
}

}  // namespace

LineFile::LineFile(fs::path path, std::string_view text)
    : path_(std::move(path)), file_(begun(path_, text)), size_(std::int64_t(text.size())) {}

/// Restores the file's lines, which the open descriptor still has.
void LineFile::put_back() {
  struct stat ours {
  }, there{};
  if (::fstat(file_.number(), &ours) != 0) cannot("write", path_, errno);
  if (ours.st_size < size_)
    print(stderr, "warning: {} was truncated while the run writes it: lines are lost\n", path_.string());
  size_ = ours.st_size;
  if (::lstat(path_.c_str(), &there) == 0 && ours.st_ino == there.st_ino && ours.st_dev == there.st_dev) return;
  file_ = begun(path_, read_text(fmt::format("/proc/self/fd/{}", file_.number())));
  print(stderr, "warning: {} was removed or replaced while it is being written: it is there again\n", path_.string());
}

void LineFile::flush() {
  put_back();
  if (::fsync(file_.number()) != 0) cannot("write", path_, errno);
}

void LineFile::append(std::string_view line) {
  put_back();
  if (const int reason = write_all(file_, bytes_of(line)); reason != 0) cannot("write", path_, reason);
  size_ += std::int64_t(line.size());
}

void flush_directory(const fs::path& directory) {
  const Descriptor handle(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.number() >= 0) ::fsync(handle.number());
}

void write_atomically(const fs::path& path, std::span<const std::byte> bytes, std::span<const std::byte> more,
                      Flush flush) {
  const fs::path temporary = path.string() + ".temporary";
  Descriptor file = new_file(temporary);
  int reason = write_and_close(file, bytes, more, flush);
  if (reason == 0) reason = rename_and_flush(temporary, path, flush);
  if (reason == 0) return;
  ::unlink(temporary.c_str());
  cannot("write", path, reason);
}

void write_atomically(const fs::path& path, std::string_view text, Flush flush) {
  write_atomically(path, bytes_of(text), {}, flush);
}

void write_last(const fs::path& path, std::string_view text) {
  try {
    write_atomically(path, text);
  } catch (const FileError&) {
    if (!overwritten(path, bytes_of(text))) throw;
  }
}

void put_in_place(const fs::path& written, const fs::path& path, Flush flush) {
  Descriptor file(::open(written.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC));
  int reason = file.number() < 0 ? errno : write_and_close(file, {}, {}, flush);
  if (reason == 0) reason = rename_and_flush(written, path, flush);
  if (reason == 0) return;
  ::unlink(written.c_str());
  cannot("write", path, reason);
}

void claim_file(const fs::path& path, std::span<const std::byte> bytes, std::size_t size) {
  if (const int reason = claimed(path, bytes, size); reason != 0) cannot("write", path, reason);
}

void claim_room(const fs::path& path, std::size_t size) {
  if (const int reason = claimed(path.string() + ".temporary", {}, size); reason != 0) cannot("write", path, reason);
}

void keep_room(const fs::path& path, std::size_t size) {
  for (; size > 0; size /= 2) try {
      return claim_room(path, size);
    } catch (const FileError&) {  // a disk that is nearly full
    }
}

void append_to_file(const fs::path& path, std::span<const std::byte> bytes) {
  Descriptor file = opened_to_append(path);
  if (const int reason = write_and_close(file, bytes, {}, Flush::nothing); reason != 0) cannot("write", path, reason);
}

std::size_t bytes_of_file(const fs::path& path, std::size_t most) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) cannot("read", path, errno);
  require_regular("read", path, status);
  const auto size = std::size_t(status.st_size);
  if (size > most)
    throw FileError(fmt::format("{}: {} bytes is too long, at most {} are read", path.string(), size, most));
  return size;
}

void read_pieces(const fs::path& path, std::size_t begin, std::size_t end,
                 const std::function<void(std::span<const std::byte>)>& see) {
  constexpr std::size_t piece = 1 << 20;
  const Descriptor file = opened("read", path, O_RDONLY);
  Bytes bytes(std::min(piece, end - begin));
  while (begin < end) {
    const ssize_t count = ::pread(file.number(), bytes.data(), std::min(piece, end - begin), off_t(begin));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) cannot("read", path, errno);
    if (count == 0) return;
    see(std::span(bytes).first(std::size_t(count)));
    begin += std::size_t(count);
  }
}

Bytes read_whole_file(const fs::path& path, std::size_t most) {
  Bytes bytes;
  const std::size_t size = bytes_of_file(path, most);
  bytes.reserve(size);
  read_pieces(path, 0, size, [&](auto piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); });
  return bytes;
}

std::string read_text(const fs::path& path, std::size_t most) {
  const Bytes bytes = read_whole_file(path, most);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void make_directories(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) cannot("make the directory", path, error.value());
}

void refuse_link(const fs::path& path) {
  std::error_code none;  // for a file that does not exist
  if (fs::is_symlink(fs::symlink_status(path, none)))
    throw FileError(fmt::format("cannot write into {}: it is a link, which could lead anywhere", path.string()));
}

void make_folder(const fs::path& path) {
  refuse_link(path);
  make_directories(path);
}

std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t before) {
  return lzma_crc64(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), before);
}

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before) {
  return lzma_crc32(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), before);
}

}  // namespace polybed::core
