#include "lbm/halo.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "lbm/lattice.hpp"

namespace polybed::lbm {

namespace {

constexpr std::size_t crossing = 5;  ///< directions through a face

/// Those that leave through the lower (-1) or the upper (1) face along an axis.
constexpr std::array<std::size_t, crossing> leaving(std::size_t axis, int side) {
  std::array<std::size_t, crossing> found{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < directions; ++i)
    if (ways[i][axis] == side) found[n++] = i;
  return found;
}

}  // namespace

template <class Real>
Halo<Real>::Halo(const Sites& sites, std::size_t stride, std::shared_ptr<const core::Ranks> ranks)
    : sites_(sites), stride_(stride), plane_(std::size_t(sites.own[1] + 2) * sites.row), ranks_(std::move(ranks)) {
  if (!ranks_) return;
  const int count = ranks_->count(), left = (ranks_->rank() + count - 1) % count, right = (ranks_->rank() + 1) % count;
  const int block = int(crossing * plane_);
  std::vector<int> to(std::size_t(count), 0);
  to[std::size_t(left)] += block;
  to[std::size_t(right)] += block;
  messages_ = std::make_unique<core::Messages>(ranks_, to);
  out_.resize(2 * crossing * plane_);
  in_.resize(2 * crossing * plane_);
  // To one neighbour goes first what is for its upper side. Of two ranks each is the other's neighbour on both sides.
  const std::size_t second = crossing * plane_;
  to_left_ = left <= right ? 0 : second;
  to_right_ = second - to_left_;
  from_right_ = right <= left ? 0 : second;
  from_left_ = second - from_right_;
}

template <class Real>
void Halo<Real>::pack(const Real* populations, int side, int layer, Real* buffer) const {
  for (const std::size_t i : leaving(0, side))
    buffer = std::copy_n(populations + i * stride_ + std::size_t(layer) * plane_, plane_, buffer);
}

template <class Real>
void Halo<Real>::unpack(Real* populations, int side, int layer, const Real* buffer) const {
  for (const std::size_t i : leaving(0, side)) {
    std::copy_n(buffer, plane_, populations + i * stride_ + std::size_t(layer) * plane_);
    buffer += plane_;
  }
}

template <class Real>
void Halo<Real>::along_x(Real* f, Way way) {
  const int last = sites_.own[0];
  const bool fills = way == Way::fill;
  if (ranks_) {
    // What leaves a slab downwards lies above it while it fills, in the layer below it while it folds.
    pack(f, -1, fills ? last : 0, out_.data() + (fills ? to_right_ : to_left_));
    pack(f, 1, fills ? 1 : last + 1, out_.data() + (fills ? to_left_ : to_right_));
    messages_->start(std::span<const Real>(out_), std::span<Real>(in_));
    messages_->finish();
    unpack(f, -1, fills ? 0 : last, in_.data() + (fills ? from_left_ : from_right_));
    unpack(f, 1, fills ? last + 1 : 1, in_.data() + (fills ? from_right_ : from_left_));
    return;
  }
  for (const int side : {-1, 1}) {
    const int inside = side < 0 ? last : 1, layer = side < 0 ? 0 : last + 1;
    for (const std::size_t i : leaving(0, side)) {
      Real* const a = f + i * stride_ + std::size_t(inside) * plane_;
      Real* const b = f + i * stride_ + std::size_t(layer) * plane_;
      fills ? std::copy_n(a, plane_, b) : std::copy_n(b, plane_, a);
    }
  }
}

template <class Real>
void Halo<Real>::along_y(Real* f, Way way) const {
  for (const int side : {-1, 1}) {
    const int inside = side < 0 ? sites_.own[1] : 1, layer = side < 0 ? 0 : sites_.own[1] + 1;
    for (const std::size_t i : leaving(1, side))
      for (int x = 0; x < sites_.own[0] + 2; ++x) {
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
    const std::size_t inside = side < 0 ? std::size_t(sites_.own[2]) : 1;
    const std::size_t layer = side < 0 ? 0 : std::size_t(sites_.own[2] + 1);
    const std::size_t from = way == Way::fill ? inside : layer, to = way == Way::fill ? layer : inside;
    for (const std::size_t i : leaving(2, side)) {
      Real* const row = f + i * stride_;
      for (std::size_t n = 0; n < rows; ++n) row[n * sites_.row + to] = row[n * sites_.row + from];
    }
  }
}

// An edge is passed on by the first axis to the layer of the second: all axes take whole layers.
template <class Real>
void Halo<Real>::fill(Real* populations) {
  along_z(populations, Way::fill);
  along_y(populations, Way::fill);
  along_x(populations, Way::fill);
}

template <class Real>
void Halo<Real>::fold(Real* populations) {
  along_x(populations, Way::fold);
  along_y(populations, Way::fold);
  along_z(populations, Way::fold);
}

template class Halo<float>;
template class Halo<double>;

}  // namespace polybed::lbm
