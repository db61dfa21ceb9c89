// polybed-hard: the catalogue of hard cases against every scheme, cell by cell what held.
#include <cstdio>

#include "core/error.hpp"
#include "core/output/directory.hpp"
#include "core/output/files.hpp"
#include "core/print.hpp"
#include "hard/fuzz.hpp"
#include "hard/options.hpp"
#include "hard/report.hpp"
#include "multiscale/python_module.hpp"

namespace polybed::hard {

namespace fs = std::filesystem;

namespace {

/// The words of "a,b,c"; empty ones are left out.
std::vector<std::string> comma_list(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

}  // namespace

core::ExitCode run_matrix(const Options& options) {
  const Choice choice{options.suite == "full", comma_list(options.only), comma_list(options.schemes),
                      comma_list(options.naive)};
  std::vector<HardCase> cases = catalogue();
  const fs::path kept = expected_path().parent_path() / "found";
  for (HardCase& one : kept_cases(kept)) cases.push_back(std::move(one));
  std::vector<Cell> cells = cells_of(cases, choice);
  const Expected expected = read_expected(expected_path());
  for (Cell& cell : cells)
    if (const auto row = expected.find({cell.one.id, cell.treatment.name()}); row != expected.end())
      cell.expected = row->second;
    else if (cell.treatment.integrator == "case")
      cell.expected = kept_outcome(kept, cell.one.id);
  const fs::path directory = options.output.empty() ? fs::path("runs/stability") : options.output;
  const core::OutputDirectory taken(directory);
  const auto show = [&](std::size_t begin, std::size_t count) {
    if (options.json) return;
    core::print("{}\n", table_lines(std::span(cells).subspan(begin, count)));
    std::fflush(stdout);
  };
  if (!options.json) core::print("{}\n", table_heading());
  run_cells(cells, options.jobs, show);
  write_files(cells, options.suite, directory);
  std::string message;
  const bool drawn = multiscale::draw("polybed.plot", directory, message);
  if (!drawn && !options.json) core::print(stderr, "no heat map: {}\n", message);
  const std::vector<std::string> differ = differences(cells);
  if (options.json)
    core::print("{}", core::read_text(directory / "stability.json"));
  else
    core::print("\n{}\n{}\nFiles in {}\n", summary(cells), meaning_of_outcomes(), directory.string());
  for (const std::string& line : differ) core::print(stderr, "{}\n", line);
  return differ.empty() ? core::ExitCode::done : core::ExitCode::numerics;
}

}  // namespace polybed::hard
