// What an effect is called and where it acts. A model offers its roles as data; the case file is checked
// against them, and `polybed list`, the schema and the docs are made from them.
#pragma once

#include <string>
#include <vector>

namespace polybed::core {

struct Law {
  std::string name;  ///< as in the case file
  std::string help;  ///< one line: what it is, with its source
};

struct Role {
  std::string name;       ///< key in [effects]
  std::string models;     ///< "tfm", "dem" or "tfm, dem"
  std::string slot;       ///< place in the discrete equation: Exchange, Stress, Pair ...
  std::string help;       ///< one line
  std::string absent;     ///< what the other model does without it, e.g. "reaches the TFM through a table"
  std::vector<Law> laws;  ///< "none" is always allowed and need not be listed
};

}  // namespace polybed::core
