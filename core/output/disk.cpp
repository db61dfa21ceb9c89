#include "core/output/disk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <new>
#include <utility>

#include "core/output/files.hpp"
#include "core/output/hdf5.hpp"

namespace polybed::core {

using namespace hdf5;

/// What HDF5 calls, and what it keeps of an open file.
struct Disk::Driver {
  H5FD_t of_hdf5;  // HDF5 takes the address of the whole for that of its part
  Disk* disk;
  haddr_t size;  ///< that HDF5 has given itself
  haddr_t end;   ///< of the file

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
      if (count == 0) {  // behind the end there are zeros
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

Disk::Disk(std::filesystem::path path)
    : path_(std::move(path)), file_(::open(path_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC)) {
  if (file_.number() < 0) cannot("write", path_, errno);
}

void Disk::use_in(std::int64_t access_list) {
  H5FD_class_t calls{};
  calls.name = "polybed";
  calls.maxaddr = haddr_t(INT64_MAX);
  calls.fc_degree = H5F_CLOSE_STRONG;  // what is open in a file that failed is closed with it
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

void Disk::check() const {
  if (reason_ != 0) cannot("write", path_, reason_);
}

void Disk::finish() {
  if (reason_ == 0 && ::ftruncate(file_.number(), off_t(size_)) != 0) reason_ = errno;
  if (const int reason = file_.close(); reason_ == 0) reason_ = reason;
  check();
}

}  // namespace polybed::core
