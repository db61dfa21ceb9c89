// The boxes of a calibration: which are there, and how the others are run.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "core/numerics/ranks.hpp"
#include "multiscale/calibrate/box_result.hpp"

namespace polybed::multiscale {

/// Where the result of a box is kept.
[[nodiscard]] std::filesystem::path file_of(const std::filesystem::path& directory, const core::Scene& scene,
                                            const BoxPoint& point);

/// Boxes that are run, with those finished before, in the order asked for. Collective.
class Boxes {
 public:
  /// \param ranks  that run them; null: one process, or as many at once as the options say
  Boxes(const CalibrateOptions& options, const core::Scene& scene, std::filesystem::path directory,
        std::vector<BoxPoint> points, std::shared_ptr<const core::Ranks> ranks);

  /// s, on one core.
  [[nodiscard]] double expected_left() const;
  [[nodiscard]] std::size_t left() const;
  /// How many cores they are run on.
  [[nodiscard]] int at_once() const { return ranks_ ? ranks_->count() : options_.jobs; }

  /// Runs what is not there. Throws core::NumericsError where boxes fail; finished ones are kept.
  std::vector<BoxResult> run();

 private:
  [[nodiscard]] std::vector<std::string> arguments(const BoxPoint& point) const;
  [[nodiscard]] std::vector<std::size_t> run_as_processes(const std::vector<std::size_t>& todo);
  [[nodiscard]] std::vector<std::size_t> run_here(std::vector<std::size_t> todo);
  void run_one(std::size_t place, const std::shared_ptr<const core::Ranks>& ranks);
  void tell(double begin, double all);
  [[nodiscard]] std::vector<BoxResult> results() const;

  const CalibrateOptions& options_;
  const core::Scene& scene_;
  std::filesystem::path directory_;
  std::vector<BoxPoint> points_;
  std::shared_ptr<const core::Ranks> ranks_;
  std::vector<double> expected_;
  std::vector<bool> done_;
};

}  // namespace polybed::multiscale
