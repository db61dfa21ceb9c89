// The greatest value of a number over situations, with its place; for uncertain numbers a band.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "relevance/effect_row.hpp"
#include "relevance/situation.hpp"

namespace polybed::relevance {

class Supremum {
 public:
  void add(const Situation& s, double value) { note(s, value, certain_); }
  /// For a formula that is only an estimate: the value lies in a band.
  void add_uncertain(const Situation& s, NumberBand band) {
    note(s, band.most, uncertain_);
    if (!band_ || band.most > band_->most) band_ = band;
  }
  /// Fills value, band, place and zones of a row; a certain value takes precedence.
  void fill(EffectRow& row) const {
    const auto& value = certain_ ? certain_ : uncertain_;
    if (value) {
      row.value = value->first;
      row.where = value->second;
    }
    if (uncertain_ && (!certain_ || uncertain_->first > certain_->first)) row.band = band_;
    row.zones = zones_;
  }

 private:
  using Placed = std::optional<std::pair<double, std::string>>;
  void note(const Situation& s, double value, Placed& greatest) {
    if (!greatest || value > greatest->first) greatest = {value, s.species + ", " + name_of(s.zone)};
    auto& zone = zones_.try_emplace(name_of(s.zone), value).first->second;
    zone = std::max(zone, value);
  }
  Placed certain_, uncertain_;
  std::optional<NumberBand> band_;
  std::map<std::string, double> zones_;
};

}  // namespace polybed::relevance
