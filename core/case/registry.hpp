// The names of effects and the models they act in. A model lists its roles as data; the reader checks the case file
// against them, and `polybed list`, the schema and the docs are generated from them.
#pragma once

#include <string>
#include <vector>

namespace polybed::core {

struct Law {
  std::string name;         ///< as in the case file
  std::string help;         ///< description and range of validity, in plain words; at most 78 columns
  std::string source = {};  ///< equation and reference, for `polybed explain`
  std::string note = {};    ///< text common to several laws of a role; `polybed list` prints it once
};

/// A recommended law, and the bed that it suits.
struct Advice {
  std::string law, bed;
};

struct Role {
  std::string name;                 ///< key in [effects]
  std::string models;               ///< "tfm", "dem" or "tfm, dem"
  std::string slot;                 ///< place in the discrete equation: Exchange, Stress, Pair ...
  std::string help;                 ///< one line
  std::string absent;               ///< replacement in the other model, e.g. "particles have contacts instead"
  std::vector<Law> laws;            ///< "none" is always allowed and need not be listed
  std::vector<Advice> advice = {};  ///< best first; empty: the properties of the laws decide
};

}  // namespace polybed::core
