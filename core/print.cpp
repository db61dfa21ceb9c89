#include "core/print.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string_view>

#include "core/numerics/mpi_start.hpp"

namespace polybed::core {

namespace {

int first_refusal = 0;  // errno of the first failure, which standard output's error flag does not keep

void send(std::FILE* stream, const std::string& text) {
  const bool taken = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  if (!taken && stream == stdout && first_refusal == 0) first_refusal = errno;
}

/// A character that would act on a terminal; 0 bytes: there is none.
struct Control {
  unsigned code = 0;
  std::size_t bytes = 0;
};

/// The control character at the start of a text in UTF-8: C0, C1, or one that turns the direction of writing.
Control control_at(std::string_view text) {
  const auto byte = [&](std::size_t n) { return n < text.size() ? static_cast<unsigned char>(text[n]) : 0U; };
  const unsigned first = byte(0), second = byte(1), third = byte(2);
  if ((first < 0x20 && first != '\n' && first != '\t') || first == 0x7F) return {first, 1};
  if (first == 0xC2 && second >= 0x80 && second < 0xA0) return {second, 2};
  const bool turns = (second == 0x80 && third >= 0xAA && third <= 0xAE) ||  // U+202A to U+202E
                     (second == 0x81 && third >= 0xA6 && third <= 0xA9);    // U+2066 to U+2069
  return first == 0xE2 && turns ? Control{0x2000 | (second & 0x3F) << 6 | (third & 0x3F), 3} : Control{};
}

}  // namespace

std::string plain(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Control control = control_at(text);
    if (control.bytes > 0)
      shown += fmt::format("\\u{:04x}", control.code);
    else
      shown += text.front();
    text.remove_prefix(std::max<std::size_t>(control.bytes, 1));
  }
  return shown;
}

void put(std::FILE* stream, std::string_view text) { send(stream, plain(text)); }

bool is_terminal(std::FILE* stream) { return !started_by_launcher() && isatty(fileno(stream)) == 1; }

void put(std::FILE* stream, Colour colour, std::string_view text) {
  const char *refused = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
  constexpr std::string_view without_colours = "dumb";
  if ((refused != nullptr && *refused != '\0') || terminal == nullptr || terminal == without_colours ||
      !is_terminal(stream))
    return put(stream, text);
  constexpr int codes[] = {1, 31, 32, 33, 34};  // from ECMA-48, in the order of Colour
  send(stream, fmt::format("\033[{}m{}\033[0m", codes[std::size_t(colour)], plain(text)));
}

void put_in_place_of_line(std::FILE* stream, std::string_view text) {
  send(stream, "\r\033[K" + plain(text));
  std::fflush(stream);
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_@%+=:,./-";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

int refusal_of_answer() {
  const bool taken = std::fflush(stdout) == 0;
  if (first_refusal != 0) return first_refusal;
  if (!taken) return errno;
  return std::ferror(stdout) != 0 ? EIO : 0;
}

}  // namespace polybed::core
