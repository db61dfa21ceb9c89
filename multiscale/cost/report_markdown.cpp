// cost.md: the table, what the error is made of, and advice.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/version.hpp"
#include "multiscale/cost/judge.hpp"
#include "multiscale/cost/report.hpp"
#include "multiscale/cost/timing.hpp"

namespace polybed::multiscale {

namespace {

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.2g}", 100 * *share) : std::string("-");
}

std::string cell_of(const Row& row, const std::string& id) {
  const auto q = row.quantities.find(id);
  if (q == row.quantities.end()) return "-";
  return fmt::format("{:.2g} +- {}", 100 * q->second.error, percent(q->second.error_interval));
}

/// How much dearer a dominated row is than the cheapest that is at least as accurate.
std::string status_of(const Sweep& sweep, std::size_t n) {
  const Row& row = sweep.rows[n];
  if (sweep.recommendation && sweep.recommendation->row == n)
    return row.status + fmt::format(" <- {:.2g} % on {}", 100 * sweep.options.target, sweep.ranking());
  if (row.status != "dominated") return row.status;
  const double error = row.quantities.at(sweep.ranking()).error;
  double least = row.rate;
  for (const Row& other : sweep.rows)
    if (other.status == "pareto" && other.quantities.at(sweep.ranking()).error <= error)
      least = std::min(least, other.rate);
  return least > 0 && least < row.rate ? fmt::format("dominated: {:.2g} x dearer", row.rate / least) : row.status;
}

std::string table_of(const Sweep& sweep) {
  std::string head = "| # | settings | s/sim-s | work, s | CPU, s |", line = "| ---: | --- | ---: | ---: | ---: |",
              body;
  for (const std::string& id : sweep.options.quantities) {
    head += fmt::format(" {} % |", id);
    line += " ---: |";
  }
  for (std::size_t n = 0; n < sweep.rows.size(); ++n) {
    const Row& row = sweep.rows[n];
    body += fmt::format("| {} | {} | {:.3g} | {:.3g} | {:.3g} |", n, settings_text(sweep, row), row.rate,
                        weighed(row.outcome.counters), row.cpu.empty() ? 0.0 : timing_of(row.cpu).median);
    for (const std::string& id : sweep.options.quantities) body += " " + cell_of(row, id) + " |";
    body += " " + status_of(sweep, n) + " |\n";
  }
  return head + " status |\n" + line + " --- |\n" + body;
}

std::string shares_of(const std::string& title, const std::vector<Share>& shares) {
  if (shares.empty()) return "";
  std::string text = fmt::format("\n| {} | % | |\n| --- | ---: | --- |\n", title);
  for (const Share& s : shares) text += fmt::format("| {} | {} | {} |\n", s.row, percent(s.value), s.note);
  return text;
}

}  // namespace

std::string sweep_markdown(const Sweep& sweep, const SweepOf& of) {
  const std::filesystem::path path = of.case_path;
  const bool in_folder = path.filename() == "case.toml";
  const std::string name = in_folder ? path.parent_path().filename().string() : path.filename().string();
  std::string text = fmt::format("case {}   model {}   {}   reference: {}{}\n", name, sweep.options.model,
                                 sweep.regime == "chaotic" ? "chaotic" : "not chaotic",
                                 sweep.reference.kind.empty() ? "none" : sweep.reference.kind,
                                 sweep.reference.note.empty() ? "" : " (" + sweep.reference.note + ")");
  text += fmt::format("clock {}   outcome {}   commit {}\n\n", sweep.options.clock, sweep.outcome, core::git_commit());
  for (const std::string& sentence : advice(sweep)) text += sentence + "\n";
  text += "\n" + table_of(sweep);
  text += shares_of(fmt::format("error of {}", sweep.ranking()), sweep.attribution);
  text += shares_of("input, changed by what it is usually known to", sweep.inputs);
  if (sweep.additive_off) text += fmt::format("\nadditive model off by {:.2g} %\n", 100 * *sweep.additive_off);
  for (const std::string& warning : sweep.warnings) text += "\nwarning: " + warning + "\n";
  return text;
}

}  // namespace polybed::multiscale
