#include "core/output/blocks.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "core/numerics/mpi.hpp"
#include "core/output/descriptor.hpp"
#include "core/output/files.hpp"
#include "core/output/hdf5.hpp"

namespace polybed::core {

using namespace hdf5;

namespace {

namespace fs = std::filesystem;

/// A file driver of HDF5 for changing an existing file. It remembers the first failed system call and lets HDF5
/// continue: HDF5 1.10 leaves a file half closed when a call fails during closing, and crashes at the end of the
/// program.
class Disk {
 public:
  /// Throws FileError.
  explicit Disk(fs::path path) : path_(std::move(path)), file_(::open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC)) {
    if (file_.number() < 0) cannot("write", path_, errno);
  }
  /// Makes a property list open this file under any name. Objects opened in it must not outlive it. Throws FileError.
  void use_in(hid_t access_list) {
    H5FD_class_t calls{};
    calls.name = "polybed";
    calls.maxaddr = haddr_t(INT64_MAX);
    calls.fc_degree = H5F_CLOSE_STRONG;  // objects open in a failed file are closed with it
    calls.fapl_size = sizeof(Disk*);
    calls.open = Driver::open;
    calls.close = Driver::close;
    calls.get_eoa = Driver::get_size;
    calls.set_eoa = Driver::set_size;
    calls.get_eof = Driver::get_end;
    calls.read = Driver::read;
    calls.write = Driver::write;
    const Handle driver(path_.string(), [&] { return H5FDregister(&calls); });
    const Disk* self = this;
    checked(path_.string(), [&] { return H5Pset_driver(access_list, driver, &self); });
  }
  /// Throws the FileError of the first failed system call.
  void check() const {
    if (reason_ != 0) cannot("write", path_, reason_);
  }
  /// Called after HDF5 has closed it: cuts off claimed but unused room. Throws as check().
  void finish() {
    if (reason_ == 0 && ::ftruncate(file_.number(), off_t(size_)) != 0) reason_ = errno;
    if (const int reason = file_.close(); reason_ == 0) reason_ = reason;
    check();
  }

 private:
  /// HDF5's callbacks, and its data for an open file.
  struct Driver {
    H5FD_t of_hdf5;  // HDF5 uses the address of the whole as its first member's
    Disk* disk;
    haddr_t size;  ///< allocated by HDF5
    haddr_t end;   ///< end of the file

    static Driver& of(H5FD_t* file) { return *reinterpret_cast<Driver*>(file); }
    static const Driver& of(const H5FD_t* file) { return *reinterpret_cast<const Driver*>(file); }

    static H5FD_t* open(const char*, unsigned, hid_t access_list, haddr_t) {
      Disk* disk = *static_cast<Disk* const*>(H5Pget_driver_info(access_list));
      struct stat status {};
      if (::fstat(disk->file_.number(), &status) != 0) return nullptr;
      auto* file = new (std::nothrow) Driver{{}, disk, 0, haddr_t(status.st_size)};
      return reinterpret_cast<H5FD_t*>(file);
    }
    static herr_t close(H5FD_t* file) {
      of(file).disk->size_ = of(file).size;
      delete &of(file);
      return 0;
    }
    static haddr_t get_size(const H5FD_t* file, H5FD_mem_t) { return of(file).size; }
    static herr_t set_size(H5FD_t* file, H5FD_mem_t, haddr_t size) {
      of(file).size = size;
      return 0;
    }
    static haddr_t get_end(const H5FD_t* file, H5FD_mem_t) { return std::max(of(file).size, of(file).end); }

    static herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* to) {
      auto* bytes = static_cast<char*>(to);
      while (size > 0) {
        const ssize_t count = ::pread(of(file).disk->file_.number(), bytes, size, off_t(at));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return -1;
        if (count == 0) {  // zeros beyond the end of the file
          std::memset(bytes, 0, size);
          return 0;
        }
        bytes += count, at += haddr_t(count), size -= std::size_t(count);
      }
      return 0;
    }

    static herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* from) {
      int& reason = of(file).disk->reason_;
      const auto* bytes = static_cast<const char*>(from);
      while (size > 0 && reason == 0) {
        const ssize_t count = ::pwrite(of(file).disk->file_.number(), bytes, size, off_t(at));
        if (count < 0 && errno != EINTR) reason = errno;
        if (count < 0) continue;
        bytes += count, at += haddr_t(count), size -= std::size_t(count);
      }
      return 0;
    }
  };

  fs::path path_;
  Descriptor file_;
  unsigned long long size_ = 0;  ///< bytes that HDF5 uses
  int reason_ = 0;               ///< errno of the first call that failed
};

/// Room for an index of chunks, and for incompressible numbers that grow when packed.
constexpr std::size_t spare_bytes = 1 << 16;

std::size_t bytes_of(const BlockData& data) {
  const std::size_t numbers = product(data.slab.shape) * sizeof(double);
  return numbers + numbers / 64 + spare_bytes;
}

