// The neglected forces in a run, evaluated at its particles with the closures used for the choice.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "closures/vec3.hpp"
#include "core/case/scene.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/json.hpp"
#include "relevance/effect.hpp"

namespace polybed::multiscale {

/// Solids fraction below which a cell is too empty for an effect to matter.
inline constexpr double least_fraction_met = 1e-3;

/// Surroundings of a particle, or of a species' particles in a cell.
struct Encounter {
  std::size_t species = 0;
  closures::Vec3 slip{}, vorticity{};  ///< u_f - v, m/s; curl u_f, 1/s
  std::optional<closures::Vec3>
      spin;                       ///< of a particle, 1/s; unknown for a continuum: it differs by half the vorticity
  std::array<double, 3> place{};  ///< m
  double time = 0;                ///< s
  std::uint64_t weight = 1;       ///< for a cell of a round column, thousandths of a whole cell
};

/// One neglected force, or their sum.
struct Observed {
  std::string effect;
  bool of_all = false;              ///< the sum of all effects
  double bound = 0;                 ///< when it was neglected
  std::uint64_t count = 0;          ///< encounters within the closure's range, by weight, like the next two
  std::uint64_t outside = 0;        ///< outside it: not counted otherwise
  std::uint64_t above = 0;          ///< beyond the tolerance
  double greatest = 0, time = 0;    ///< share of the weight, and when
  std::array<double, 3> place{};    ///< and where
  std::vector<std::uint64_t> bins;  ///< in the logarithm

  void add(double share, const Encounter& met, double tolerance);
  /// 99 of 100 observations are below it, to a twentieth of a decade.
  [[nodiscard]] double percentile() const;
};

/// The sum of the neglected forces that a run met.
struct ForcesMet {
  std::vector<std::string> effects;  ///< those that can be evaluated
  double share;                      ///< of the weight, for 99 of 100 encounters
};

class Neglected {
 public:
  /// \param model  "tfm" or "dem": effects without a law in the model are neglected whatever the case says
  Neglected(const core::Scene& scene, const std::string& model);

  void see(const Encounter& met);
  /// Over all ranks. Collective.
  void gather(const core::Ranks* ranks);

  /// The observations, for a checkpoint, and their restoration. Returns false, and restores nothing, if other forces
  /// are neglected now.
  [[nodiscard]] core::Json past() const;
  [[nodiscard]] bool recall(const core::Json& past);

  /// The forces that can be evaluated, and last their sum.
  [[nodiscard]] const std::vector<Observed>& observed() const { return observed_; }
  [[nodiscard]] const Observed& sum() const { return observed_.back(); }
  /// Effects that need more than a state: accelerations.
  [[nodiscard]] const std::vector<std::string>& not_evaluated() const { return not_evaluated_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  /// Whether 99 of 100 encounters are within the tolerance; greater extremes are only reported. Nothing if all
  /// encounters are outside the closures' range.
  [[nodiscard]] std::optional<bool> kept() const {
    if (sum().count == 0) return std::nullopt;
    return 100 * sum().above <= sum().count;
  }
  [[nodiscard]] std::optional<ForcesMet> met() const;

 private:
  core::Scene scene_;
  double fluid_density_ = 0, viscosity_ = 0, tolerance_;
  relevance::Surfaces surfaces_{};
  std::vector<const relevance::Effect*> effects_;  ///< that can be evaluated
  std::vector<Observed> observed_;                 ///< for these, and last for the sum
  std::vector<std::string> not_evaluated_;
};

/// A table of bound against observed, and the same as members "promise" of an open object.
[[nodiscard]] std::string neglected_table(const Neglected& neglected);
void write_neglected(core::Json& json, const Neglected& neglected);

}  // namespace polybed::multiscale
