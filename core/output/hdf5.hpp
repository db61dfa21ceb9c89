// Wrappers for HDF5's C interface: identifiers that release themselves, one check of every return value, and the
// property lists in use. Only core/output/file.cpp, blocks.cpp and disk.cpp include it.
#pragma once

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/output/file.hpp"

namespace polybed::core::hdf5 {

/// The innermost error of HDF5's stack.
struct Reason {
  std::string text = "no reason given";
  bool memory = false;  ///< it lacked memory
};

inline herr_t keep_reason(unsigned depth, const H5E_error2_t* error, void* kept) {
  if (depth != 0) return 0;
  auto& reason = *static_cast<Reason*>(kept);
  if (error->desc != nullptr) reason.text = error->desc;
  reason.memory = error->maj_num == H5E_RESOURCE && (error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC);
  return 0;
}

/// The one check of HDF5's return values: a negative one is a failure, and its innermost reason goes into the message.
/// HDF5's own printing of errors is turned off at the first call for good, as it also prints when the program ends.
template <class Call>
auto checked(const std::string& what, Call&& call) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const auto result = call();
  if (result < 0) {
    Reason reason;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_reason, &reason);
    throw FileError(fmt::format("HDF5 failed on {}: {}{}", what, reason.text,
                                reason.memory ? " (not enough memory: choose fewer column.cells)" : ""));
  }
  return result;
}

/// Any HDF5 identifier, released at the end of the scope.
class Handle {
 public:
  template <class Call>
  Handle(const std::string& what, Call&& call) : id_(checked(what, call)) {}
  ~Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  /// Releases it now: for operations that can still fail then.
  void close(const std::string& what) {
    const hid_t id = std::exchange(id_, -1);
    checked(what, [&] { return H5Idec_ref(id); });
  }

 private:
  hid_t id_;
};

/// Text of any length, which h5py reads as str.
inline Handle text_type() {
  return Handle("a text type", [] {
    const hid_t type = H5Tcopy(H5T_C_S1);
    return H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0 ? hid_t(-1) : type;
  });
}

inline Handle simple_space(const std::vector<std::size_t>& shape) {
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  return Handle("a shape", [&] {
    return dims.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(int(dims.size()), dims.data(), nullptr);
  });
}

/// Creates missing groups on the way to a new object.
inline Handle making_groups() {
  return Handle("a property list", [] {
    const hid_t list = H5Pcreate(H5P_LINK_CREATE);
    return H5Pset_create_intermediate_group(list, 1) < 0 ? hid_t(-1) : list;
  });
}

/// Equal data give equal bytes: no time stamps.
inline Handle dataset_properties() {
  return Handle("a property list", [] {
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    return H5Pset_obj_track_times(list, false) < 0 ? hid_t(-1) : list;
  });
}

inline void set_packing(hid_t properties, const std::vector<std::size_t>& shape) {
  const std::vector<hsize_t> chunk(shape.begin(), shape.end());
  checked("the chunks", [&] { return H5Pset_chunk(properties, int(chunk.size()), chunk.data()); });
  checked("shuffle", [&] { return H5Pset_shuffle(properties); });
  checked("deflate", [&] { return H5Pset_deflate(properties, 4); });
}

/// Whether numbers repeat: less than half of a sample are new.
template <class Number>
bool repeats(std::span<const Number> values) {
  constexpr std::size_t runs = 32, length = 64;
  std::vector<Number> sample;
  for (std::size_t run = 0; run < runs; ++run) {
    const std::size_t begin = values.size() / runs * run;
    const auto piece = values.subspan(begin, std::min(length, values.size() - begin));
    sample.insert(sample.end(), piece.begin(), piece.end());
  }
  std::sort(sample.begin(), sample.end());
  return 2 * (std::unique(sample.begin(), sample.end()) - sample.begin()) < std::ptrdiff_t(sample.size());
}

/// Chunks of at most this many numbers (8 MB): HDF5 requires less than 4 GB and caches 1 MB.
inline constexpr std::size_t chunk_numbers = 1 << 20;

inline std::vector<std::size_t> chunk_shape(std::vector<std::size_t> shape) {
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    std::size_t rest = 1;
    for (std::size_t later = axis + 1; later < shape.size(); ++later) rest *= shape[later];
    shape[axis] = std::clamp<std::size_t>(chunk_numbers / rest, 1, shape[axis]);
  }
  return shape;
}

