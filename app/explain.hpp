// Meaning of a word in the program: a key, a role, a law, or a word in its output.
#pragma once

#include <string>
#include <vector>

#include "core/case/keys.hpp"
#include "core/output/json.hpp"

namespace polybed::app {

/// A word in the program's output, other than keys, roles and laws.
struct Term {
  std::string name, kind;  ///< kind: "status", "line of the card", "invariant" ...
  std::string help;        ///< its meaning
  std::string todo;        ///< what to choose or to do; can be empty
};

/// All of them, app/terms.cpp.
[[nodiscard]] const std::vector<Term>& terms();

/// Appends a text to a line, wrapped at 100 columns; further lines are indented.
[[nodiscard]] std::string beside(std::string line, std::size_t indent, const std::string& text);

/// A key as in polybed schema --json.
[[nodiscard]] core::Json json_of_key(const core::Key& key);

}  // namespace polybed::app
