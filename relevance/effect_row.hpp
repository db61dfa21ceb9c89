// One line of the table of reasons: an effect, the number that decides it, and what was decided.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>

namespace polybed::relevance {

/// A band: the number itself is uncertain there.
struct NumberBand {
  double least = 0, most = 0;
};

/// In place of a number in words, where none decides.
inline constexpr const char* no_number = "-";

/// Why a row of the two-fluid model is off where nothing flows.
inline constexpr const char* without_a_fluid = "no fluid: particles touch instead";

/// Two digits, or all before the point, and no power of ten below a million: "0.14", "7", "120".
[[nodiscard]] std::string two_digits(double value);

/// A share in per cent with two digits, e.g. "0.14 %", "120 %"; what nobody counts is "less than 0.001 %".
[[nodiscard]] std::string percent(double share);

struct EffectRow {
  /// Undecided: the number is too uncertain to decide.
  enum class State { on, off, undecided };
  enum class Kind {
    role,       ///< of [effects]
    condition,  ///< decided by other keys, or always on
    unmodelled  ///< nothing of it is in the product
  };
  std::string effect;               ///< role, or what it is called
  std::string model;                ///< the law chosen; or the one that was weighed
  std::string models = "tfm, dem";  ///< where it acts
  std::string number;               ///< what decides, as a formula
  std::string phrase;               ///< the same in plain words, with {} for the value: "2 % of" or "30 times"
  std::optional<double> value;      ///< its greatest; least where `below`
  std::optional<double> threshold;
  bool below = false;                   ///< on where the value is below the threshold
  std::optional<NumberBand> band;       ///< where the number is uncertain
  std::optional<double> up_to;          ///< of sheared particles: on the scales of a run's cells and of impacts
  std::string where;                    ///< species and zone of the value
  std::map<std::string, double> zones;  ///< the value of each zone
  State state = State::off;
  Kind kind = Kind::role;
  bool summed = false;              ///< a force on particles that counts in what is left out
  std::optional<double> share_off;  ///< of what is no force: part of drag or weight that is missing where it is off
  bool on_particles = false;        ///< acts on particles: a model that has no law of it leaves it out
  bool of_acceleration = false;     ///< vanishes in the mean of what is steady
  bool choice = false;              ///< better with it, but nothing is missing without
  std::optional<double> neglected;  ///< bound on what leaving it out neglects, in the table as decided
  std::optional<double> bound;      ///< the same whatever is decided; empty where it is not known
  std::string reason;
  std::string remark;     ///< added to the reason, whatever is decided
  std::string not_built;  ///< why a run cannot have it; empty: it can

  [[nodiscard]] bool has_number() const { return number != no_number; }
  /// The greatest that the number may be. \pre it has a value
  [[nodiscard]] double upper_end() const { return std::max(*value, band ? band->most : *value); }
};

/// A row that is not yet weighed.
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