/// Builds the file without the blocks' numbers but with room for them. \param packing  of each
void build(const fs::path& path, OutputFile& file, std::span<const BlockData> data, std::span<const Packing> packing) {
  std::size_t room = 0;
  for (std::size_t n = 0; n < data.size(); ++n) {
    const BlockData& d = data[n];
    if (file.has(d.name)) continue;  // another piece of it is there
    file.make(d.name, d.slab.shape, packing[n], d.chunk.empty() ? d.slab.shape : d.chunk);
    room += bytes_of(d);
  }
  const std::span<const std::byte> bytes = file.view();
  claim_file(path, bytes, bytes.size() + room);
}

std::vector<double> values_of(const BlockData& data) {
  std::vector<double> values = data.values();
  if (values.size() != product(data.slab.count))
    throw FileError(fmt::format("{}: {} numbers do not fill its part", data.name, values.size()));
  return values;
}

/// Resolves Packing::if_small: the first rank's first piece of a dataset is the sample. Collective.
std::vector<Packing> settled(std::span<const BlockData> data, const Ranks* ranks) {
  std::vector<Packing> packing;
  for (std::size_t n = 0; n < data.size(); ++n) {
    packing.push_back(data[n].packing);
    if (data[n].packing != Packing::if_small) continue;
    if (n > 0 && data[n].name == data[n - 1].name) {
      packing[n] = packing[n - 1];
      continue;
    }
    std::vector<double> sample;
    on_all(ranks, [&] { sample = values_of(data[n]); });
    const bool small = is_first(ranks) && !sample.empty() && repeats(std::span<const double>(sample));
    packing[n] = on_any_rank(ranks, small) ? Packing::small : Packing::plain;
  }
  return packing;
}

void write_one(hid_t file, hid_t transfer, const BlockData& data, const std::vector<double>& values) {
  const Handle set(data.name, [&] { return H5Dopen2(file, data.name.c_str(), H5P_DEFAULT); });
  const Handle source = simple_space({values.size()}), place = place_of(data.slab, data.name);
  if (values.empty()) checked(data.name, [&] { return H5Sselect_none(source); });
  if (data.packing == Packing::small_single) {  // HDF5 does not convert numbers in a collective call
    const std::vector<float> single(values.begin(), values.end());
    checked(data.name, [&] { return H5Dwrite(set, H5T_NATIVE_FLOAT, source, place, transfer, single.data()); });
  } else {
    checked(data.name, [&] { return H5Dwrite(set, H5T_NATIVE_DOUBLE, source, place, transfer, values.data()); });
  }
}

void write_all(const fs::path& path, std::span<const BlockData> data, const Ranks* ranks) {
  const std::string name = path.string();
  std::optional<Disk> disk;
  const Handle access(name, [] { return H5Pcreate(H5P_FILE_ACCESS); });
  const Handle transfer(name, [] { return H5Pcreate(H5P_DATASET_XFER); });
  if (ranks == nullptr) {
    disk.emplace(path).use_in(access);
  } else {
    checked(name, [&] { return H5Pset_fapl_mpio(access, communicator(ranks), MPI_INFO_NULL); });
    checked(name, [&] { return H5Pset_coll_metadata_write(access, true); });
    checked(name, [&] { return H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE); });
  }
  std::optional<Handle> file;
  on_all(ranks, [&] { file.emplace(name, [&] { return H5Fopen(name.c_str(), H5F_ACC_RDWR, access); }); });
  for (const BlockData& d : data) {
    if (product(d.slab.shape) == 0) continue;  // it has no place in the file, which the ranks' common call needs
    std::vector<double> values;
    on_all(ranks, [&] { values = values_of(d); });
    on_all(ranks, [&] { write_one(*file, transfer, d, values); });
    if (disk) disk->check();
  }
  on_all(ranks, [&] { checked(name, [&] { return H5Fflush(*file, H5F_SCOPE_GLOBAL); }); });
  on_all(ranks, [&] { file->close(name); });
  if (disk) disk->finish();
}

}  // namespace

void write_blocks(OutputFile& file, std::span<const BlockData> data) {
  for (const BlockData& d : data) file.write(d.name, d.slab.shape, d.values(), d.packing);
}

void write_blocks(const fs::path& path, OutputFile* file, std::span<const BlockData> data, const Ranks* ranks) {
  const std::vector<Packing> packing = settled(data, ranks);
  on_first(ranks, [&] { build(path, *file, data, packing); });
  try {
    write_all(path, data, ranks);
  } catch (...) {
    std::error_code ignored;  // the error being thrown says more
    if (is_first(ranks)) fs::remove(path, ignored);
    throw;
  }
}

std::vector<std::size_t> greatest_block(const Grid& grid) {
  std::vector<std::size_t> extents;
  for (int axis = grid.dimensions - 1; axis >= 0; --axis) {
    const int blocks = grid.blocks[std::size_t(axis)];
    extents.push_back(std::size_t((grid.column_cells(axis) + blocks - 1) / blocks));
  }
  return extents;
}

}  // namespace polybed::core
