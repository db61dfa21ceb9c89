#include "core/numerics/halo.hpp"

#include <algorithm>

#include "core/numerics/blocks.hpp"
#include "core/numerics/mpi.hpp"

namespace polybed::core {

void Halo::exchange(std::span<Field* const> fields, int axis) const {
  if (grid_.divided(axis)) return send_and_receive(fields, axis);
  if (!grid_.periodic[std::size_t(axis)]) return;
  for (Field* field : fields) copy_images(*field, axis);
}

void Halo::copy_images(Field& field, int axis) const {
  const int n = grid_.cells[std::size_t(axis)];
  const Index period = n * grid_.stride(axis);
  for (int layer = 0; layer < grid_.ghosts(axis); ++layer) {
    for_each_layer_row(grid_, axis, n + layer, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) field[std::size_t(c)] = field[std::size_t(c - period)];
    });
    for_each_layer_row(grid_, axis, -1 - layer, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) field[std::size_t(c)] = field[std::size_t(c + period)];
    });
  }
}

/// Sends the outermost owned layers to the neighbours; side 0 is the low one. A face field contains the low faces of
/// cells, so the same layers serve; the last block's high face is a boundary and nobody's ghost.
void Halo::send_and_receive(std::span<Field* const> fields, int axis) const {
  const int n = grid_.cells[std::size_t(axis)], depth = grid_.ghosts(axis);
  const MPI_Comm all = communicator(grid_);
  std::array<MPI_Request, 4> requests;
  int open = 0;
  for (const int side : {0, 1}) {
    const int neighbour = neighbour_rank(grid_, axis, side);
    if (neighbour < 0) continue;
    std::vector<double>&out = outgoing_[side], &in = incoming_[side];
    out.clear();
    for (const Field* field : fields)
      for (int layer = 0; layer < depth; ++layer)
        for_each_layer_row(grid_, axis, side == 0 ? layer : n - depth + layer,
                           [&](Index b, Index e) { out.insert(out.end(), field->begin() + b, field->begin() + e); });
    in.resize(out.size());
    // Between two blocks with joined sides both messages have one sender: the side distinguishes them.
    check_mpi(
        MPI_Irecv(in.data(), int(in.size()), MPI_DOUBLE, neighbour, 1 - side, all, &requests[std::size_t(open++)]),
        "MPI_Irecv");
    check_mpi(MPI_Isend(out.data(), int(out.size()), MPI_DOUBLE, neighbour, side, all, &requests[std::size_t(open++)]),
              "MPI_Isend");
  }
  check_mpi(MPI_Waitall(open, requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
  for (const int side : {0, 1}) {
    if (neighbour_rank(grid_, axis, side) < 0) continue;
    const double* from = incoming_[side].data();
    for (Field* field : fields)
      for (int layer = 0; layer < depth; ++layer)
        for_each_layer_row(grid_, axis, side == 0 ? layer - depth : n + layer, [&](Index b, Index e) {
          std::copy(from, from + (e - b), field->begin() + b);
          from += e - b;
        });
  }
}

}  // namespace polybed::core
