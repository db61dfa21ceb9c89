// What is wrong with a case that keeps every rule, and only shows when its start is made.
#pragma once

#include "core/error.hpp"

namespace polybed::core {

/// Particles that cannot be packed, a column that cannot be cut, a table or a list that does not fit (exit code 2).
class StartError : public CaseError {
 public:
  using CaseError::CaseError;
};

}  // namespace polybed::core
