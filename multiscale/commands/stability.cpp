// polybed stability: the catalogue of hard cases against every scheme, cell by cell what held.
#include <fmt/format.h>

#include <cstdio>

#include "core/error.hpp"
#include "core/files.hpp"
#include "multiscale/commands/comma_list.hpp"
#include "multiscale/commands/options.hpp"
#include "multiscale/picture.hpp"
#include "multiscale/stability/fuzz.hpp"
#include "multiscale/stability/report.hpp"
#include "multiscale/stability/textbook.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

}  // namespace

core::ExitCode run_stability(const StabilityOptions& options) {
  const stability::Choice choice{options.suite == "full", comma_list(options.only), comma_list(options.schemes),
                                 comma_list(options.naive)};
  if (!choice.naive.empty() && stability::textbook() == nullptr)
    throw core::CaseError("--naive: textbook treatments are in test builds alone, e.g. build/tests/polybed_textbook");
  std::vector<stability::HardCase> catalogue = stability::catalogue();
  const fs::path kept = stability::expected_path().parent_path() / "found";
  for (stability::HardCase& one : stability::kept_cases(kept)) catalogue.push_back(std::move(one));
  std::vector<stability::Cell> cells = stability::cells_of(catalogue, choice);
  const stability::Expected expected = stability::read_expected(stability::expected_path());
  for (stability::Cell& cell : cells)
    if (const auto row = expected.find({cell.one.id, cell.treatment.name()}); row != expected.end())
      cell.expected = row->second;
    else if (cell.treatment.integrator == "case")
      cell.expected = stability::kept_outcome(kept, cell.one.id);
  const fs::path directory = options.output.empty() ? fs::path("runs/stability") : options.output;
  core::make_directories(directory);
  if (!options.json) fmt::print("{}\n", stability::table_header());
  const auto show = [&](std::size_t begin, std::size_t count) {
    if (options.json) return;
    fmt::print("{}\n", stability::table_lines(std::span(cells).subspan(begin, count)));
    std::fflush(stdout);
  };
  stability::run_cells(cells, options.jobs, show);
  stability::write_files(cells, options.suite, directory);
  std::string message;
  const bool drawn = draw("polybed.stability", directory, message);
  if (!drawn && !options.json) fmt::print(stderr, "no heat map: {}\n", message);
  const std::vector<std::string> differ = stability::differences(cells);
  if (options.json)
    fmt::print("{}", core::read_text(directory / "stability.json"));
  else
    fmt::print("\n{}\nFiles in {}\n", stability::summary(cells), directory.string());
  for (const std::string& line : differ) fmt::print(stderr, "{}\n", line);
  return differ.empty() ? core::ExitCode::done : core::ExitCode::numerics;
}

}  // namespace polybed::multiscale
