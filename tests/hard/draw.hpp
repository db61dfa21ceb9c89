// Scenes drawn from the declared envelope: parameters by name, and the case that they make.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace polybed::hard {

/// One number of a drawn scene.
struct Parameter {
  std::string name;
  double value = 0, standard = 0;  ///< SI; the standard is what a minimal case has
  bool whole = false;              ///< a number of things or of a choice: nothing between two of them
  bool operator==(const Parameter&) const = default;
};

/// A scene as its parameters.
struct Draw {
  std::vector<Parameter> parameters;

  [[nodiscard]] double of(const std::string& name) const;
  [[nodiscard]] bool is_particles() const { return of("model") >= 3; }
  /// How many parameters are not as in a minimal case.
  [[nodiscard]] int size() const;
  bool operator==(const Draw&) const = default;
};

/// Number n of the sequence of a seed: diameters 1e-6 to 0.1 m, densities 1 to 2e4 kg/m3, viscosity 1e-6 to 1e3 Pa s,
/// velocity 0 to 100 u_mf, 1 to 6 species, by either model, each integrator, with and without an effect; ends of 1 ms
/// to 4 s, times of output and checkpoints, jumps of the inlet. The same on every machine, whatever was drawn before.
[[nodiscard]] Draw draw_of(std::uint64_t seed, std::uint64_t n);

/// The case file of a draw.
[[nodiscard]] std::string case_text(const Draw& draw);

}  // namespace polybed::hard
