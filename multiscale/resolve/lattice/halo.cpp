#include "multiscale/resolve/lattice/halo.hpp"

#include <algorithm>
#include <array>

#include "multiscale/resolve/lattice/lattice.hpp"

namespace polybed::multiscale::lattice {

namespace {

constexpr std::size_t crossing = 5;  ///< directions through a face

/// Directions that leave through the lower (-1) or the upper (1) face along an axis.
constexpr std::array<std::size_t, crossing> leaving(std::size_t axis, int side) {
  std::array<std::size_t, crossing> found{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < directions; ++i)
    if (ways[i][axis] == side) found[n++] = i;
  return found;
}

}  // namespace

template <class Real>
void Halo<Real>::along_x(Real* f, Way way) const {
  const std::size_t plane = std::size_t(sites_.box[1] + 2) * sites_.row;
  for (const int side : {-1, 1}) {
    const int inside = side < 0 ? sites_.box[0] : 1, layer = side < 0 ? 0 : sites_.box[0] + 1;
    for (const std::size_t i : leaving(0, side)) {
      Real* const a = f + i * stride_ + std::size_t(inside) * plane;
      Real* const b = f + i * stride_ + std::size_t(layer) * plane;
      way == Way::fill ? std::copy_n(a, plane, b) : std::copy_n(b, plane, a);
    }
  }
}

template <class Real>
void Halo<Real>::along_y(Real* f, Way way) const {
  for (const int side : {-1, 1}) {
    const int inside = side < 0 ? sites_.box[1] : 1, layer = side < 0 ? 0 : sites_.box[1] + 1;
    for (const std::size_t i : leaving(1, side))
      for (int x = 0; x < sites_.box[0] + 2; ++x) {
        Real* const a = f + i * stride_ + sites_.at(x, inside, 0);
        Real* const b = f + i * stride_ + sites_.at(x, layer, 0);
        way == Way::fill ? std::copy_n(a, sites_.row, b) : std::copy_n(b, sites_.row, a);
      }
  }
}

template <class Real>
void Halo<Real>::along_z(Real* f, Way way) const {
  const std::size_t rows = sites_.count() / sites_.row;
  for (const int side : {-1, 1}) {
    const std::size_t inside = side < 0 ? std::size_t(sites_.box[2]) : 1;
    const std::size_t layer = side < 0 ? 0 : std::size_t(sites_.box[2] + 1);
    const std::size_t from = way == Way::fill ? inside : layer, to = way == Way::fill ? layer : inside;
    for (const std::size_t i : leaving(2, side)) {
      Real* const row = f + i * stride_;
      for (std::size_t n = 0; n < rows; ++n) row[n * sites_.row + to] = row[n * sites_.row + from];
    }
  }
}

// The first axis passes an edge on to the second axis' layer: all axes copy whole layers.
template <class Real>
void Halo<Real>::fill(Real* populations) const {
  along_z(populations, Way::fill);
  along_y(populations, Way::fill);
  along_x(populations, Way::fill);
}

template <class Real>
void Halo<Real>::fold(Real* populations) const {
  along_x(populations, Way::fold);
  along_y(populations, Way::fold);
  along_z(populations, Way::fold);
}

template class Halo<float>;
template class Halo<double>;

}  // namespace polybed::multiscale::lattice
