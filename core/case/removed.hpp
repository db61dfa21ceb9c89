// Names from earlier versions and from other programs that this version does not read.
#pragma once

#include <string>
#include <string_view>

namespace polybed::core {

/// "; " and what to do instead, for a removed key or word of a key; else empty.
/// \param path  e.g. "tfm.momentum"  \param word  empty: the key itself
[[nodiscard]] std::string instead_of_removed(std::string_view path, std::string_view word = "");

}  // namespace polybed::core
