// What an effect is called and where it acts. A model offers its roles as data; the case file is checked
// against them, and `polybed list`, the schema and the docs are made from them.
#pragma once

#include <string>
#include <vector>

namespace polybed::core {

struct Law {
  std::string name;         ///< as in the case file
  std::string help;         ///< what it is and where it holds, in plain words; at most 78 columns
  std::string source = {};  ///< equation and reference, for `polybed explain`
  std::string note = {};    ///< what several laws of a role share; `polybed list` prints it once
};

/// A law to take, and in which bed.
struct Advice {
  std::string law, bed;
};

struct Role {
  std::string name;                 ///< key in [effects]
  std::string models;               ///< "tfm", "dem" or "tfm, dem"
  std::string slot;                 ///< place in the discrete equation: Exchange, Stress, Pair ...
  std::string help;                 ///< one line
  std::string absent;               ///< what the other model does without it, e.g. "particles have contacts instead"
  std::vector<Law> laws;            ///< "none" is always allowed and need not be listed
  std::vector<Advice> advice = {};  ///< the best first; empty: what the laws are says it
};

}  // namespace polybed::core
