#include "hard/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "hard/child.hpp"
#include "hard/result_text.hpp"
#include "multiscale/program.hpp"

namespace polybed::hard {

namespace {

bool holds(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string first_word(const std::string& text) { return text.substr(0, text.find(' ')); }

bool is_chosen(const HardCase& one, const Choice& choice) {
  if (!choice.only.empty()) return holds(choice.only, one.id) || holds(choice.only, first_word(one.id));
  return choice.all || one.ci;
}

/// Throws if a name of a choice is nowhere in the catalogue.
void require_known(const std::vector<HardCase>& cases, const Choice& choice) {
  std::vector<std::string> ids, schemes, naive{"all"};
  for (const HardCase& one : cases) {
    ids.insert(ids.end(), {one.id, first_word(one.id)});
    for (const Treatment& scheme : one.schemes) schemes.push_back(scheme.name());
    for (const std::string& name : one.naive) naive.insert(naive.end(), {name, first_word(name)});
  }
  const auto require = [](const char* option, const std::vector<std::string>& asked, std::vector<std::string> there) {
    std::sort(there.begin(), there.end());
    there.erase(std::unique(there.begin(), there.end()), there.end());
    for (const std::string& name : asked)
      if (!holds(there, name))
        throw core::CaseError(fmt::format("{} {}: there are {}", option, name, fmt::join(there, ", ")));
  };
  require("--only", choice.only, ids);
  require("--schemes", choice.schemes, schemes);
  require("--naive", choice.naive, naive);
}

/// Costs of the cells of one case.
void compare_costs(std::vector<Cell>& cells, std::size_t begin, std::size_t count) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = begin; n < begin + count; ++n)
    if (cells[n].treatment.naive.empty() && cells[n].result.outcome == Outcome::pass)
      least = std::min(least, std::max(cells[n].result.cpu, 1e-3));  // what the clock can tell
  for (std::size_t n = begin; n < begin + count; ++n)
    cells[n].cost = std::isfinite(least) ? std::max(cells[n].result.cpu, 1e-3) / least : 0;
}

}  // namespace

std::vector<Cell> cells_of(const std::vector<HardCase>& cases, const Choice& choice) {
  require_known(cases, choice);
  std::vector<Cell> cells;
  for (const HardCase& one : cases) {
    if (!is_chosen(one, choice)) continue;
    for (const Treatment& scheme : one.schemes)
      if (choice.schemes.empty() || holds(choice.schemes, scheme.name())) cells.push_back({one, scheme});
    for (const std::string& name : one.naive)
      if (holds(choice.naive, "all") || holds(choice.naive, name) || holds(choice.naive, first_word(name)))
        cells.push_back({one, {"explicit", "limited", name}});
  }
  if (cells.empty())
    throw core::CaseError("--only, --schemes and --naive leave no cell: the cases chosen have none of these schemes");
  return cells;
}

Expected read_expected(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw core::FileError(path.string() + ": the table of expected outcomes cannot be read");
  Expected expected;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::string id, treatment, outcome, broken;
    std::getline(row, id, ',');
    std::getline(row, treatment, ',');
    std::getline(row, outcome, ',');
    std::getline(row, broken);
    expected[{id, treatment}] = broken.empty() ? outcome : outcome + ", " + broken;
  }
  return expected;
}

std::filesystem::path expected_path() {
  return multiscale::beside_program(POLYBED_CASES_INSTALLED, POLYBED_CASES_SOURCE) / "hard" / "expected.csv";
}

void run_cells(std::vector<Cell>& cells, int jobs, const std::function<void(std::size_t, std::size_t)>& shown) {
  constexpr double longest = 600, most_cpu = 120;  // s; ten times the longest cell, and on a busy machine
  std::vector<char> ended(cells.size(), 0);
  const auto run_one = [&](std::size_t n) {
    Trial trial(cells[n].treatment);
    return text_of(trial.judge(cells[n].one.work));
  };
  const auto take = [&](std::size_t n, const ChildEnd& end) {
    cells[n].result = result_of(end);
    ended[n] = 1;
    std::size_t begin = n, count = 1;
    while (begin > 0 && cells[begin - 1].one.id == cells[n].one.id) --begin;
    while (begin + count < cells.size() && cells[begin + count].one.id == cells[n].one.id) ++count;
    if (std::count(ended.begin() + std::ptrdiff_t(begin), ended.begin() + std::ptrdiff_t(begin + count), 0) > 0) return;
    compare_costs(cells, begin, count);
    shown(begin, count);
  };
  in_children(cells.size(), {jobs, longest, most_cpu}, run_one, take);
}

}  // namespace polybed::hard
