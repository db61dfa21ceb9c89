// The steps of fields.h5 or particles.h5 as a run has stored them.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/output/steps.hpp"

namespace polybed::core {

/// A series of steps, counted from 0.
class StoredSteps {
 public:
  StoredSteps(std::filesystem::path run_directory, std::string name)
      : directory_(std::move(run_directory)),
        name_(std::move(name)),
        index_(directory_ / (name_ + ".h5"), {"polybed " + name_, 1}) {}

  [[nodiscard]] const OutputFile& index() const { return index_; }
  [[nodiscard]] std::vector<double> times() const { return index_.read("time_s").values; }
  [[nodiscard]] OutputFile open(std::size_t step) const {
    return {step_path(directory_, name_, step), {"polybed " + name_ + " step", 1}};
  }

 private:
  std::filesystem::path directory_;
  std::string name_;
  OutputFile index_;
};

struct FieldReader : StoredSteps {
  explicit FieldReader(const std::filesystem::path& run_directory) : StoredSteps(run_directory, "fields") {}
  [[nodiscard]] std::vector<std::string> names(std::size_t step) const { return open(step).names("step"); }
  [[nodiscard]] DataSet field(std::size_t step, const std::string& name) const {
    return open(step).read("step/" + name);
  }
};

/// Particles that own their numbers.
struct ParticleStep {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> species;
  std::vector<double> radius;
  std::vector<std::array<double, 3>> position, velocity, spin;
};

struct ParticleReader : StoredSteps {
  explicit ParticleReader(const std::filesystem::path& run_directory) : StoredSteps(run_directory, "particles") {}
  [[nodiscard]] ParticleStep step(std::size_t number) const {
    const OutputFile file = open(number);
    const auto vectors = [&](const std::string& name) {
      const std::vector<double> all = file.read("step/" + name).values;
      std::vector<std::array<double, 3>> found;
      for (std::size_t i = 0; i < all.size(); i += 3) found.push_back({all[i], all[i + 1], all[i + 2]});
      return found;
    };
    const std::vector<std::int64_t> species = file.read_integers("step/species");
    return {file.read_integers("step/id"),
            {species.begin(), species.end()},
            file.read("step/radius").values,
            vectors("position"),
            vectors("velocity"),
            vectors("spin")};
  }
};

}  // namespace polybed::core
