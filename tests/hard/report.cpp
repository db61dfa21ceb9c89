#include "hard/report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/version.hpp"

namespace polybed::hard {

namespace {

/// The name of an invariant in words: of "V2 phi below 0" what follows the number.
std::string invariant_words(const std::string& id) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> words{{{"rejected", "rejected steps"},
                                                                                {"step", "shortest step"},
                                                                                {"stuck", "steps without progress"},
                                                                                {"code", "exit code"},
                                                                                {"phi", "solids fraction"}}};
  const bool numbered = id.size() > 1 && id[0] == 'V' && std::isdigit(id[1]) != 0;
  std::string text = numbered ? id.substr(std::min(id.find(' '), id.size() - 1) + 1) : id;
  for (const auto& [name, meaning] : words)
    if (text == name || (name == "phi" && text.starts_with("phi "))) text.replace(0, name.size(), meaning);
  if (text.starts_with("f ")) text.replace(0, 1, "drag");
  return text;
}

std::string limit_share_text(const Measured& m) {
  const double share = 100 * m.share();
  if (m.share() >= 1e290) return "beyond a limit of 0";
  return (share < 9.5 ? fmt::format("{:.1g}", share) : fmt::format("{:.0f}", share)) + " % of its limit";
}

/// One line of the table on the screen: treatment, outcome, the furthest invariant over its limit, least step, cost.
std::string cell_text(const Cell& cell) {
  const Result& r = cell.result;
  const bool product = cell.treatment.naive.empty();
  const std::string name = product ? cell.treatment.name() : "textbook: " + cell.treatment.naive;
  std::string text = fmt::format("    {:<32} {:<8}", name, name_of(r.outcome));
  if (!r.worst.id.empty()) text += fmt::format("  {}: {}", invariant_words(r.worst.id), limit_share_text(r.worst));
  if (product && r.least_step > 0) text += fmt::format("; step {:.1g} ms", 1e3 * r.least_step);
  if (product && cell.cost > 0) text += fmt::format("; time x {:.1f}", cell.cost);
  return text + (cell.as_expected() ? "" : "  <-- expected " + cell.expected);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : c == '\n' ? " " : std::string(1, c);
  return out + "\"";
}

/// A cell of a Markdown table.
std::string plain(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '|', '/');
  return text;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(now));
}

core::Json json_of(const Cell& cell) {
  const Result& r = cell.result;
  const bool product = cell.treatment.naive.empty();
  return {{"case", cell.one.id},
          {"title", cell.one.title},
          {"scheme", product ? cell.treatment.name() : "textbook"},
          {"naive", product ? core::Json() : core::Json(cell.treatment.naive)},
          {"outcome", name_of(r.outcome)},
          {"broken", r.broken},
          {"expected", cell.expected},
          {"as_expected", cell.as_expected()},
          {"worst", {{"id", r.worst.id}, {"value", r.worst.value}, {"limit", r.worst.limit}}},
          {"dt_min", r.least_step},
          {"steps", r.work.steps},
          {"rejected_steps", r.work.rejected_steps},
          {"cpu_s", r.cpu},
          {"cost", cell.cost},
          {"cause", r.cause},
          {"reported", r.reported}};
}

std::string stability_text(std::span<const Cell> cells, const std::string& suite) {
  core::Json all = core::Json::array();
  for (const Cell& cell : cells) all.push_back(json_of(cell));
  return core::json_text({{"filetype", "polybed stability"},
                          {"version", 1},
                          {"git_commit", core::git_commit()},
                          {"suite", suite},
                          {"date", today()},
                          {"cells", all}}) +
         "\n";
}

std::string csv_text(std::span<const Cell> cells) {
  std::string text =
      "case,treatment,outcome,broken,expected,worst,value,limit,dt_min,steps,rejected,cpu_s,cost,cause,reported\n";
  for (const Cell& cell : cells) {
    const Result& r = cell.result;
    text += fmt::format("{},{},{},{},{},{},{:.3g},{:.3g},{:.3g},{},{},{:.2f},{:.2f},{},{}\n", cell.one.id,
                        cell.treatment.name(), name_of(r.outcome), quoted(r.broken), quoted(cell.expected),
                        quoted(r.worst.id), r.worst.value, r.worst.limit, r.least_step, r.work.steps,
                        r.work.rejected_steps, r.cpu, cell.cost, quoted(r.cause), quoted(r.reported));
  }
  return text;
}

std::string outcomes_text(std::span<const Cell> cells) {
  std::string text = "case,treatment,outcome,broken\n";
  for (const Cell& cell : cells)
    text += fmt::format("{},{},{},{}\n", cell.one.id, cell.treatment.name(), name_of(cell.result.outcome),
                        cell.result.broken);
  return text;
}

