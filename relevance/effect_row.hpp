// One row of the table of effects: an effect, its deciding number, and the decision.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>

namespace polybed::relevance {

/// A range of an uncertain number.
struct NumberBand {
  double least = 0, most = 0;
};

/// Replaces the number in words if no number decides.
inline constexpr const char* no_number = "-";

/// Why a row of the two-fluid model is off without a fluid.
inline constexpr const char* without_a_fluid = "no fluid: particles touch instead";

/// Two digits, or all before the point, without a power of ten below a million: "0.14", "7", "120".
[[nodiscard]] std::string two_digits(double value);

/// A share in per cent with two digits, e.g. "0.14 %", "120 %"; a negligible one is "less than 0.001 %".
[[nodiscard]] std::string percent(double share);

struct EffectRow {
  /// Undecided: the number is too uncertain to decide.
  enum class State { on, off, undecided };
  enum class Kind {
    role,       ///< of [effects]
    condition,  ///< decided by other keys, or always on
    unmodelled  ///< not modelled
  };
  std::string effect;               ///< role, or another name
  std::string model;                ///< the chosen law, or the one that was weighed
  std::string models = "tfm, dem";  ///< where it acts
  std::string number;               ///< the deciding number, as a formula
  std::string phrase;               ///< the same in plain words, with {} for the value: "2 % of" or "30 times"
  std::optional<double> value;      ///< its greatest; least where `below`
  std::optional<double> threshold;
  bool below = false;                   ///< on where the value is below the threshold
  std::optional<NumberBand> band;       ///< where the number is uncertain
  std::optional<double> up_to;          ///< for sheared particles: on the scales of a run's cells and of impacts
  std::string where;                    ///< species and zone of the value
  std::map<std::string, double> zones;  ///< the value of each zone
  State state = State::off;
  Kind kind = Kind::role;
  bool summed = false;              ///< a force on particles that counts if it is neglected
  std::optional<double> share_off;  ///< for others: share of drag or weight that is missing if it is off
  bool on_particles = false;        ///< acts on particles: a model without a law for it neglects it
  bool of_acceleration = false;     ///< vanishes in the mean of a steady flow
  bool choice = false;              ///< an improvement, but nothing is missing without it
  std::optional<double> neglected;  ///< bound on the error if neglected, as decided
  std::optional<double> bound;      ///< the same for any decision; empty if unknown
  std::string reason;
  std::string remark;     ///< added to the reason for any decision
  std::string not_built;  ///< why a run cannot include it; empty: it can

  [[nodiscard]] bool has_number() const { return number != no_number; }
  /// The greatest possible number. \pre it has a value
  [[nodiscard]] double upper_end() const { return std::max(*value, band ? band->most : *value); }
};

/// A row before weighing.
inline EffectRow effect_row(const char* effect, const char* model, const char* number,
                            EffectRow::Kind kind = EffectRow::Kind::role) {
  EffectRow row;
  row.effect = effect;
  row.model = model;
  row.number = number;
  row.kind = kind;
  return row;
}

}  // namespace polybed::relevance
