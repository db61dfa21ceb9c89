// The forces that a run leaves out, evaluated where its particles are by the closures that the choice was made with.
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

/// Solids fraction below which a cell holds nothing that an effect could matter to.
inline constexpr double least_fraction_met = 1e-3;

/// What a particle meets, or the particles of a species in a cell.
struct Encounter {
  std::size_t species = 0;
  closures::Vec3 slip{}, vorticity{};  ///< u_f - v, m/s; curl u_f, 1/s
  std::optional<closures::Vec3>
      spin;                       ///< of a particle, 1/s; of a continuum not known: it differs by half the vorticity
  std::array<double, 3> place{};  ///< m
  double time = 0;                ///< s
  std::uint64_t weight = 1;       ///< of a cell of a round column the thousandths of a whole one that it is
};

/// One neglected force, or their sum.
struct Observed {
  std::string effect;
  bool of_all = false;              ///< the sum of all effects
  double bound = 0;                 ///< that it was left out with
  std::uint64_t count = 0;          ///< encounters within the closure's range, by weight as the next two
  std::uint64_t outside = 0;        ///< beyond it: not counted otherwise
  std::uint64_t above = 0;          ///< beyond the tolerance
  double greatest = 0, time = 0;    ///< share of the weight, and when
  std::array<double, 3> place{};    ///< and where
  std::vector<std::uint64_t> bins;  ///< of the logarithm

  void add(double share, const Encounter& met, double tolerance);
  /// Of all that was seen: 99 of 100 are below, to a twentieth of a decade.
  [[nodiscard]] double percentile() const;
};

class Neglected {
 public:
  /// \param model  "tfm" or "dem": what a model has no law of is left out whatever the case says
  Neglected(const core::Scene& scene, const std::string& model);

  void see(const Encounter& met);
  /// Of all ranks. Collective.
  void gather(const core::Ranks* ranks);

  /// What was seen, for a checkpoint, and the same taken up again. False, and nothing is taken up, if other forces are
  /// left out now.
  [[nodiscard]] core::Json past() const;
  [[nodiscard]] bool recall(const core::Json& past);

  /// The forces that can be evaluated, and last their sum.
  [[nodiscard]] const std::vector<Observed>& observed() const { return observed_; }
  [[nodiscard]] const Observed& sum() const { return observed_.back(); }
  /// What cannot, since it needs more than a state: accelerations.
  [[nodiscard]] const std::vector<std::string>& not_evaluated() const { return not_evaluated_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  /// Whether 99 of 100 encounters keep the promise; greater extremes are told, not held against it. Nothing where all
  /// that was met lies beyond the closures' range.
  [[nodiscard]] std::optional<bool> kept() const {
    if (sum().count == 0) return std::nullopt;
    return 100 * sum().above <= sum().count;
  }

 private:
  core::Scene scene_;
  double fluid_density_ = 0, viscosity_ = 0, tolerance_;
  relevance::Surfaces surfaces_{};
  std::vector<const relevance::Effect*> effects_;  ///< that can be evaluated
  std::vector<Observed> observed_;                 ///< of these, and last the sum
  std::vector<std::string> not_evaluated_;
};

/// A table of bound against observed, and the same as members "promise" of an open object.
[[nodiscard]] std::string neglected_table(const Neglected& neglected);
void write_neglected(core::Json& json, const Neglected& neglected);

}  // namespace polybed::multiscale
