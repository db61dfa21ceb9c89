#include "core/checkpoint.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/output_file.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

const FileKind kind{"polybed checkpoint", 1};
constexpr std::string_view mark = "polybed complete";
constexpr std::size_t seal_size = mark.size() + 16;

using Seal = std::array<std::byte, seal_size>;

/// What stands after a whole HDF5 part.
Seal seal_of(std::span<const std::byte> image) {
  Seal seal{};
  std::memcpy(seal.data(), mark.data(), mark.size());
  const std::array<std::uint64_t, 2> numbers{image.size(), crc64(image)};
  for (std::size_t n = 0; n < 2; ++n)
    for (std::size_t b = 0; b < 8; ++b) seal[mark.size() + 8 * n + b] = std::byte((numbers[n] >> (8 * b)) & 0xFF);
  return seal;
}

/// The HDF5 part of a checkpoint; throws FileError if it is not whole.
std::span<const std::byte> unsealed(const Bytes& bytes, const fs::path& path) {
  if (bytes.size() >= seal_size) {
    const auto image = std::span(bytes).first(bytes.size() - seal_size);
    const Seal seal = seal_of(image);
    if (std::memcmp(seal.data(), bytes.data() + image.size(), seal_size) == 0) return image;
  }
  throw FileError(fmt::format("the checkpoint {} is cut short or damaged (its checksum does not hold)", path.string()));
}

bool is_whole(const fs::path& path) {
  try {
    return !unsealed(read_whole_file(path), path).empty();
  } catch (const FileError&) {
    return false;
  }
}

void refuse_slash(const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos)
    throw FileError(fmt::format("'{}' cannot name a part of a checkpoint", name));
}

OutputFile built(const Checkpoint& checkpoint) {
  OutputFile file(kind);
  for (const char* group : {"arrays", "numbers", "integers", "texts"}) file.make_group(group);
  for (const auto& [name, values] : checkpoint.arrays) {
    refuse_slash(name);
    file.write("arrays/" + name, {values.size()}, values);
  }
  for (const auto& [name, value] : checkpoint.numbers) {
    refuse_slash(name);
    file.write("numbers/" + name, {}, std::span(&value, 1));
  }
  for (const auto& [name, value] : checkpoint.integers) {
    refuse_slash(name);
    file.write("integers/" + name, value);
  }
  for (const auto& [name, text] : checkpoint.texts) {
    refuse_slash(name);
    file.write("texts/" + name, text);
  }
  return file;
}

/// Gives the present checkpoint a second name, so that both names exist all the time; where a file system has
/// no second names the present one is moved, which leaves only the previous name for a moment.
void keep_previous(const fs::path& path) {
  const fs::path previous = previous_checkpoint(path), spare = previous.string() + ".temporary";
  ::unlink(spare.c_str());
  const bool linked = ::link(path.c_str(), spare.c_str()) == 0;
  if (!linked && errno == ENOENT) return;
  const fs::path& source = linked ? spare : path;
  if (std::rename(source.c_str(), previous.c_str()) != 0)
    throw FileError(fmt::format("cannot write {}: {}", previous.string(), std::system_category().message(errno)));
  ::unlink(spare.c_str());  // still there if both names were of one file
}

Checkpoint content(const OutputFile& file) {
  Checkpoint checkpoint;
  for (const auto& name : file.names("arrays")) checkpoint.arrays[name] = file.read("arrays/" + name).values;
  for (const auto& name : file.names("numbers")) checkpoint.numbers[name] = file.read("numbers/" + name).values.at(0);
  for (const auto& name : file.names("integers")) checkpoint.integers[name] = file.read_integer("integers/" + name);
  for (const auto& name : file.names("texts")) checkpoint.texts[name] = file.read_text("texts/" + name);
  return checkpoint;
}

}  // namespace

fs::path previous_checkpoint(const fs::path& path) {
  return path.parent_path() / (path.stem().string() + ".previous" + path.extension().string());
}

void write_checkpoint(const fs::path& path, const Checkpoint& checkpoint) {
  Bytes bytes = built(checkpoint).bytes();
  const Seal seal = seal_of(bytes);
  bytes.insert(bytes.end(), seal.begin(), seal.end());
  const fs::path fresh = path.string() + ".new";
  write_atomically(fresh, bytes);
  keep_previous(path);
  if (std::rename(fresh.c_str(), path.c_str()) != 0)
    throw FileError(fmt::format("cannot write {}: {}", path.string(), std::system_category().message(errno)));
}

Checkpoint read_checkpoint(const fs::path& path) {
  try {
    const Bytes bytes = read_whole_file(path);
    return content(OutputFile(unsealed(bytes, path), path, kind));
  } catch (const FileError& error) {
    const fs::path previous = previous_checkpoint(path);
    if (!is_whole(previous)) throw;
    throw FileError(fmt::format("{}; the checkpoint before it, {}, is whole", error.what(), previous.string()));
  }
}

}  // namespace polybed::core
