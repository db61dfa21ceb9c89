#include "core/output/file.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <sys/mman.h>

#include <algorithm>
#include <functional>
#include <new>

#include "core/error.hpp"
#include "core/output/hdf5.hpp"
#include "core/version.hpp"

namespace polybed::core {

using namespace hdf5;

namespace {

/// HDF5 crashes if it lacks memory for a file or when it starts: throws std::bad_alloc instead.
void require_room_for_a_file() {
  constexpr std::size_t room = 8 << 20;
  void* address = ::mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (address == MAP_FAILED) throw std::bad_alloc();
  ::munmap(address, room);
}

template <class Number>
bool is_packed(Packing packing, std::span<const Number> values) {
  return packing != Packing::plain && !values.empty() && (packing != Packing::if_small || repeats(values));
}

}  // namespace

struct OutputFile::State {
  hid_t file = -1;
  std::string path;  ///< path of a file that was read, for messages

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (file >= 0) H5Idec_ref(file);
  }

  /// Files in memory are distinguished by name: each uses its own address. `image`: the initial content.
  void open(std::span<const std::byte> image) {
    require_room_for_a_file();
    constexpr std::size_t growth = 1 << 20;
    const Handle access("a file in memory", [] { return H5Pcreate(H5P_FILE_ACCESS); });
    checked("a file in memory", [&] { return H5Pset_fapl_core(access, growth, false); });
    const std::string name = fmt::format("memory {}", static_cast<const void*>(this));
    if (image.empty()) {
      file = checked("a new file", [&] { return H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access); });
      return;
    }
    checked("a file in memory",
            [&] { return H5Pset_file_image(access, const_cast<std::byte*>(image.data()), image.size()); });
    file = checked("the file", [&] { return H5Fopen(name.c_str(), H5F_ACC_RDWR, access); });
  }

  /// A name for messages.
  [[nodiscard]] std::string label(const std::string& name) const {
    return path.empty() ? name : fmt::format("{} of {}", name, path);
  }
  [[nodiscard]] bool has(const std::string& name) const { return exists(file, name, path); }
  /// The name of an object in this file, existing or not; throws FileError for one in another file.
  [[nodiscard]] const char* own(const std::string& name) const {
    if (name.front() != '/' && has(name)) require_own_link(file, name, path);
    return name.c_str();
  }
  [[nodiscard]] Handle object(const std::string& name) const {
    return Handle(label(name), [&] { return H5Oopen(file, own(name), H5P_DEFAULT); });
  }
  [[nodiscard]] Handle dataset(const std::string& name) const {
    Handle data(label(name), [&] { return H5Dopen2(file, own(name), H5P_DEFAULT); });
    require_own_numbers(data, name, path);
    return data;
  }
  [[nodiscard]] Handle make_dataset(const std::string& name, hid_t type, hid_t space, hid_t properties) const {
    const Handle links = making_groups();
    return Handle(name, [&] { return H5Dcreate2(file, own(name), type, space, links, properties, H5P_DEFAULT); });
  }
  /// Writes a whole dataset: `stored` is the type in the file, `given` the type of the values.
  template <class Number>
  void write_data(const std::string& name, const std::vector<std::size_t>& shape, std::span<const Number> values,
                  Packing packing, hid_t stored, hid_t given) const {
    if (values.size() != product(shape))
      throw FileError(fmt::format("{}: {} numbers do not fill its shape", name, values.size()));
    const Handle space = simple_space(shape), properties = dataset_properties();
    if (is_packed(packing, values) && !shape.empty()) set_packing(properties, chunk_shape(shape));
    const Handle data = make_dataset(name, stored, space, properties);
    if (values.empty()) return;
    checked(name, [&] { return H5Dwrite(data, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()); });
  }
  void write_attribute(const std::string& object_name, const std::string& name, hid_t type, const void* value,
                       const std::vector<std::size_t>& shape = {}) const {
    const Handle owner = object(object_name), space = simple_space(shape);
    const Handle attribute(name,
                           [&] { return H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT); });
    checked(name, [&] { return H5Awrite(attribute, type, value); });
  }
};