std::string product_row(const Cell& cell) {
  const Result& r = cell.result;
  const bool nothing_allowed = r.worst.limit <= 0 && r.worst.value > 0;
  return fmt::format("| {} | {} | {} | {} | {} | {:.2g} | {} | {} | {} | {:.2f} | {} |\n", cell.one.id, cell.one.title,
                     cell.treatment.name(), name_of(r.outcome), plain(r.worst.id), r.worst.value,
                     nothing_allowed ? "nothing allowed" : fmt::format("{:.2g}", r.worst.share()),
                     r.least_step > 0 ? fmt::format("{:.2g} s", r.least_step) : "-",
                     r.work.steps > 0 ? fmt::format("{} ({})", r.work.steps, r.work.rejected_steps) : "-", r.cpu,
                     cell.cost > 0 ? fmt::format("{:.2g}", cell.cost) : "-");
}

std::string textbook_row(const Cell& cell) {
  const Measured& worst = cell.result.worst;
  const std::string value = worst.value >= 1e299 ? "not a number" : fmt::format("{:.2g}", worst.value);
  return fmt::format("| {} | `{}` | {} | {} |\n", cell.one.id, cell.treatment.naive, name_of(cell.result.outcome),
                     plain(cell.result.cause.empty() ? fmt::format("{}: {}, limit {:.2g}", worst.id, value, worst.limit)
                                                     : cell.result.cause));
}

std::string markdown(std::span<const Cell> cells, const std::string& suite) {
  double cpu = 0;
  std::string product, textbooks, reported;
  for (const Cell& cell : cells) {
    cpu += cell.result.cpu;
    (cell.treatment.naive.empty() ? product : textbooks) +=
        cell.treatment.naive.empty() ? product_row(cell) : textbook_row(cell);
    if (!cell.result.reported.empty())
      reported += fmt::format("- {}, {}: {}\n", cell.one.id, cell.treatment.name(), cell.result.reported);
  }
  std::string text = fmt::format("Suite {}, {}, commit {}, {:.0f} CPU s in all. {}\n\n", suite, today(),
                                 core::git_commit().substr(0, 10), cpu, summary(cells));
  text +=
      "| case | set-up | scheme | outcome | furthest invariant | value | of its limit | least step | steps "
      "(rejected) | CPU s | over the cheapest that passes |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n" +
      product;
  if (!textbooks.empty())
    text += "\n| case | textbook treatment | outcome | how it fails |\n| --- | --- | --- | --- |\n" + textbooks;
  if (!reported.empty()) text += "\nReported beside:\n\n" + reported;
  return text;
}

}  // namespace

std::string table_heading() {
  return "each stress test (its name in --only) with every scheme, integrator/convection; the check that is\n"
         "nearest to its limit; the shortest step; CPU time over that of the cheapest scheme that passes";
}

std::string table_lines(std::span<const Cell> cells) {
  std::string text = fmt::format("{} ({})", cells[0].one.title, cells[0].one.id);
  for (const Cell& cell : cells) text += "\n" + cell_text(cell);
  return text;
}

std::vector<std::string> differences(std::span<const Cell> cells) {
  std::vector<std::string> lines;
  for (const Cell& cell : cells) {
    const std::string where = cell.one.id + ", " + cell.treatment.name() + ": ";
    const Measured& worst = cell.result.worst;
    if (!cell.as_expected())
      lines.push_back(
          where + cell.found() + "; expected " + (cell.expected.empty() ? "nothing" : cell.expected) +
          fmt::format(" ({} = {:.3g}, limit {:.3g}) {}", worst.id, worst.value, worst.limit, cell.result.cause));
    if (!cell.proves_hardness()) lines.push_back(where + "the textbook treatment passes: the case is not hard");
  }
  return lines;
}

std::string meaning_of_outcomes() {
  return "PASS: every check within its limit; DEGRADED: within ten times; REFUSED: ended with a reason; FAIL: neither";
}

std::string summary(std::span<const Cell> cells) {
  const auto counts = [&](bool naive) {
    std::string text;
    for (const Outcome outcome : {Outcome::pass, Outcome::degraded, Outcome::refused, Outcome::fail})
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                          std::count_if(cells.begin(), cells.end(),
                                        [&](const Cell& c) {
                                          return c.treatment.naive.empty() != naive && c.result.outcome == outcome;
                                        }),
                          name_of(outcome));
    return text;
  };
  const bool any = std::any_of(cells.begin(), cells.end(), [](const Cell& c) { return !c.treatment.naive.empty(); });
  return "Product: " + counts(false) + "." + (any ? " Textbook treatments: " + counts(true) + "." : "");
}

void write_files(std::span<const Cell> cells, const std::string& suite, const std::filesystem::path& directory) {
  core::write_atomically(directory / "stability.json", stability_text(cells, suite));
  core::write_atomically(directory / "stability.csv", csv_text(cells));
  core::write_atomically(directory / "stability.md", markdown(cells, suite));
  core::write_atomically(directory / "outcomes.csv", outcomes_text(cells));
}

}  // namespace polybed::hard
