// Combines numbers from several parts of the program over the ranks in one go: ranks wait for each other once, not once
// for each number.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace polybed::core {

class Ranks;

/// Parts of the program register the addresses of their numbers, and over() replaces the numbers by the result over all
/// ranks. The addresses stay valid until then, and every rank registers the same ones in the same order.
class Reduction {
 public:
  void sum(std::span<double> values) { sums_.push_back(values); }
  void sum(std::span<std::int64_t> values) { counts_.push_back(values); }
  void greatest(double& value) { greatest_.emplace_back(&value, 1); }

  /// Collective: at most one call each for sums, sums of integers and greatest values.
  void over(const Ranks* ranks) const;

 private:
  std::vector<std::span<double>> sums_, greatest_;
  std::vector<std::span<std::int64_t>> counts_;
};

}  // namespace polybed::core