namespace {

hid_t stored_type(Packing packing) { return packing == Packing::small_single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE; }

/// Adds the file name to an error of HDF5's.
void readable(const std::filesystem::path& path, const std::function<void()>& reading) {
  try {
    reading();
  } catch (const FileError& error) {
    throw FileError(fmt::format("{} is damaged or no file of polybed: {}", path.string(), error.what()));
  }
}

}  // namespace

OutputFile::OutputFile(const FileKind& kind) : OutputFile() {
  state_->open({});
  set_attribute("/", "filetype", kind.filetype);
  set_attribute("/", "version", std::int64_t(kind.version));
  set_attribute("/", "git_commit", git_commit());
}

OutputFile::OutputFile(const std::filesystem::path& path, const FileKind& kind)
    : OutputFile(read_whole_file(path), path, kind) {}

OutputFile::OutputFile(std::span<const std::byte> bytes, const std::filesystem::path& path, const FileKind& kind)
    : OutputFile() {
  if (bytes.empty()) throw FileError(fmt::format("{} is empty", path.string()));
  readable(path, [&] { state_->open(bytes); });
  check_kind(path, kind);
}

OutputFile OutputFile::on_disk(const std::filesystem::path& path, const FileKind& kind) {
  (void)bytes_of_file(path);
  OutputFile file;
  require_room_for_a_file();
  readable(path, [&] {
    file.state_->file = checked("the file", [&] { return H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT); });
  });
  file.check_kind(path, kind);
  return file;
}

OutputFile::OutputFile() : state_(std::make_unique<State>()) {}

/// From here on messages name the file.
void OutputFile::check_kind(const std::filesystem::path& path, const FileKind& kind) {
  std::string filetype;
  double version = 0;
  readable(path, [&] {
    filetype = text_attribute("/", "filetype");
    version = attribute("/", "version");
  });
  if (filetype != kind.filetype || version != kind.version)
    throw FileError(fmt::format("{} is '{}' version {}; this program reads '{}' version {}", path.string(), filetype,
                                version, kind.filetype, kind.version));
  state_->path = path.string();
}

OutputFile::~OutputFile() = default;
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;

void OutputFile::make_group(const std::string& name) {
  const Handle links = making_groups();
  const Handle group(name,
                     [&] { return H5Gcreate2(state_->file, state_->own(name), links, H5P_DEFAULT, H5P_DEFAULT); });
}

void OutputFile::write(const std::string& name, const std::vector<std::size_t>& shape, std::span<const double> values,
                       Packing packing) {
  const hid_t stored = packing == Packing::small_single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  state_->write_data(name, shape, values, packing, stored, H5T_NATIVE_DOUBLE);
}

void OutputFile::write(const std::string& name, const std::vector<std::size_t>& shape,
                       std::span<const std::int64_t> values, Packing packing) {
  state_->write_data(name, shape, values, packing, H5T_STD_I64LE, H5T_NATIVE_INT64);
}

void OutputFile::write(const std::string& name, const std::vector<std::size_t>& shape,
                       std::span<const std::int32_t> values, Packing packing) {
  state_->write_data(name, shape, values, packing, H5T_STD_I32LE, H5T_NATIVE_INT32);
}

void OutputFile::make(const std::string& name, const std::vector<std::size_t>& shape, Packing packing,
                      const std::vector<std::size_t>& chunk) {
  const Handle space = simple_space(shape), properties = dataset_properties();
  if (packing != Packing::plain) set_packing(properties, chunk_shape(chunk));
  const Handle data = state_->make_dataset(name, stored_type(packing), space, properties);
}

void OutputFile::write(const std::string& name, std::int64_t value) {
  const Handle space = simple_space({}), properties = dataset_properties();
  const Handle data = state_->make_dataset(name, H5T_STD_I64LE, space, properties);
  checked(name, [&] { return H5Dwrite(data, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value); });
}

