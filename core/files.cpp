#include "core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/descriptor.hpp"
#include "core/error.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& deed, const fs::path& path, int reason) {
  throw FileError(fmt::format("cannot {} {}: {}", deed, path.string(), std::system_category().message(reason)));
}

/// 0 or the reason why not all bytes reached the disk.
int write_and_flush(Descriptor& file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes = bytes.subspan(std::size_t(written));
  }
  if (::fsync(file.number()) != 0) return errno;
  return file.close();
}

/// Makes a rename survive a power cut. Some file systems cannot flush a directory, which costs nothing but that.
void flush_directory(const fs::path& directory) {
  const Descriptor handle(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.number() >= 0) ::fsync(handle.number());
}

constexpr std::array<std::uint64_t, 256> crc_table() {
  constexpr std::uint64_t polynomial = 0xC96C5795D7870F42;
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t n = 0; n < table.size(); ++n) {
    std::uint64_t crc = n;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? polynomial : 0);
    table[n] = crc;
  }
  return table;
}

}  // namespace

void write_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  const fs::path temporary = path.string() + ".temporary";
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.number() < 0) fail("write", path, errno);
  int reason = write_and_flush(file, bytes);
  if (reason == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) reason = errno;
  if (reason != 0) {
    ::unlink(temporary.c_str());
    fail("write", path, reason);
  }
  flush_directory(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

void write_atomically(const fs::path& path, std::string_view text) {
  write_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void put_in_place(const fs::path& written, const fs::path& path) {
  Descriptor file(::open(written.c_str(), O_RDWR | O_CLOEXEC));
  int reason = file.number() < 0 || ::fsync(file.number()) != 0 ? errno : file.close();
  if (reason == 0 && std::rename(written.c_str(), path.c_str()) != 0) reason = errno;
  if (reason != 0) {
    ::unlink(written.c_str());
    fail("write", path, reason);
  }
  flush_directory(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

void claim_file(const fs::path& path, std::span<const std::byte> bytes, std::size_t size) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.number() < 0) fail("write", path, errno);
  int reason = ::posix_fallocate(file.number(), 0, off_t(std::max(size, bytes.size())));
  if (reason == 0) reason = write_and_flush(file, bytes);
  if (reason == 0) return;
  ::unlink(path.c_str());
  fail("write", path, reason);
}

void append_to_file(const fs::path& path, std::span<const std::byte> bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  const int reason = file.number() < 0 ? errno : write_and_flush(file, bytes);
  if (reason != 0) fail("write", path, reason);
}

std::size_t bytes_of_file(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) fail("read", path, errno);
  return std::size_t(status.st_size);
}

void read_pieces(const fs::path& path, std::size_t begin, std::size_t end,
                 const std::function<void(std::span<const std::byte>)>& see) {
  constexpr std::size_t piece = 1 << 20;
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0) fail("read", path, errno);
  Bytes bytes(std::min(piece, end - begin));
  while (begin < end) {
    const ssize_t count = ::pread(file.number(), bytes.data(), std::min(piece, end - begin), off_t(begin));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("read", path, errno);
    if (count == 0) return;
    see(std::span(bytes).first(std::size_t(count)));
    begin += std::size_t(count);
  }
}

Bytes read_whole_file(const fs::path& path) {
  Bytes bytes;
  const std::size_t size = bytes_of_file(path);
  bytes.reserve(size);
  read_pieces(path, 0, size, [&](auto piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); });
  return bytes;
}

std::string read_text(const fs::path& path) {
  const Bytes bytes = read_whole_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void make_directories(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail("make the directory", path, error.value());
}

std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t before) {
  static constexpr auto table = crc_table();
  std::uint64_t crc = ~before;
  for (const std::byte b : bytes) crc = table[(crc ^ std::uint64_t(b)) & 0xFF] ^ (crc >> 8);
  return ~crc;
}

}  // namespace polybed::core
