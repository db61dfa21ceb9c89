// An HDF5 file that is built and read in memory; only the complete file reaches the disk.
//
// HDF5 writes the pieces of a file's index at times of its own. A program killed in mid-write, or a full disk, leaves a
// file that no reader opens, and the earlier steps are lost with the last one. So a file is built in memory, and
// core/output/files.hpp puts the finished bytes in place with one rename.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/output/files.hpp"

namespace polybed::core {

/// Identity of a file: the attributes `filetype` and `version` of its root.
struct FileKind {
  std::string filetype;  ///< "polybed fields" and so on
  int version = 1;       ///< of the layout; increased when a reader of the old one would fail
};

/// Numbers with their shape, in C order.
struct DataSet {
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

enum class Packing {
  plain,        ///< uncompressed
  small,        ///< deflate and shuffle
  if_small,     ///< the same if a sample of the numbers has repetitions: others hardly shrink and take long
  small_single  ///< the same in single precision, for pictures
};

/// One rank's part of a dataset, slowest axis first.
struct Slab {
  std::vector<std::size_t> shape;         ///< of the dataset
  std::vector<std::size_t> start, count;  ///< of the rank's part in it

  bool operator==(const Slab&) const = default;
};

class OutputFile {
 public:
  /// A new, empty file with filetype, version and git_commit.
  explicit OutputFile(const FileKind& kind);
  /// Reads a file from the disk; throws FileError if it is not an HDF5 file, or not of this kind and version.
  OutputFile(const std::filesystem::path& path, const FileKind& kind);
  /// The same from bytes already read; `path` is for messages.
  OutputFile(std::span<const std::byte> bytes, const std::filesystem::path& path, const FileKind& kind);
  /// Reads a file in place, without memory for the whole of it.
  [[nodiscard]] static OutputFile on_disk(const std::filesystem::path& path, const FileKind& kind);
  ~OutputFile();
  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;

  /// Objects are named by path, "step/voidage"; missing groups on the way are created. An empty shape is a scalar.
  void make_group(const std::string& name);
  void write(const std::string& name, const std::vector<std::size_t>& shape, std::span<const double> values,
             Packing packing = Packing::plain);
  void write(const std::string& name, const std::vector<std::size_t>& shape, std::span<const std::int64_t> values,
             Packing packing = Packing::plain);
  void write(const std::string& name, const std::vector<std::size_t>& shape, std::span<const std::int32_t> values,
             Packing packing = Packing::plain);
  /// A dataset whose numbers are written later with core/output/blocks.hpp.
  /// \param chunk  greatest piece that is packed as one
  void make(const std::string& name, const std::vector<std::size_t>& shape, Packing packing,
            const std::vector<std::size_t>& chunk);
  void write(const std::string& name, std::int64_t value);
  void write(const std::string& name, const std::string& text);
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, const std::string& text);
  void set_attribute(const std::string& object, const std::string& name, const std::vector<std::string>& texts);
  /// A link to an object in another file; `file` is relative to the directory of this one.
  void link(const std::string& name, const std::string& file, const std::string& object);
  void remove(const std::string& name);

  /// A dataset [row][column] that grows, without rows at first. Without columns (0) it is [row].
  void make_rows(const std::string& name, std::size_t columns);
  void append_row(const std::string& name, std::span<const double> row);
  /// Removes the rows after the first `rows`. Throws FileError for a dataset with fewer rows, with other columns, or
  /// that cannot grow.
  void keep_rows(const std::string& name, std::size_t rows, std::size_t columns);

  [[nodiscard]] bool has(const std::string& name) const;
  /// Names in a group, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names(const std::string& group) const;
  [[nodiscard]] DataSet read(const std::string& name) const;
  [[nodiscard]] std::vector<std::int64_t> read_integers(const std::string& name) const;
  [[nodiscard]] std::vector<std::size_t> shape(const std::string& name) const;
  /// A part of a dataset.
  [[nodiscard]] std::vector<double> read(const std::string& name, const Slab& slab) const;
  [[nodiscard]] std::int64_t read_integer(const std::string& name) const;
  [[nodiscard]] std::string read_text(const std::string& name) const;
  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] double attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::string text_attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::vector<std::string> texts_attribute(const std::string& object, const std::string& name) const;

  /// The bytes of the file in memory, valid until it changes.
  [[nodiscard]] std::span<const std::byte> view() const;
  /// Writes the file to the disk; it can be changed and saved again.
  void save(const std::filesystem::path& path, Flush flush = Flush::all) const;

 private:
  OutputFile();
  void check_kind(const std::filesystem::path& path, const FileKind& kind);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace polybed::core
