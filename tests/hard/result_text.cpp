#include "hard/result_text.hpp"

#include "core/error.hpp"
#include "core/output/json.hpp"
#include "core/output/json_value.hpp"

namespace polybed::hard {

std::string text_of(const Result& result) {
  core::Json json;
  json.begin_object().member("outcome", name_of(result.outcome));
  json.member("id", result.worst.id).member("value", result.worst.value).member("limit", result.worst.limit);
  json.member("least_step", result.least_step).member("cpu", result.cpu);
  json.member("steps", result.work.steps).member("rejected", result.work.rejected_steps);
  json.member("cause", result.cause).member("broken", result.broken).member("reported", result.reported).end_object();
  return json.text();
}

Result result_of(const std::string& text) {
  const core::JsonValue json = core::parse_json(text);
  Result result;
  const std::string outcome = json.of("outcome").text();
  for (const Outcome known : {Outcome::pass, Outcome::degraded, Outcome::refused, Outcome::fail})
    if (name_of(known) == outcome) result.outcome = known;
  if (name_of(result.outcome) != outcome) throw core::FileError("no outcome: " + outcome);
  result.worst = {json.of("id").text(), json.of("value").number(), json.of("limit").number()};
  result.least_step = json.of("least_step").number();
  result.cpu = json.of("cpu").number();
  result.work.steps = std::uint64_t(json.of("steps").number());
  result.work.rejected_steps = std::uint64_t(json.of("rejected").number());
  result.cause = json.of("cause").text();
  result.broken = json.of("broken").text();
  result.reported = json.of("reported").text();
  return result;
}

Result result_of(const ChildEnd& end) {
  if (end.answered) return result_of(end.text);
  Result result;
  result.outcome = Outcome::fail;
  result.worst = {"V16 honest stop", 1, 0};
  result.broken = result.worst.id;
  result.cause = end.text;
  return result;
}

}  // namespace polybed::hard
