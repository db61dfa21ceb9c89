#include "core/output/blocks.hpp"

#include <fmt/format.h>

#include <optional>
#include <system_error>

#include "core/numerics/mpi.hpp"
#include "core/output/disk.hpp"
#include "core/output/hdf5.hpp"

namespace polybed::core {

using namespace hdf5;

namespace {

namespace fs = std::filesystem;

/// Room for an index of chunks and for what packing can add to numbers that do not pack.
constexpr std::size_t spare_bytes = 1 << 16;

std::size_t bytes_of(const BlockData& data) {
  const std::size_t numbers = product(data.slab.shape) * sizeof(double);
  return numbers + numbers / 64 + spare_bytes;
}

/// The file as the ranks find it: everything but the blocks' numbers, and room for these. \param packing  of each
void build(const fs::path& path, OutputFile& file, std::span<const BlockData> data, std::span<const Packing> packing) {
  std::size_t room = 0;
  for (std::size_t n = 0; n < data.size(); ++n) {
    const BlockData& d = data[n];
    if (file.has(d.name)) continue;  // another piece of it
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

/// What becomes of Packing::if_small: the first rank's first piece of a dataset is the sample. Collective.
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
    if (product(d.slab.shape) == 0) continue;  // it has no place in the file, which the ranks' common call asks for
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
    std::error_code ignored;  // the error that is under way says more
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