inline std::vector<std::size_t> shape_of(hid_t dataset, const std::string& name) {
  const Handle space(name, [&] { return H5Dget_space(dataset); });
  const int rank = checked(name, [&] { return H5Sget_simple_extent_ndims(space); });
  std::vector<hsize_t> dims(std::size_t(rank), 0);
  checked(name, [&] { return H5Sget_simple_extent_dims(space, dims.data(), nullptr); });
  return {dims.begin(), dims.end()};
}

/// The place of a rank's part in a dataset with the shape that it names.
inline Handle place_of(const Slab& slab, const std::string& name) {
  const std::vector<hsize_t> dims(slab.shape.begin(), slab.shape.end()), start(slab.start.begin(), slab.start.end()),
      count(slab.count.begin(), slab.count.end());
  return Handle(name, [&] {
    const hid_t space = H5Screate_simple(int(dims.size()), dims.data(), nullptr);
    const bool none = std::find(count.begin(), count.end(), hsize_t(0)) != count.end();
    const herr_t done = none ? H5Sselect_none(space)
                             : H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
    return done < 0 ? hid_t(-1) : space;
  });
}

inline std::size_t product(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t(1), std::multiplies<>());
}

/// Copies a text from a buffer that HDF5 allocated, and frees it.
inline std::string taken(char* buffer) {
  std::string text = buffer != nullptr ? buffer : "";
  H5free_memory(buffer);
  return text;
}

inline herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

[[noreturn]] inline void refuse_elsewhere(const std::string& path, const std::string& what) {
  throw FileError(fmt::format("{}: {}; what other files contain is neither read nor changed", path, what));
}

/// Throws FileError for a link to another file or by name: HDF5 would follow it anywhere and change its target.
/// \param path  of the file, for the message
inline void require_own_link(hid_t file, const std::string& name, const std::string& path) {
  H5L_info_t link{};
  checked(name, [&] { return H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT); });
  if (link.type != H5L_TYPE_HARD) refuse_elsewhere(path, name + " is a link to another place");
}

/// Whether every link on the way exists; HDF5 fails for a path with a missing part. Throws FileError if the way leads
/// to another file.
inline bool exists(hid_t file, const std::string& name, const std::string& path) {
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    if (checked(name, [&] { return H5Lexists(file, part.c_str(), H5P_DEFAULT); }) == 0) return false;
    if (end == std::string::npos) return true;
    require_own_link(file, part, path);
  }
}

/// Throws FileError for numbers in other files, which HDF5 would read or overwrite.
inline void require_own_numbers(hid_t dataset, const std::string& name, const std::string& path) {
  const Handle properties(name, [&] { return H5Dget_create_plist(dataset); });
  const bool external = checked(name, [&] { return H5Pget_external_count(properties); }) > 0;
  if (external || checked(name, [&] { return H5Pget_layout(properties); }) == H5D_VIRTUAL)
    refuse_elsewhere(path, "the numbers of " + name + " are in another file");
}

/// Throws FileError for a dataset that cannot grow by rows: HDF5's own message lacks the file.
/// \param shape  minimum rows, and columns, 0 for one number per row
inline void require_rows(hid_t dataset, const std::string& name, const std::string& path,
                         std::pair<std::size_t, std::size_t> shape) {
  const auto [rows, columns] = shape;
  const std::vector<std::size_t> has = shape_of(dataset, name);
  std::vector<hsize_t> most(has.size(), 0);
  const Handle space(name, [&] { return H5Dget_space(dataset); }), type(name, [&] { return H5Dget_type(dataset); });
  const Handle properties(name, [&] { return H5Dget_create_plist(dataset); });
  checked(name, [&] { return H5Sget_simple_extent_dims(space, nullptr, most.data()); });
  const bool fits = has.size() == (columns > 0 ? 2 : 1) && has[0] >= rows && (columns == 0 || has[1] == columns),
             chunked = checked(name, [&] { return H5Pget_layout(properties); }) == H5D_CHUNKED,
             doubles = checked(name, [&] { return H5Tequal(type, H5T_IEEE_F64LE); }) > 0;
  if (!fits || !chunked || !doubles || most[0] != H5S_UNLIMITED)
    throw FileError(fmt::format(
        "{}: the dataset {} cannot be continued: polybed writes double precision in chunks, of any length, here at "
        "least {} rows{}",
        path, name, rows, columns > 0 ? fmt::format(" of {} numbers", columns) : ""));
}

}  // namespace polybed::core::hdf5
