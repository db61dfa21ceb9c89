// Applies values from the command line to a case: --set inlet.superficial_velocity="37 mm/s", species.fine.diameter=1.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "core/case/values.hpp"

namespace polybed::core {

/// Puts one "KEY=VALUE" into the tree in place of the file's value. Reports a problem if the key does not exist.
/// \param given  KEY by its path; an entry of an array of tables by its name or its number from 0.
///               VALUE as TOML if it reads as such, else a text, so that units need no inner quotes.
void apply_override(toml::table& root, const std::string& given, CaseValues& values);

}  // namespace polybed::core
