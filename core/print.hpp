// Output on the standard streams.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace polybed::core {

/// Makes a text safe for a terminal: control characters, except line ends and tabs, and marks that turn the direction
/// of writing become escapes as in JSON and TOML, \u001b. Titles, names and keys in a file thus act on no terminal.
[[nodiscard]] std::string plain(std::string_view text);

/// Writes a text, made plain, to a stream; never fails.
void put(std::FILE* stream, std::string_view text);

/// Whether a stream is a terminal of this process. A launcher gives its ranks terminals that nobody reads.
[[nodiscard]] bool is_terminal(std::FILE* stream);

enum class Colour { bold, red, green, yellow, blue };

/// The same in a colour if the stream is a terminal with colours and NO_COLOR (no-color.org) is not set.
void put(std::FILE* stream, Colour colour, std::string_view text);

/// Writes a text in place of the last line of a terminal.
void put_in_place_of_line(std::FILE* stream, std::string_view text);

/// A word quoted for a shell if it contains more than letters, digits and signs without meaning.
[[nodiscard]] std::string shell_word(const std::string& word);

/// errno of standard output's first failure; 0: the whole answer has arrived. Flushes its buffer.
[[nodiscard]] int refusal_of_answer();

/// Prints to standard output or standard error; never fails, as a run must not end because nobody reads its output.
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
