#include "core/output/checkpoint.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/blocks.hpp"

namespace polybed::core {

namespace {

namespace fs = std::filesystem;

const FileKind kind{"polybed checkpoint", 2};
constexpr std::string_view mark = "polybed complete";
constexpr std::size_t seal_size = mark.size() + 16;

using Seal = std::array<std::byte, seal_size>;

/// The seal after a complete HDF5 part, from its size and checksum.
Seal seal_of(std::size_t size, std::uint64_t sum) {
  Seal seal{};
  std::memcpy(seal.data(), mark.data(), mark.size());
  const std::array<std::uint64_t, 2> numbers{size, sum};
  for (std::size_t n = 0; n < 2; ++n)
    for (std::size_t b = 0; b < 8; ++b) seal[mark.size() + 8 * n + b] = std::byte((numbers[n] >> (8 * b)) & 0xFF);
  return seal;
}

/// The seal for the first bytes of a file.
Seal seal_of(const fs::path& path, std::size_t size) {
  std::uint64_t sum = 0;
  read_pieces(path, 0, size, [&](auto piece) { sum = crc64(piece, sum); });
  return seal_of(size, sum);
}

/// Throws FileError if a checkpoint is incomplete.
void check_whole(const fs::path& path) {
  const std::size_t size = bytes_of_file(path);
  if (size >= seal_size) {
    Bytes found;
    read_pieces(path, size - seal_size, size,
                [&](auto piece) { found.insert(found.end(), piece.begin(), piece.end()); });
    const Seal seal = seal_of(path, size - seal_size);
    if (std::equal(seal.begin(), seal.end(), found.begin(), found.end())) return;
  }
  throw FileError(fmt::format("the checkpoint {} is cut short or damaged (its checksum does not hold)", path.string()));
}

bool is_whole(const fs::path& path) {
  try {
    check_whole(path);
    return true;
  } catch (const FileError&) {
    return false;
  }
}

void refuse_slash(const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos)
    throw FileError(fmt::format("'{}' cannot name a part of a checkpoint", name));
}

/// Arrays outside parts are freed as they are written: memory may not suffice for two copies of them.
OutputFile built(Checkpoint& checkpoint) {
  OutputFile file(kind);
  for (const char* group : {"arrays", "fields", "numbers", "integers", "texts"}) file.make_group(group);
  for (auto& [name, values] : checkpoint.arrays) {
    refuse_slash(name);
    if (checkpoint.parts.contains(name)) continue;
    file.write("arrays/" + name, {values.size()}, values);
    std::vector<double>().swap(values);
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

/// Gives the present checkpoint a second name, so that both names exist all the time. A file system without second
/// names moves it instead, which leaves only the previous name for a moment.
void keep_previous(const fs::path& path) {
  const fs::path previous = previous_checkpoint(path), spare = previous.string() + ".temporary";
  ::unlink(spare.c_str());
  const bool linked = ::link(path.c_str(), spare.c_str()) == 0;
  const fs::path& source = linked ? spare : path;
  if (std::rename(source.c_str(), previous.c_str()) != 0) {
    if (!linked && errno == ENOENT) return;  // the first checkpoint
    throw FileError(fmt::format("cannot write {}: {}", previous.string(), std::system_category().message(errno)));
  }
  ::unlink(spare.c_str());  // still there if both names were one file
}

std::string place_in_file(const std::string& array, const CheckpointPart& part) {
  return "fields/" + array + "/" + part.name;
}

std::size_t size_of(const CheckpointPart& part) {
  return std::accumulate(part.slab.count.begin(), part.slab.count.end(), std::size_t(1), std::multiplies<>());
}

std::vector<BlockData> block_data(const Checkpoint& checkpoint) {
  std::vector<BlockData> data;
  for (const auto& [array, parts] : checkpoint.parts) {
    const double* from = checkpoint.arrays.at(array).data();
    for (const CheckpointPart& part : parts) {
      refuse_slash(part.name);
      const double* end = from + size_of(part);
      data.push_back({place_in_file(array, part),
                      part.slab,
                      Packing::plain,
                      [from, end] { return std::vector<double>(from, end); },
                      {}});
      from = end;
    }
  }
  return data;
}

/// Writes a complete checkpoint under a name: in one go from one rank, or block by block from several ranks or with
/// only part of it in memory.
void write_fresh(const fs::path& fresh, Checkpoint& checkpoint, const Ranks* ranks, std::vector<BlockData> more) {
  const bool in_memory = ranks == nullptr && more.empty();
  std::vector<BlockData> data = block_data(checkpoint);
  for (BlockData& d : more) {
    const std::size_t slash = d.name.find('/');
    const bool part = slash != std::string::npos;
    refuse_slash(d.name.substr(0, slash));
    if (part) refuse_slash(d.name.substr(slash + 1));
    d.name = (part ? "fields/" : "arrays/") + d.name;
    data.push_back(std::move(d));
  }
  std::optional<OutputFile> file;
  on_first(ranks, [&] { file.emplace(built(checkpoint)); });
  if (in_memory) {
    write_blocks(*file, data);
    const std::span<const std::byte> bytes = file->view();
    write_atomically(fresh, bytes, seal_of(bytes.size(), crc64(bytes)), Flush::content);
    return;
  }
  const fs::path temporary = fresh.string() + ".temporary";
  write_blocks(temporary, file ? &*file : nullptr, data, ranks);
  on_first(ranks, [&] {
    append_to_file(temporary, seal_of(temporary, bytes_of_file(temporary)));
    put_in_place(temporary, fresh, Flush::content);
  });
}

double one_number(const OutputFile& file, const std::string& name) {
  const std::vector<double> values = file.read(name).values;
  if (values.size() != 1) refuse_checkpoint(fmt::format("{} has {} numbers in place of one", name, values.size()));
  return values.front();
}

Checkpoint content(const OutputFile& file) {
  Checkpoint checkpoint;
  for (const auto& name : file.names("arrays")) checkpoint.arrays[name] = file.read("arrays/" + name).values;
  for (const auto& name : file.names("numbers")) checkpoint.numbers[name] = one_number(file, "numbers/" + name);
  for (const auto& name : file.names("integers")) checkpoint.integers[name] = file.read_integer("integers/" + name);
  for (const auto& name : file.names("texts")) checkpoint.texts[name] = file.read_text("texts/" + name);
  return checkpoint;
}

template <class Value>
const Value& entry(const std::map<std::string, Value>& entries, const std::string& name) {
  const auto found = entries.find(name);
  if (found == entries.end()) refuse_checkpoint(fmt::format("it has no {}", name));
  return found->second;
}

constexpr std::array<const char*, 3> names_of_layers{"widths", "layers", "depths"};  // along x, y and z

}  // namespace

void put_layers(const Grid& grid, Checkpoint& checkpoint) {
  for (int axis = 0; axis < 3; ++axis)
    if (const Layers* layers = grid.graded(axis))
      checkpoint.texts[names_of_layers[std::size_t(axis)]] = fmt::format("{}", fmt::join(layers->height, " "));
}

void require_layers(const Grid& grid, const Checkpoint& checkpoint) {
  Checkpoint own;
  put_layers(grid, own);
  const auto layers_of = [](const Checkpoint& one) {
    std::string all;
    for (const char* name : names_of_layers)
      if (const auto found = one.texts.find(name); found != one.texts.end()) all += name + (" " + found->second);
    return all;
  };
  if (layers_of(own) != layers_of(checkpoint))
    throw FileError(
        "the checkpoint is of a column with other layers of cells: column.grading, graded_above, "
        "grading_across, size or cells differ");
}

void refuse_checkpoint(const std::string& reason) {
  throw FileError("the checkpoint is whole but cannot be resumed: " + reason);
}

void name_checkpoint(const fs::path& path, const std::function<void()>& take_up) {
  try {
    take_up();
  } catch (const FileError& error) {
    if (std::string_view(error.what()).find(path.string()) != std::string_view::npos) throw;
    throw FileError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

void require_numbers(const Checkpoint& checkpoint) {
  constexpr double greatest = 1e30;
  const auto odd = [](double v) { return !(std::abs(v) <= greatest); };
  for (const auto& [name, values] : checkpoint.arrays)
    if (const auto found = std::find_if(values.begin(), values.end(), odd); found != values.end())
      refuse_checkpoint(fmt::format("number {} of {} is {}", found - values.begin() + 1, name, *found));
  for (const auto& [name, value] : checkpoint.numbers)
    if (odd(value)) refuse_checkpoint(fmt::format("{} is {}", name, value));
}

const std::vector<double>& Checkpoint::array(const std::string& name) const { return entry(arrays, name); }
double Checkpoint::number(const std::string& name) const { return entry(numbers, name); }
std::int64_t Checkpoint::integer(const std::string& name) const { return entry(integers, name); }

double Checkpoint::time(const std::string& name) const {
  constexpr double longest = 1e9;  // s, the limit of run.until
  const double seconds = number(name);
  if (!(seconds >= 0 && seconds <= longest)) refuse_checkpoint(fmt::format("{} is {:g} s", name, seconds));
  return seconds;
}

std::int64_t Checkpoint::count(const std::string& name) const {
  const std::int64_t times = integer(name);
  if (times < 0) refuse_checkpoint(fmt::format("{} is {}", name, times));
  return times;
}

fs::path previous_checkpoint(const fs::path& path) {
  return path.parent_path() / (path.stem().string() + ".previous" + path.extension().string());
}

void write_checkpoint(const fs::path& path, Checkpoint checkpoint, const Ranks* ranks, std::vector<BlockData> more) {
  const fs::path fresh = path.string() + ".new";
  write_fresh(fresh, checkpoint, ranks, std::move(more));
  on_first(ranks, [&] {
    keep_previous(path);
    if (std::rename(fresh.c_str(), path.c_str()) != 0)
      throw FileError(fmt::format("cannot write {}: {}", path.string(), std::system_category().message(errno)));
    flush_directory(path.has_parent_path() ? path.parent_path() : fs::path("."));
  });
}

void read_parts(const fs::path& path, const CheckpointParts& parts, Checkpoint& checkpoint) {
  const OutputFile file = OutputFile::on_disk(path, kind);
  for (const auto& [array, list] : parts) {
    if (!file.has("fields/" + array)) continue;
    std::vector<double>& values = checkpoint.arrays[array];
    values.clear();
    for (const CheckpointPart& part : list) {
      const std::string name = place_in_file(array, part);
      if (!file.has(name) || file.shape(name) != part.slab.shape)
        throw FileError(fmt::format("{} belongs to another case: it has no {} of this shape", path.string(), name));
      const std::vector<double> mine = file.read(name, part.slab);
      values.insert(values.end(), mine.begin(), mine.end());
    }
    checkpoint.parts[array] = list;
  }
}

Checkpoint read_checkpoint(const fs::path& path) {
  try {
    check_whole(path);
    Checkpoint checkpoint;
    name_checkpoint(path, [&] { checkpoint = content(OutputFile::on_disk(path, kind)); });
    return checkpoint;
  } catch (const FileError& error) {
    const fs::path previous = previous_checkpoint(path);
    if (!is_whole(previous)) throw;
    throw FileError(fmt::format("{}; the checkpoint before it, {}, is whole", error.what(), previous.string()));
  }
}

std::vector<double> read_array(const fs::path& path, const std::string& name) {
  check_whole(path);
  const OutputFile file = OutputFile::on_disk(path, kind);
  return file.has("arrays/" + name) ? file.read("arrays/" + name).values : std::vector<double>();
}

}  // namespace polybed::core
