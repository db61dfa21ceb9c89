// What the program says on its standard streams.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace polybed::core {

/// A text as a terminal may get it: control characters, but for line ends and tabs, and marks that turn the direction
/// of writing are shown by their escapes in JSON and TOML, \u001b. Titles, names and keys of a file act on no terminal.
[[nodiscard]] std::string plain(std::string_view text);

/// Writes a text, made plain, to a stream, and never fails.
void put(std::FILE* stream, std::string_view text);

/// Whether a stream is a terminal of this process. A launcher gives its ranks terminals that nobody looks at.
[[nodiscard]] bool is_terminal(std::FILE* stream);

enum class Colour { bold, red, green, yellow, blue };

/// The same in a colour where the stream is a terminal that has them and NO_COLOR (no-color.org) is not set.
void put(std::FILE* stream, Colour colour, std::string_view text);

/// Writes a text in place of the last line of a terminal.
void put_in_place_of_line(std::FILE* stream, std::string_view text);

/// A word as a shell reads it back: in quotes where it contains more than letters, digits and signs that mean nothing.
[[nodiscard]] std::string shell_word(const std::string& word);

/// Why standard output has first refused a part of the answer, as errno; 0: all of it has arrived. Empties its buffer.
[[nodiscard]] int refusal_of_answer();

/// Prints to standard output or standard error, and never fails: a run must not end because nobody reads what it says.
template <class... Arguments>
void print(std::FILE* stream, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  put(stream, fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// The same to standard output.
template <class... Arguments>
void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  core::print(stdout, format, std::forward<Arguments>(arguments)...);
}

}  // namespace polybed::core
