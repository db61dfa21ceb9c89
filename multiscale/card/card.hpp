// The result card: the summary of a case or a run, as one object in run.json and a few lines.
#pragma once

#include <string>
#include <vector>

#include "core/output/json.hpp"
#include "multiscale/card/bed_of_case.hpp"
#include "multiscale/card/bed_of_run.hpp"
#include "multiscale/effects/left_out.hpp"
#include "multiscale/estimate/estimate.hpp"

namespace polybed::multiscale {

struct Card {
  BedOfCase expected;
  BedOfRun seen;
  std::string limited_by;  ///< the limit of most steps; empty: no step yet
  LeftOut left_out;
  std::optional<ForcesMet> met;  ///< neglected; empty: no monitor, or none within the range of its laws
  std::optional<double> taken;   ///< CPU s; empty: it still runs
  TimeBand predicted;
};

/// The members "card" and "drift" of a record.
void write_card(core::Json& json, const core::Scene& scene, const Card& card);

/// The member "expected" of a check, in the words of the card.
void write_expected(core::Json& json, const core::Scene& scene, const BedOfCase& bed);

/// For a case without a run: its predictions.
[[nodiscard]] std::vector<std::string> expectation_lines(const core::Scene& scene, const BedOfCase& bed);

/// For a run at its end.
[[nodiscard]] std::vector<std::string> result_lines(const Card& card);

/// A time mean with its interval, if that is visible in four digits. \param scale  from SI to the unit
[[nodiscard]] std::string mean_text(const measures::TimeMean& mean, double scale, const std::string& unit);

/// A computing time for people.
[[nodiscard]] std::string short_time(double seconds);

/// A predicted time, with its band.
[[nodiscard]] std::string computing_text(const TimeBand& time);

/// A line of a card: its heading and its text.
[[nodiscard]] std::string card_line(const std::string& heading, const std::string& text);

}  // namespace polybed::multiscale
