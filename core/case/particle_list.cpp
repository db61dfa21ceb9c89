#include "core/case/particle_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "core/case/keys.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"

namespace polybed::core {

namespace {

constexpr std::array<std::string_view, 10> column_names{"species", "x", "y", "z", "vx", "vy", "vz", "wx", "wy", "wz"};
constexpr std::size_t required_columns = 4;  ///< the first ones are required
constexpr std::size_t most_problems = 100;   ///< problems listed: a wrong column of a million rows floods no screen

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

/// A field of a line and the column at which it begins, 1-based.
struct Cell {
  std::string_view text;
  int column;
};

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view whole = line.substr(begin, end - begin), text = trimmed(whole);
    const std::size_t shift = text.empty() ? 0 : std::size_t(text.data() - whole.data());
    cells.push_back({text, int(begin + shift) + 1});
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

/// Reads a list: collects its particles and its problems.
class ListReader {
 public:
  ListReader(const Scene& scene, std::string file) : scene_(scene), file_(std::move(file)) {}
  ParticleList read(std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    while (!text.empty()) {
      ++line_;
      std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(line.size() + 1, text.size()));
      if (line_ == 1 && line.starts_with(byte_order_mark)) line.remove_prefix(byte_order_mark.size());
      if (trimmed(line).empty()) continue;
      if (!meaning_.empty()) {
        read_row(cells_of(line));
        continue;
      }
      read_header(cells_of(line));
      if (!problems_.empty()) throw StartError(problems_);  // nothing else can be checked without the columns
    }
    line_ = 0;
    if (problems_.empty() && list_.species.empty())
      problems_.push_back({file_, 0, 0, "no particles: a header species,x,y,z and a line for each are needed"});
    if (untold_ > 0) problems_.push_back({file_, 0, 0, fmt::format("{} more problems like these", untold_)});
    if (!problems_.empty()) throw StartError(problems_);
    return std::move(list_);
  }

 private:
  void read_header(const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) {
      const auto found = std::find(column_names.begin(), column_names.end(), cell.text);
      const auto index = std::size_t(found - column_names.begin());
      if (found == column_names.end()) {
        const std::string near = nearest_name(cell.text, {column_names.begin(), column_names.end()});
        add(cell.column, fmt::format("unknown column '{}': allowed are {}{}", cell.text, fmt::join(column_names, ", "),
                                     near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
      } else if (std::find(meaning_.begin(), meaning_.end(), index) != meaning_.end()) {
        add(cell.column, fmt::format("column '{}' stands twice", cell.text));
      }
      meaning_.push_back(index);
    }
    for (std::size_t k = 0; k < required_columns; ++k)
      if (std::find(meaning_.begin(), meaning_.end(), k) == meaning_.end())
        add(1,
            fmt::format("column '{}' is missing: the first line names the columns, of which species, x, y, z must be "
                        "there",
                        column_names[k]));
  }

  void read_row(const std::vector<Cell>& cells) {
    if (cells.size() != meaning_.size())
      return add(1, fmt::format("{} values, the header names {} columns", cells.size(), meaning_.size()));
    std::optional<std::int32_t> kind;
    std::array<std::array<double, 3>, 3> vectors{};  // position, velocity, spin
    bool good = true;
    int place = 1;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::size_t index = meaning_[k];
      if (index == 0) {
        kind = species(cells[k]);
        good = good && kind;
        continue;
      }
      if (index == 1) place = cells[k].column;
      const auto value = number(cells[k], column_names[index]);
      good = good && value;
      vectors[(index - 1) / 3][(index - 1) % 3] = value.value_or(0);
    }
    if (!good) return;
    check_inside(vectors[0], place);
    list_.species.push_back(*kind);
    list_.position.push_back(vectors[0]);
    list_.velocity.push_back(vectors[1]);
    list_.spin.push_back(vectors[2]);
  }

  std::optional<std::int32_t> species(const Cell& cell) {
    std::vector<std::string> names;
    for (std::size_t j = 0; j < scene_.species.size(); ++j) {
      if (scene_.species[j].name == cell.text) return std::int32_t(j);
      names.push_back(scene_.species[j].name);
    }
    const std::string near = nearest_name(cell.text, names);
    add(cell.column, fmt::format("no species '{}': there are {}{}", cell.text, fmt::join(names, ", "),
                                 near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    return std::nullopt;
  }

  std::optional<double> number(const Cell& cell, std::string_view name) {
    double value = 0;
    const char* end = cell.text.data() + cell.text.size();
    const auto [stop, error] = std::from_chars(cell.text.data(), end, value);
    if (cell.text.empty() || error == std::errc::invalid_argument || stop != end)
      add(cell.column, fmt::format("{} = '{}': expected a number in SI units", name, cell.text));
    else if (error != std::errc() || !std::isfinite(value))
      add(cell.column, fmt::format("{} = {} is out of range: finite numbers", name, cell.text));
    else
      return value;
    return std::nullopt;
  }

  void check_inside(const std::array<double, 3>& position, int column) {
    constexpr std::array<char, 3> axis{'x', 'y', 'z'};
    for (std::size_t d = 0; d < 3; ++d)
      if (!(position[d] >= 0 && position[d] <= scene_.column.size[d]))
        add(column, fmt::format("{} = {:g} m: the centre lies outside the column, 0 to {:g} m", axis[d], position[d],
                                scene_.column.size[d]));
    const Column& shape = scene_.column;
    const double centre = 0.5 * shape.size[0], away = std::hypot(position[0] - centre, position[2] - centre),
                 radius = shape.is_tapered() ? 0.5 * shape.diameter_at(position[1]) : centre;
    if (shape.is_round() && away > radius)
      add(column, fmt::format("x = {:g} m, z = {:g} m: the centre lies outside the round column, {:g} m from its axis, "
                              "whose radius is {:g} m",
                              position[0], position[2], away, radius));
  }

  void add(int column, std::string message) {
    if (problems_.size() < most_problems)
      problems_.push_back({file_, line_, column, std::move(message)});
    else
      ++untold_;
  }

  const Scene& scene_;
  std::string file_;
  int line_ = 0;
  std::vector<std::size_t> meaning_;  ///< of each column of the file: index into column_names
  ParticleList list_;
  std::vector<CaseProblem> problems_;
  std::size_t untold_ = 0;
};

}  // namespace

ParticleList read_particle_list(const Scene& scene) {
  if (scene.bed.start.kind != StartKind::list)
    throw StartError("bed.start = \"" + text_of(scene.bed.start) +
                     "\" names no list of particles: write \"list:FILE.csv\"");
  const std::string& file = scene.bed.start.file;
  return ListReader(scene, file).read(read_text(file));
}

}  // namespace polybed::core
