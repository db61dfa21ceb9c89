#include "hard/result_text.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/output/json.hpp"

namespace polybed::hard {

std::string text_of(const Result& result) {
  return core::json_text({{"outcome", name_of(result.outcome)},
                          {"id", result.worst.id},
                          {"value", result.worst.value},
                          {"limit", result.worst.limit},
                          {"least_step", result.least_step},
                          {"cpu", result.cpu},
                          {"steps", result.work.steps},
                          {"rejected", result.work.rejected_steps},
                          {"cause", result.cause},
                          {"broken", result.broken},
                          {"reported", result.reported}});
}

Result result_of(const std::string& text) {
  const core::Json json = core::parse_json(text);
  const auto number = [&](const char* name) { return core::number_of(core::member_of(json, name)); };
  const auto text_in = [&](const char* name) { return core::text_of(core::member_of(json, name)); };
  Result result;
  const std::string outcome = text_in("outcome");
  for (const Outcome known : {Outcome::pass, Outcome::degraded, Outcome::refused, Outcome::fail})
    if (name_of(known) == outcome) result.outcome = known;
  if (name_of(result.outcome) != outcome) throw core::FileError("no outcome: " + outcome);
  result.worst = {text_in("id"), number("value"), number("limit")};
  result.least_step = number("least_step");
  result.cpu = number("cpu");
  result.work.steps = std::uint64_t(number("steps"));
  result.work.rejected_steps = std::uint64_t(number("rejected"));
  result.cause = text_in("cause");
  result.broken = text_in("broken");
  result.reported = text_in("reported");
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
