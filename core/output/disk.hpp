// A file driver of HDF5 for files that one rank writes. It remembers the first system call that failed and lets HDF5 go
// on: HDF5 1.10 leaves a file half closed when a call fails while it closes it, and crashes at the end of the program.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/output/descriptor.hpp"

namespace polybed::core {

/// A file that is there, opened to be changed. Throws FileError.
class Disk {
 public:
  explicit Disk(std::filesystem::path path);
  /// Lets a list of properties, by HDF5's number, open this file under any name. It must outlive what is opened. Throws
  /// FileError.
  void use_in(std::int64_t access_list);
  /// Throws the FileError of the first call of the system that failed.
  void check() const;
  /// After HDF5 has closed it: cuts what was claimed and not used. Throws as check().
  void finish();

 private:
  struct Driver;
  std::filesystem::path path_;
  Descriptor file_;
  unsigned long long size_ = 0;  ///< bytes that HDF5 uses
  int reason_ = 0;               ///< errno of the first call that failed
};

}  // namespace polybed::core
