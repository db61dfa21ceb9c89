#include "core/case/removed.hpp"

namespace polybed::core {

namespace {

struct Removed {
  std::string_view path, word, instead;
};

constexpr Removed removed[] = {
    {"tfm.momentum", "upwind", "(U.grad)U was removed, take \"conservative\", of the same order"},
    {"tfm.momentum", "limited", "(U.grad)U was removed, take \"conservative_limited\", of the same order"},
};

}  // namespace

std::string instead_of_removed(std::string_view path, std::string_view word) {
  for (const Removed& one : removed)
    if (one.path == path && one.word == word) return "; " + std::string(one.instead);
  return "";
}

}  // namespace polybed::core
