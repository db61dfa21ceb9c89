// Numbers of each rank that are put together in one go, however many parts of the program have some: ranks wait for
// each other once, not once for each number.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace polybed::core {

class Ranks;

/// Whoever has numbers names their places, over() leaves there what all ranks have together. The places stay until
/// then, and every rank names the same ones in the same order.
class Reduction {
 public:
  void sum(std::span<double> values) { sums_.push_back(values); }
  void sum(std::span<std::int64_t> values) { counts_.push_back(values); }
  void greatest(double& value) { greatest_.emplace_back(&value, 1); }

  /// Collective: one call for the sums, one for sums of whole numbers and one for the greatest values, if there are
  /// any.
  void over(const Ranks* ranks) const;

 private:
  std::vector<std::span<double>> sums_, greatest_;
  std::vector<std::span<std::int64_t>> counts_;
};

}  // namespace polybed::core