void OutputFile::write(const std::string& name, const std::string& text) {
  if (text.find('\0') != std::string::npos) throw FileError(name + ": a text with a zero byte cannot be kept");
  const Handle space = simple_space({}), properties = dataset_properties(), type = text_type();
  const Handle data = state_->make_dataset(name, type, space, properties);
  const char* begin = text.c_str();
  checked(name, [&] { return H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &begin); });
}

void OutputFile::set_attribute(const std::string& object, const std::string& name, double value) {
  state_->write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void OutputFile::set_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  state_->write_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void OutputFile::set_attribute(const std::string& object, const std::string& name, const std::string& text) {
  const char* begin = text.c_str();
  state_->write_attribute(object, name, text_type(), &begin);
}

void OutputFile::set_attribute(const std::string& object, const std::string& name,
                               const std::vector<std::string>& texts) {
  std::vector<const char*> begins;
  for (const std::string& text : texts) begins.push_back(text.c_str());
  state_->write_attribute(object, name, text_type(), begins.data(), {begins.size()});
}

void OutputFile::link(const std::string& name, const std::string& file, const std::string& object) {
  const Handle links = making_groups();
  checked(name, [&] {
    return H5Lcreate_external(file.c_str(), object.c_str(), state_->file, state_->own(name), links, H5P_DEFAULT);
  });
}

void OutputFile::remove(const std::string& name) {
  if (!has(name)) throw FileError(state_->label(name) + " is missing");
  checked(state_->label(name), [&] { return H5Ldelete(state_->file, name.c_str(), H5P_DEFAULT); });
}

void OutputFile::make_rows(const std::string& name, std::size_t columns) {
  constexpr std::size_t chunk_rows = 16;
  std::vector<hsize_t> dims{0}, most{H5S_UNLIMITED};
  std::vector<std::size_t> chunk{chunk_rows};
  if (columns > 0) {
    dims.push_back(columns);
    most.push_back(columns);
    chunk.push_back(columns);
  }
  const Handle space(name, [&] { return H5Screate_simple(int(dims.size()), dims.data(), most.data()); });
  const Handle properties = dataset_properties();
  set_packing(properties, chunk);
  const Handle data = state_->make_dataset(name, H5T_IEEE_F64LE, space, properties);
}

void OutputFile::append_row(const std::string& name, std::span<const double> row) {
  const std::string label = state_->label(name);
  const Handle data = state_->dataset(name);
  const std::vector<std::size_t> shape = shape_of(data, label);
  std::vector<hsize_t> dims(shape.begin(), shape.end()), start(shape.size(), 0), count = dims;
  start[0] = dims[0]++;
  count[0] = 1;
  if (row.size() != (count.size() > 1 ? count[1] : 1))
    throw FileError(fmt::format("{}: a row of {} numbers does not fit", label, row.size()));
  checked(label, [&] { return H5Dset_extent(data, dims.data()); });
  const Handle place(label, [&] { return H5Dget_space(data); });
  checked(label,
          [&] { return H5Sselect_hyperslab(place, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr); });
  const Handle source = simple_space({row.size()});
  checked(label, [&] { return H5Dwrite(data, H5T_NATIVE_DOUBLE, source, place, H5P_DEFAULT, row.data()); });
}

void OutputFile::keep_rows(const std::string& name, std::size_t rows, std::size_t columns) {
  const Handle data = state_->dataset(name);
  require_rows(data, name, state_->path, {rows, columns});
  std::vector<hsize_t> dims{rows, columns};
  checked(state_->label(name), [&] { return H5Dset_extent(data, dims.data()); });
}

bool OutputFile::has(const std::string& name) const { return state_->has(name); }

std::vector<std::string> OutputFile::names(const std::string& group) const {
  std::vector<std::string> found;
  const Handle handle = state_->object(group);
  checked(group, [&] { return H5Literate(handle, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &found); });
  return found;
}

DataSet OutputFile::read(const std::string& name) const {
  const Handle data = state_->dataset(name);
  DataSet result{shape_of(data, state_->label(name)), {}};
  result.values.resize(product(result.shape));
  if (!result.values.empty())
    checked(state_->label(name),
            [&] { return H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()); });
  return result;
}

