// The result of a trial as text, by which a child process tells its parent.
#pragma once

#include <string>

#include "hard/child.hpp"
#include "hard/hard_case.hpp"

namespace polybed::hard {

[[nodiscard]] std::string text_of(const Result& result);
/// Throws core::FileError for any other text.
[[nodiscard]] Result result_of(const std::string& text);
/// What a child said; one that gave no answer has failed in V16.
[[nodiscard]] Result result_of(const ChildEnd& end);

}  // namespace polybed::hard
