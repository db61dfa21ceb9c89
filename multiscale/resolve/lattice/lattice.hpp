// The lattice D3Q19: rest, six neighbours, twelve across an edge. Way i + 1 is the opposite of an odd i.
#pragma once

#include <array>
#include <cstddef>

namespace polybed::multiscale::lattice {

inline constexpr std::size_t directions = 19;

inline constexpr std::array<std::array<int, 3>, directions> ways{{{0, 0, 0},
                                                                  {1, 0, 0},
                                                                  {-1, 0, 0},
                                                                  {0, 1, 0},
                                                                  {0, -1, 0},
                                                                  {0, 0, 1},
                                                                  {0, 0, -1},
                                                                  {1, 1, 0},
                                                                  {-1, -1, 0},
                                                                  {1, -1, 0},
                                                                  {-1, 1, 0},
                                                                  {1, 0, 1},
                                                                  {-1, 0, -1},
                                                                  {1, 0, -1},
                                                                  {-1, 0, 1},
                                                                  {0, 1, 1},
                                                                  {0, -1, -1},
                                                                  {0, 1, -1},
                                                                  {0, -1, 1}}};

[[nodiscard]] constexpr std::size_t opposite(std::size_t i) { return i == 0 ? 0 : (i % 2 == 1 ? i + 1 : i - 1); }

[[nodiscard]] constexpr double weight(std::size_t i) { return i == 0 ? 1.0 / 3 : (i < 7 ? 1.0 / 18 : 1.0 / 36); }

}  // namespace polybed::multiscale::lattice
