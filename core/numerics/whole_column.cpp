#include "core/numerics/whole_column.hpp"

#include <algorithm>

#include "core/numerics/blocks.hpp"
#include "core/numerics/mpi.hpp"

namespace polybed::core {

namespace {

Box owned(const Grid& block, const WholeColumn::Part& part) {
  return part.faces_of == WholeColumn::Part::cells ? owned_cells(block) : owned_faces(block, part.faces_of);
}

int entries_of(const Box& box) { return (box.hi[0] - box.lo[0]) * (box.hi[1] - box.lo[1]) * (box.hi[2] - box.lo[2]); }

/// A box of a block, in indices of the whole column.
Box in_column(const Grid& block, Box box) {
  for (std::size_t a = 0; a < 3; ++a) {
    box.lo[a] += block.before[a];
    box.hi[a] += block.before[a];
  }
  return box;
}

}  // namespace

WholeColumn::WholeColumn(const Grid& block) : block_(block), grid_(whole_column(block)), joined_(grid_) {
  for (int rank = 0; rank < block.ranks->count(); ++rank) blocks_.push_back(block_of(grid_, block.ranks, rank));
}

void WholeColumn::gather(const std::vector<Part>& parts) {
  here_.clear();
  for (const Part& part : parts)
    for_each_row(block_, owned(block_, part), [&](Index begin, Index end) {
      here_.insert(here_.end(), part.block.begin() + begin, part.block.begin() + end);
    });
  std::vector<int> counts, places;
  int sum = 0;
  for (const Grid& other : blocks_) {
    places.push_back(sum);
    for (const Part& part : parts) sum += entries_of(owned(other, part));
    counts.push_back(sum - places.back());
  }
  all_.resize(std::size_t(sum));
  check_mpi(MPI_Allgatherv(here_.data(), int(here_.size()), MPI_DOUBLE, all_.data(), counts.data(), places.data(),
                           MPI_DOUBLE, communicator(block_)),
            "MPI_Allgatherv");
  const double* from = all_.data();
  for (const Grid& other : blocks_)
    for (const Part& part : parts)
      for_each_row(grid_, in_column(other, owned(other, part)), [&](Index begin, Index end) {
        std::copy(from, from + (end - begin), part.column->begin() + begin);
        from += end - begin;
      });
  for (const Part& part : parts)
    if (part.faces_of != Part::cells) joined_.exchange(std::array<Field*, 1>{part.column}, part.faces_of);
}

void WholeColumn::copy_cells(const Field& column, Field& block) const {
  const auto [nx, ny, nz] = block_.cells;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j) {
      const Index from = grid_.index(block_.before[0], block_.before[1] + j, block_.before[2] + k);
      std::copy_n(column.begin() + from, nx, block.begin() + block_.index(0, j, k));
    }
}

void add_faces(const std::array<std::span<const double>, 3>& block, FaceField& column,
               std::vector<WholeColumn::Part>& parts) {
  for (std::size_t a = 0; a < 3; ++a)
    if (!column[a].empty()) parts.push_back({block[a], &column[a], int(a)});
}

}  // namespace polybed::core
