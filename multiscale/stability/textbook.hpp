// What textbooks do in the place of the product's treatments. Only test programs have it: the program that links
// tests/naive answers here, any other gets nothing.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "multiscale/stability/hard_case.hpp"

namespace polybed::stability {

/// Textbook treatments by name; unknown names throw std::invalid_argument.
class Textbook {
 public:
  virtual ~Textbook() = default;
  /// A run of a continuum scene; null where the case itself is treated; `start` as in Trial::begin.
  [[nodiscard]] virtual std::unique_ptr<Run> run(const std::string& name, const core::Scene& scene,
                                                 core::Timers& timers,
                                                 const std::function<void(tfm::Model&)>& start) const = 0;
};

/// Those of this program, or null.
[[nodiscard]] const Textbook* textbook();

}  // namespace polybed::stability
