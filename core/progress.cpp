#include "core/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/print.hpp"

namespace polybed::core {

namespace {

using Clock = std::chrono::steady_clock;
constexpr double terminal_interval = 0.25;  ///< s
constexpr int lines_in_pipe = 20, bar_width = 24;

/// Columns of the terminal on standard error; 0 if unknown.
std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

/// A line that is renewed in place must not wrap: keeps its first columns, in whole letters. 0 columns: all of it.
std::string cut(const std::string& line, std::size_t columns) {
  std::size_t end = 0, shown = 0;
  for (const std::size_t most = columns > 1 ? columns - 1 : line.size(); end < line.size(); ++end) {
    const bool begins_letter = (static_cast<unsigned char>(line[end]) & 0xC0U) != 0x80U;
    if (begins_letter && ++shown > most) break;
  }
  return line.substr(0, end);
}

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

}  // namespace

std::string duration_text(double seconds) {
  const auto s = long(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

Progress::Progress(bool quiet, double from, double until)
    : quiet_(quiet),
      terminal_(is_terminal(stderr)),
      from_(from),
      until_(until),
      next_(from),
      begin_(Clock::now()),
      last_(begin_) {}

Progress::~Progress() {
  if (!quiet_ && terminal_) print(stderr, "\n");
}

bool Progress::due(double time) const {
  if (quiet_) return false;
  const bool at_end = time >= until_ && last_time_ < until_;
  return at_end || (terminal_ ? since(last_) > terminal_interval : time >= next_);
}

void Progress::show(const ProgressLine& line) {
  last_ = Clock::now();
  last_time_ = line.time;
  while (next_ <= line.time) next_ += (until_ - from_) / lines_in_pipe;
  const double done = line.time - from_, share = std::clamp(done / (until_ - from_), 0.0, 1.0);
  const double rate = done > 0 ? since(begin_) / done : 0;
  constexpr double enough_to_tell = 1e-3;  // share of the run before which speed and step mean nothing yet
  const std::string speed =
      share < enough_to_tell ? "" : fmt::format(", {} left", duration_text(rate * (until_ - line.time)));
  const std::string bed = line.bed_height ? fmt::format("  bed {:.1f} mm", 1e3 * *line.bed_height) : "";
  const std::string step =
      share < enough_to_tell ? "" : fmt::format("  step {:.2g} s, limited by {}", line.step, line.limited_by);
  const std::string text =
      fmt::format("t {:.3f}{} s{}{}{}  {}", line.time, line.to_steady ? "" : fmt::format("/{:g}", line.until),
                  line.to_steady ? ", until steady" : speed, bed, step, line.worst_invariant);
  if (!terminal_) {
    print(stderr, "{}\n", text);
    return;
  }
  const int full = int(share * bar_width);
  const std::string bar = fmt::format("[{}{}] {}", std::string(std::size_t(full), '#'),
                                      std::string(std::size_t(bar_width - full), '.'), text);
  put_in_place_of_line(stderr, cut(bar, terminal_columns()));
}

}  // namespace polybed::core
