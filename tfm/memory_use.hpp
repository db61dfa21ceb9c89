// What a model holds in memory, by what it is for.
#pragma once

#include "tfm/fields.hpp"

namespace polybed::tfm {

/// Memory of the working fields, bytes.
[[nodiscard]] std::size_t bytes_of(const Fields& fields);

}  // namespace polybed::tfm
