// What a word of the program means: a key, a role, a law, or what a run prints.
#pragma once

#include <string>
#include <vector>

#include "core/case/keys.hpp"
#include "core/output/json.hpp"

namespace polybed::app {

/// A word that the program prints beside keys, roles and laws.
struct Term {
  std::string name, kind;  ///< kind: "status", "line of the card", "invariant" ...
  std::string help;        ///< what it means
  std::string todo;        ///< what to choose or to do; may be empty
};

/// All of them, app/terms.cpp.
[[nodiscard]] const std::vector<Term>& terms();

/// A text behind another one, on lines of at most 100 columns; those that follow are indented.
[[nodiscard]] std::string beside(std::string line, std::size_t indent, const std::string& text);

/// A key as polybed schema --json has it.
[[nodiscard]] core::Json json_of_key(const core::Key& key);

}  // namespace polybed::app
