// Kernels compiled once for each vector width, and the width of this run. Closures also include this header.
#pragma once

#include <array>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace polybed::core {

enum class VectorWidth { sse2, avx2, avx512 };  ///< on other processors sse2 means the compiler's default

constexpr std::array<std::string_view, 3> vector_width_names{"sse2", "avx2", "avx512"};

/// Whether this processor supports it.
[[nodiscard]] inline bool at_hand(VectorWidth width) {
#ifdef __x86_64__
  if (width == VectorWidth::avx2) return __builtin_cpu_supports("avx2");
  if (width == VectorWidth::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
#endif
  return width == VectorWidth::sse2;
}

/// The widest supported width, or the one in the environment variable POLYBED_VECTORS; throws std::invalid_argument if
/// that names no supported one.
[[nodiscard]] inline VectorWidth choose_vector_width() {
  const char* wanted = std::getenv("POLYBED_VECTORS");
  std::string names;
  for (std::size_t n = vector_width_names.size(); n-- > 0;) {
    if (!at_hand(VectorWidth(n))) continue;
    if (wanted == nullptr || vector_width_names[n] == wanted) return VectorWidth(n);
    names = std::string(vector_width_names[n]) + (names.empty() ? "" : ", ") + names;
  }
  throw std::invalid_argument("POLYBED_VECTORS is '" + std::string(wanted) + "': this processor has " + names);
}

/// The width of this run.
[[nodiscard]] inline VectorWidth vector_width() {
  static const VectorWidth width = choose_vector_width();
  return width;
}

[[nodiscard]] inline std::string vector_width_name() {
  return std::string(vector_width_names[std::size_t(vector_width())]);
}

template <auto kernel, class Function = decltype(kernel)>
struct InVectors;

/// A kernel, a plain function, with everything that it calls inlined, at each width.
template <auto kernel, class Result, class... Taken>
struct InVectors<kernel, Result (*)(Taken...)> {
#ifdef __x86_64__
  [[gnu::target("avx512f,avx512dq,avx512bw,avx512vl"), gnu::flatten]] static Result avx512(Taken... taken) {
    return kernel(std::forward<Taken>(taken)...);
  }
  [[gnu::target("avx2"), gnu::flatten]] static Result avx2(Taken... taken) {
    return kernel(std::forward<Taken>(taken)...);
  }
#endif
  [[gnu::flatten]] static Result sse2(Taken... taken) { return kernel(std::forward<Taken>(taken)...); }

  Result operator()(Taken... taken) const {
#ifdef __x86_64__
    if (vector_width() == VectorWidth::avx512) return avx512(std::forward<Taken>(taken)...);
    if (vector_width() == VectorWidth::avx2) return avx2(std::forward<Taken>(taken)...);
#endif
    return sse2(std::forward<Taken>(taken)...);
  }
};

/// in_vectors<kernel>(arguments) calls the kernel at the width of this run. The bits do not depend on the width: no
/// product is fused with a sum (-ffp-contract=off), and no sum is reordered.
template <auto kernel>
inline constexpr InVectors<kernel> in_vectors{};

}  // namespace polybed::core
