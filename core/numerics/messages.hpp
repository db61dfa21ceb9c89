// Exchanges items between ranks with a fixed pattern: destinations and numbers of items.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/numerics/ranks.hpp"

namespace polybed::core {

class Messages {
 public:
  /// Collective. \param to  number of items for each rank, in the order of ranks; empty without ranks
  Messages(std::shared_ptr<const Ranks> ranks, std::vector<int> to);
  ~Messages();
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  /// Number of incoming items, in total and from each rank.
  [[nodiscard]] std::size_t incoming() const { return incoming_; }
  [[nodiscard]] const std::vector<int>& from() const { return from_; }

  /// Starts to send `out` (in the order of ranks) and to receive `in`; both must exist until finish(). Every rank must
  /// make the same call with the same type.
  template <class Item>
  void start(std::span<const Item> out, std::span<Item> in) {
    static_assert(std::is_trivially_copyable_v<Item>);
    start_bytes(reinterpret_cast<const std::byte*>(out.data()), reinterpret_cast<std::byte*>(in.data()), sizeof(Item));
  }
  void finish();

 private:
  struct Requests;
  void start_bytes(const std::byte* out, std::byte* in, std::size_t size);

  std::shared_ptr<const Ranks> ranks_;
  std::vector<int> to_, from_;
  std::size_t incoming_ = 0;
  std::unique_ptr<Requests> requests_;
};

}  // namespace polybed::core