std::vector<std::int64_t> OutputFile::read_integers(const std::string& name) const {
  const Handle data = state_->dataset(name);
  std::vector<std::int64_t> values(product(shape_of(data, state_->label(name))));
  if (!values.empty())
    checked(state_->label(name),
            [&] { return H5Dread(data, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()); });
  return values;
}

std::vector<std::size_t> OutputFile::shape(const std::string& name) const {
  const Handle data = state_->dataset(name);
  return shape_of(data, state_->label(name));
}

std::vector<double> OutputFile::read(const std::string& name, const Slab& slab) const {
  const Handle data = state_->dataset(name), source = simple_space(slab.count), place = place_of(slab, name);
  std::vector<double> values(product(slab.count));
  checked(state_->label(name),
          [&] { return H5Dread(data, H5T_NATIVE_DOUBLE, source, place, H5P_DEFAULT, values.data()); });
  return values;
}

std::int64_t OutputFile::read_integer(const std::string& name) const {
  const Handle data = state_->dataset(name);
  if (!shape_of(data, state_->label(name)).empty()) throw FileError(state_->label(name) + " is not one number");
  std::int64_t value = 0;
  checked(state_->label(name), [&] { return H5Dread(data, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value); });
  return value;
}

std::string OutputFile::read_text(const std::string& name) const {
  const Handle data = state_->dataset(name), type = text_type();
  if (!shape_of(data, state_->label(name)).empty()) throw FileError(state_->label(name) + " is not one text");
  char* buffer = nullptr;
  checked(state_->label(name), [&] { return H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &buffer); });
  return taken(buffer);
}

bool OutputFile::has_attribute(const std::string& object, const std::string& name) const {
  const Handle owner = state_->object(object);
  return checked(state_->label(name), [&] { return H5Aexists(owner, name.c_str()); }) > 0;
}

double OutputFile::attribute(const std::string& object, const std::string& name) const {
  const Handle owner = state_->object(object);
  const Handle attribute(state_->label(name), [&] { return H5Aopen(owner, name.c_str(), H5P_DEFAULT); });
  double value = 0;
  checked(state_->label(name), [&] { return H5Aread(attribute, H5T_NATIVE_DOUBLE, &value); });
  return value;
}

std::string OutputFile::text_attribute(const std::string& object, const std::string& name) const {
  const Handle owner = state_->object(object), type = text_type();
  const Handle attribute(state_->label(name), [&] { return H5Aopen(owner, name.c_str(), H5P_DEFAULT); });
  char* buffer = nullptr;
  checked(state_->label(name), [&] { return H5Aread(attribute, type, &buffer); });
  return taken(buffer);
}

std::vector<std::string> OutputFile::texts_attribute(const std::string& object, const std::string& name) const {
  const Handle owner = state_->object(object), type = text_type();
  const Handle attribute(state_->label(name), [&] { return H5Aopen(owner, name.c_str(), H5P_DEFAULT); });
  const Handle space(state_->label(name), [&] { return H5Aget_space(attribute); });
  std::vector<char*> buffers(
      std::size_t(checked(state_->label(name), [&] { return H5Sget_simple_extent_npoints(space); })), nullptr);
  checked(state_->label(name), [&] { return H5Aread(attribute, type, buffers.data()); });
  std::vector<std::string> texts;
  for (char* buffer : buffers) texts.push_back(taken(buffer));
  return texts;
}

std::span<const std::byte> OutputFile::view() const {
  checked("the file", [&] { return H5Fflush(state_->file, H5F_SCOPE_GLOBAL); });
  const auto size = checked("the file", [&] { return H5Fget_file_image(state_->file, nullptr, 0); });
  void* image = nullptr;  // where the driver for files in memory stores the address
  checked("the file", [&] { return H5Fget_vfd_handle(state_->file, H5P_DEFAULT, &image); });
  return {*static_cast<const std::byte**>(image), std::size_t(size)};
}

void OutputFile::save(const std::filesystem::path& path, Flush flush) const {
  write_atomically(path, view(), {}, flush);
}

}  // namespace polybed::core
